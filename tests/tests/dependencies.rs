//! Dependencies are what `deny.toml` says they may be, as `cargo deny` checks it, but without network: licences, versions, sources.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;
use spdx::{Expression, ParseMode};
use toml::Table;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

fn rules() -> Table {
    std::fs::read_to_string(format!("{ROOT}/deny.toml")).unwrap().parse().unwrap()
}

/// All packages of the lock file, for every target and feature.
fn packages() -> Vec<Value> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .args(["metadata", "--format-version=1", "--all-features", "--locked", "--offline"])
        .current_dir(ROOT);
    let output = cargo.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

/// The strings of a list of the rules; of its tables those under a key.
fn strings<'a>(list: &'a toml::Value, key: &str) -> BTreeSet<&'a str> {
    let list = list.as_array().unwrap().iter();
    list.map(|entry| entry.get(key).unwrap_or(entry).as_str().unwrap()).collect()
}

#[test]
fn every_licence_is_allowed() {
    let rules = rules();
    let allowed = strings(&rules["licenses"]["allow"], "");
    let packages = packages();
    assert!(packages.len() > 100);
    for package in packages {
        let licence = package["license"].as_str().unwrap_or_default();
        let expression = Expression::parse_mode(licence, ParseMode::LAX);
        let expression = expression.unwrap_or_else(|error| panic!("{}: {error}", package["name"]));
        let is_allowed = expression.evaluate(|licence| allowed.contains(licence.to_string().as_str()));
        assert!(is_allowed, "{}: {licence} is not allowed by deny.toml", package["name"]);
    }
}

#[test]
fn no_crate_comes_in_two_versions_without_a_reason() {
    let rules = rules();
    let skipped = strings(&rules["bans"]["skip"], "crate");
    let mut versions: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in packages() {
        let [name, version] = ["name", "version"].map(|key| package[key].as_str().unwrap().to_owned());
        versions.entry(name).or_default().push(version);
    }
    let is_skipped = |name: &str, version: &String| {
        skipped.iter().any(|skip| {
            let (skipped, prefix) = skip.split_once('@').unwrap();
            skipped == name && version.starts_with(&format!("{prefix}."))
        })
    };
    for (name, mut versions) in versions {
        let all = versions.join(" and ");
        versions.retain(|version| !is_skipped(&name, version));
        assert!(versions.len() <= 1, "{name} comes as {all}: deny.toml has no reason for it");
    }
}

#[test]
fn every_dependency_comes_from_a_registry() {
    for package in packages() {
        let source = package["source"].as_str().unwrap_or("path of this workspace");
        let is_known = source.starts_with("registry+") || source == "path of this workspace";
        assert!(is_known, "{}: {source}", package["name"]);
    }
}
