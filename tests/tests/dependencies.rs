//! Dependencies are what `deny.toml` says they may be, as `cargo deny` checks it, but without network: versions and
//! sources of every target, licences of what is built on this machine.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;
use spdx::{Expression, ParseMode};
use toml::Table;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

fn rules() -> Table {
    std::fs::read_to_string(format!("{ROOT}/deny.toml")).unwrap().parse().unwrap()
}

/// The packages of the lock file: those of every target and feature.
fn locked() -> Vec<Table> {
    let lock: Table = std::fs::read_to_string(format!("{ROOT}/Cargo.lock")).unwrap().parse().unwrap();
    lock["package"].as_array().unwrap().iter().map(|package| package.as_table().unwrap().clone()).collect()
}

/// What a program prints.
fn output(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).current_dir(ROOT).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The packages that are built on this machine, which are those that are at hand without network.
fn built() -> Vec<Value> {
    let rustc = output("rustc", &["-vV"]);
    let host = rustc.lines().find_map(|line| line.strip_prefix("host: ")).unwrap();
    let options = ["metadata", "--format-version=1", "--locked", "--offline", "--filter-platform", host];
    let metadata: Value = serde_json::from_str(&output(env!("CARGO"), &options)).unwrap();
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
    let packages = built();
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
    for package in locked() {
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
    for package in locked() {
        // a package of this workspace has none
        let source = package.get("source").map_or("registry+", |source| source.as_str().unwrap());
        assert!(source.starts_with("registry+"), "{:?}: {source}", package["name"]);
    }
}
