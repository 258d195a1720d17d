//! The page: the module of the C library for browsers, put into one HTML file, and held against the golden digests by node and a browser.

use crate::c::target_dir;
use crate::compile;
use crate::digests::WASM;
use crate::node;
use crate::toolchain::Toolchain;
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The functions that the page calls; everything else is left out by the linker.
const EXPORTS: [&str; 15] = [
    "bytes",
    "init_box",
    "init_disc",
    "init_mask",
    "add",
    "impulse",
    "step",
    "draw",
    "position",
    "velocity",
    "pressure",
    "densities",
    "interpolate",
    "shepard",
    "corrected",
];

/// Builds the page and tries it; true when everything holds. Where there is no browser, it says what is missing.
pub(crate) fn check() -> Result<bool> {
    if Toolchain::find(WASM).is_err() {
        println!("\nweb: SKIPPED: no toolchain has {WASM}");
        return Ok(true);
    }
    let web = crate::root().join("../../web").canonicalize()?;
    let out = target_dir().join("web");
    std::fs::create_dir_all(&out)?;
    let (module, page) = (out.join("linked.wasm"), out.join("fluisim.html"));
    link(&module)?;
    let golden = crate::root().join("digest/golden.txt");
    println!("\nweb: {}", page.display());
    let mut good = node::run(&[&web.join("build.mjs"), &module, &golden, &page])?;
    good &= node::run(&[&web.join("test/node.mjs"), &out.join("fluisim.wasm"), &golden])?;
    match playwright(&web, &out) {
        Ok(package) => good &= node::run(&[&web.join("test/browser.mjs"), &page, &package, &out])?,
        Err(missing) => println!("web: the browser is SKIPPED: {missing:#}"),
    }
    Ok(good)
}

/// Builds the archive for WebAssembly and links what the page calls.
fn link(module: &Path) -> Result<()> {
    let mut cargo = Toolchain::find(WASM)?.cargo("rustc", &[WASM])?;
    cargo.args(["--manifest-path", "../../Cargo.toml", "-p", "fluisim-web", "--features", "archive"]);
    cargo.args(["--profile", "fast", "--crate-type", "staticlib", "--target-dir"]).arg(target_dir());
    let built = compile::run(cargo)?;
    let archive = &built.first().context("no archive was built")?.path;
    let mut linker = Command::new("wasm-ld");
    linker.args([
        "--no-entry",
        "--gc-sections",
        "--strip-all",
        "-O2",
        "--stack-first",
        "--export=fluisim_web_kernel",
        "--export=fluisim_light_lamps",
    ]);
    for scalar in ["f32", "q16"] {
        linker.arg(format!("--export=fluisim_{scalar}_volumes"));
        linker.args(EXPORTS.map(|name| format!("--export=fluisim_{scalar}_2d_{name}")));
    }
    linker.arg(archive).arg("-o").arg(module);
    let status = linker.status().context("cannot start wasm-ld: apt-get install lld")?;
    if !status.success() {
        bail!("{linker:?} failed");
    }
    Ok(())
}

/// The folder of playwright-core, installed as `web/package-lock.json` says; an error where a browser or npm is missing.
fn playwright(web: &Path, out: &Path) -> Result<PathBuf> {
    let chromium = std::env::var_os("CHROMIUM").unwrap_or_else(|| "/usr/bin/chromium".into());
    if !Path::new(&chromium).exists() {
        bail!(
            "{} is missing: apt-get install --no-install-recommends chromium",
            Path::new(&chromium).display()
        );
    }
    node::install("playwright-core", web, out)
}
