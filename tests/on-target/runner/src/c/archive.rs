//! The archives of the C library: one object each, without a symbol that a C program did not ask for.

use crate::compile;
use crate::elf;
use crate::toolchain::Toolchain;
use anyhow::{Context, Result, ensure};
use object::build::elf::{Builder, SectionData};
use object::read::archive::ArchiveFile;
use object::{Object, ObjectSymbol};
use std::path::{Path, PathBuf};

/// What may be missing in the object beside `__…`: C's own functions and those of the compiler's library.
const OF_C: [&str; 6] = ["memcpy", "memmove", "memset", "memcmp", "bcmp", "strlen"];

/// An archive, checked.
#[derive(Clone, Debug)]
pub(crate) struct Archive {
    /// Where it is.
    pub(crate) path: PathBuf,
    /// Its size in bytes.
    pub(crate) size: usize,
    /// The functions it exports.
    pub(crate) exported: usize,
    /// What it needs of the C library and the compiler's.
    pub(crate) needed: Vec<String>,
}

/// Builds the archive for a target, takes `compiler_builtins` and what is for debuggers out of it, and looks at its symbols.
pub(crate) fn build(triple: &str) -> Result<Archive> {
    let target_dir = target_dir();
    let mut cargo = Toolchain::find(triple)?.cargo("rustc", &[triple])?;
    cargo.args(["--manifest-path", "../../Cargo.toml", "-p", "fluisim-c", "--features", "archive"]);
    cargo.args(["--profile", "fast", "--crate-type", "staticlib", "--target-dir"]).arg(&target_dir);
    let built = compile::run(cargo)?;
    let bytes = std::fs::read(&built.first().context("no archive was built")?.path)?;
    let object = stripped(only_object(&bytes)?)?;
    let (exported, needed) = symbols(&object).with_context(|| format!("the archive for {triple}"))?;
    let path = target_dir.join("c").join(triple).join("libfluisim.a");
    std::fs::create_dir_all(path.parent().context("a folder")?)?;
    let archive = archived(&object, &exported);
    std::fs::write(&path, &archive)?;
    Ok(Archive { path, size: archive.len(), exported: exported.len(), needed })
}

/// Where this workspace's builds are.
pub(crate) fn target_dir() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| crate::root().join("target"), |path| Path::new(&path).into())
}

/// The object that exports functions: with link-time optimisation there is one, and it needs nothing of the others, which
/// [`symbols`] makes sure of.
fn only_object(archive: &[u8]) -> Result<&[u8]> {
    let mut objects = Vec::new();
    for member in ArchiveFile::parse(archive)?.members() {
        let data = member?.data(archive)?;
        let exports = |symbol: object::Symbol<'_, '_>| {
            symbol.is_definition() && symbol.name().is_ok_and(|name| name.starts_with("fluisim_"))
        };
        if object::File::parse(data).is_ok_and(|file| file.symbols().any(exports)) {
            objects.push(data);
        }
    }
    ensure!(objects.len() == 1, "{} objects in the archive export functions, not 1", objects.len());
    Ok(objects[0])
}

/// The object with no symbol for other objects but `fluisim_…`, without sections for debuggers, and without those for unwinding, which
/// would bring in the unwinder and `malloc`: nothing here unwinds.
fn stripped(object: &[u8]) -> Result<Vec<u8>> {
    let mut builder = Builder::read(object)?;
    for section in builder.sections.iter_mut() {
        let name = section.name.to_vec();
        let holds = |part: &[u8]| name.windows(part.len()).any(|at| at == part);
        section.delete = [&b".debug_"[..], b".ARM.exidx", b".ARM.extab", b".comment"].into_iter().any(holds);
    }
    for symbol in builder.symbols.iter_mut() {
        let name = symbol.name.to_vec();
        symbol.delete = name.starts_with(b"__aeabi_unwind");
        // the crate's own function for zeros: a program keeps its C library's
        if symbol.section.is_some() && name.starts_with(b"__aeabi_memclr") {
            symbol.set_st_info(object::elf::STB_LOCAL, symbol.st_type());
        }
    }
    builder.delete_orphans();
    // LLVM keeps the names of sections and symbols in one table
    let names = builder.sections.add();
    names.name = b".shstrtab"[..].into();
    names.sh_type = object::elf::SHT_STRTAB;
    names.sh_addralign = 1;
    names.data = SectionData::SectionString;
    let mut out = Vec::new();
    builder.write(&mut out)?;
    Ok(out)
}

/// The names that are exported and those that are needed.
fn symbols(object: &[u8]) -> Result<(Vec<String>, Vec<String>)> {
    let file = object::File::parse(object)?;
    let (mut exported, mut needed) = (Vec::new(), Vec::new());
    for symbol in file.symbols() {
        let name = symbol.name()?.to_owned();
        ensure!(!elf::is_panic(&format!("{:#}", rustc_demangle::demangle(&name))), "it can panic: {name}");
        if symbol.is_global() && symbol.is_definition() {
            ensure!(name.starts_with("fluisim_"), "it exports {name}");
            exported.push(name);
        } else if symbol.is_undefined() && !name.is_empty() {
            ensure!(name.starts_with("__") || OF_C.contains(&name.as_str()), "it needs {name}");
            needed.push(name);
        }
    }
    ensure!(!exported.is_empty(), "it exports nothing");
    Ok((exported, needed))
}

/// An archive of one object in the format of System V: an index of the names, then the object.
fn archived(object: &[u8], exported: &[String]) -> Vec<u8> {
    const MAGIC: &[u8] = b"!<arch>\n";
    let header =
        |name: &str, size: usize| format!("{name:<16}{:<12}{:<6}{:<6}{:<8}{size:<10}`\n", 0, 0, 0, 644);
    let mut names: Vec<u8> = exported.iter().flat_map(|name| [name.as_bytes(), b"\0"].concat()).collect();
    if names.len() % 2 == 1 {
        names.push(0);
    }
    let index = 4 + 4 * exported.len() + names.len();
    let at = (MAGIC.len() + header("", 0).len() + index) as u32;
    let mut archive = [MAGIC, header("/", index).as_bytes(), &(exported.len() as u32).to_be_bytes()].concat();
    for _ in exported {
        archive.extend(at.to_be_bytes());
    }
    archive.extend(names);
    archive.extend(header("fluisim.o/", object.len()).as_bytes());
    archive.extend(object);
    archive.resize(archive.len().next_multiple_of(2), b'\n');
    archive
}
