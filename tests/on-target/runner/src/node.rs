//! Node.js, and the packages that a script needs.

use anyhow::{Context, Result, bail};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs a script with its arguments; whether it ended well.
pub(crate) fn run(arguments: &[impl AsRef<OsStr>]) -> Result<bool> {
    Ok(Command::new("node").args(arguments).status().context("cannot start node")?.success())
}

/// The folder of a package that is installed in `out` as the `package-lock.json` of `from` says.
pub(crate) fn install(package: &str, from: &Path, out: &Path) -> Result<PathBuf> {
    for name in ["package.json", "package-lock.json"] {
        std::fs::copy(from.join(name), out.join(name)).with_context(|| format!("cannot copy {name}"))?;
    }
    let folder = out.join("node_modules").join(package);
    if !folder.exists() {
        let mut npm = Command::new("npm");
        npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--silent"]).current_dir(out);
        let status = npm.status().context("cannot start npm: apt-get install --no-install-recommends npm")?;
        if !status.success() {
            bail!("npm could not install {package} of {}", from.join("package-lock.json").display());
        }
    }
    Ok(folder)
}
