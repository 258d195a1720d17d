//! `core` for targets that no toolchain has installed: built from its source once for each, and used from then on as an installed
//! one is, whatever the profile.

use anyhow::{Context, Result, ensure};
use cargo_metadata::{Artifact, Message, camino::Utf8PathBuf};
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What a target needs to be compiled for: `core`, and the functions that compiled code calls.
const LIBRARIES: [&str; 2] = ["core", "compiler_builtins"];

/// The folder for `rustc --sysroot` of a compiler of this version, with what the targets need; `cargo` builds what is missing.
pub(crate) fn with_core(cargo: Command, version: &str, triples: &[&str]) -> Result<PathBuf> {
    let name: String = version.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    let sysroot = std::path::absolute(crate::c::target_dir().join("sysroot").join(name))?;
    let missing: Vec<_> = triples.iter().filter(|triple| !folder(&sysroot, triple).exists()).collect();
    if !missing.is_empty() {
        let libraries = build(cargo, &missing)?;
        for triple in missing {
            install(&libraries, triple, &folder(&sysroot, triple))?;
        }
    }
    Ok(sysroot)
}

/// Where a compiler looks for the libraries of a target.
fn folder(sysroot: &Path, triple: &str) -> PathBuf {
    sysroot.join("lib/rustlib").join(triple).join("lib")
}

/// Builds as the installed ones are built: optimised, in one unit, with what optimisation across crates needs.
fn build(mut cargo: Command, triples: &[&&str]) -> Result<Vec<Utf8PathBuf>> {
    cargo.args(["-p", "fluisim-core-library", "--profile", "core", "--locked", "--quiet"]);
    cargo.args(["-Zbuild-std=core", "--message-format=json-render-diagnostics"]);
    cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTFLAGS", "-Cembed-bitcode=yes");
    triples.iter().for_each(|triple| {
        cargo.args(["--target", triple]);
    });
    let mut child = cargo.current_dir(crate::root()).stdout(Stdio::piped()).spawn()?;
    let mut libraries = Vec::new();
    for message in Message::parse_stream(BufReader::new(child.stdout.take().context("piped")?)) {
        if let Message::CompilerArtifact(Artifact { target, filenames, .. }) = message?
            && LIBRARIES.contains(&target.name.as_str())
        {
            libraries.extend(filenames.into_iter().filter(|file| file.extension() == Some("rlib")));
        }
    }
    ensure!(child.wait()?.success(), "{cargo:?} failed");
    Ok(libraries)
}

/// Copies the libraries of a target to their folder, which is there when it is whole.
fn install(libraries: &[Utf8PathBuf], triple: &str, folder: &Path) -> Result<()> {
    let beside = folder.with_extension("new");
    std::fs::create_dir_all(&beside)?;
    let of_target = libraries.iter().filter(|file| file.iter().any(|part| part == triple));
    let mut installed = 0;
    for library in of_target {
        let name = library.file_name().context("a library has a name")?;
        std::fs::copy(library, beside.join(name)).with_context(|| format!("cannot copy {library}"))?;
        installed += 1;
    }
    ensure!(installed == LIBRARIES.len(), "{installed} libraries were built for {triple}");
    std::fs::rename(&beside, folder).with_context(|| format!("cannot make {}", folder.display()))
}
