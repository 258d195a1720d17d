//! The packages of the C library: an Arduino library, a folder for CMake and a component of ESP-IDF, each a folder and a zip of it.

use super::archive::target_dir;
use super::{Archives, Context, HOST, M0, M4F, Result, arduino, cmake};
use std::io::Write;
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;

/// Cortex-M with floats in integer registers, and the two others that no machine here is named after.
const SOFT: &str = "thumbv7em-none-eabi";
const M33: &str = "thumbv8m.main-none-eabihf";
const RV32: &str = "riscv32imc-unknown-none-elf";

/// The folders of a precompiled Arduino library: what a board calls its processor and, below it, `-mfpu` and `-mfloat-abi`; the archive; and
/// what is passed to the compiler there. A board whose floats go by integer registers takes what lies in the folder of its processor.
pub(crate) const ARDUINO: [(&str, &str, &[&str]); 11] = [
    ("cortex-m0plus", M0.triple, &["-mcpu=cortex-m0plus"]),
    ("cortex-m0", M0.triple, &["-mcpu=cortex-m0"]),
    ("cortex-m3", M0.triple, &["-mcpu=cortex-m3"]),
    ("cortex-m4", SOFT, &["-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=softfp"]),
    ("cortex-m4/fpv4-sp-d16-hard", M4F.triple, &["-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"]),
    ("cortex-m7", SOFT, &["-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=softfp"]),
    ("cortex-m7/fpv5-d16-hard", M4F.triple, &["-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard"]),
    ("cortex-m33", SOFT, &["-mcpu=cortex-m33", "-march=armv8-m.main+fp+dsp", "-mfloat-abi=softfp"]),
    ("cortex-m33/fpv5-sp-d16-hard", M33, &["-mcpu=cortex-m33", "-mfpu=fpv5-sp-d16", "-mfloat-abi=hard"]),
    ("esp32c3", RV32, &[]),
    ("esp32c6", RV32, &[]),
];

/// The folders of the packages.
pub(crate) struct Packages {
    pub(crate) arduino: PathBuf,
    pub(crate) cmake: PathBuf,
    pub(crate) esp_idf: PathBuf,
}

/// Writes all of them and says where the zips are.
pub(crate) fn write(archives: &Archives) -> Result<Packages> {
    println!();
    Ok(Packages { arduino: arduino(archives)?, cmake: cmake(archives)?, esp_idf: esp_idf(archives)? })
}

/// Writes all of them and tries them; true when everything holds.
pub(crate) fn check(archives: &Archives) -> Result<bool> {
    let packages = write(archives)?;
    let mut good = arduino::check(&packages, archives.contains_key(HOST.triple))?;
    good &= cmake::check(&packages, archives.contains_key(HOST.triple))?;
    Ok(good)
}

fn arduino(archives: &Archives) -> Result<PathBuf> {
    let mut package = Package::new("arduino", "src")?;
    for (folder, triple, _) in ARDUINO {
        package.archive(&format!("src/{folder}"), archives, triple)?;
    }
    package.write()
}

fn cmake(archives: &Archives) -> Result<PathBuf> {
    let mut package = Package::new("cmake", "include")?;
    for triple in archives.keys() {
        package.archive(&format!("lib/{triple}"), archives, triple)?;
    }
    package.write()
}

fn esp_idf(archives: &Archives) -> Result<PathBuf> {
    let mut package = Package::new("esp-idf", "include")?;
    package.archive(&format!("lib/{RV32}"), archives, RV32)?;
    package.write()
}

/// Files by their path in the folder `fluisim`.
struct Package {
    name: &'static str,
    version: String,
    files: Vec<(String, Vec<u8>)>,
}

impl Package {
    /// What lies in the folder `sph-core/c/NAME`, with the version put in, the licences, and the header in a folder of its own.
    fn new(name: &'static str, header: &str) -> Result<Self> {
        let manifest = crate::read("../../Cargo.toml")?;
        let version = manifest.lines().find_map(|line| line.strip_prefix("version = \"")?.strip_suffix('"'));
        let version = version.context("Cargo.toml has no version")?.to_owned();
        let mut files = Vec::new();
        let library = crate::root().join("../../sph-core/c");
        collect(&library.join(name), "", &mut files)?;
        for (_, text) in files.iter_mut().filter(|(path, _)| !path.contains('/')) {
            *text = std::str::from_utf8(text)?.replace("VERSION", &version).into_bytes();
        }
        for (from, to) in [
            ("include/fluisim.h", format!("{header}/fluisim.h")),
            ("LICENSE-APACHE", "LICENSE-APACHE".into()),
            ("LICENSE-MIT", "LICENSE-MIT".into()),
        ] {
            files.push((to, std::fs::read(library.join(from))?));
        }
        Ok(Self { name, version, files })
    }

    fn archive(&mut self, folder: &str, archives: &Archives, triple: &str) -> Result<()> {
        let archive = archives.get(triple).with_context(|| format!("there is no archive for {triple}"))?;
        self.files.push((format!("{folder}/libfluisim.a"), std::fs::read(&archive.path)?));
        Ok(())
    }

    /// Writes the folder `packages/NAME/fluisim` anew and a zip of it, which has the same bytes for the same files; gives the folder.
    fn write(mut self) -> Result<PathBuf> {
        self.files.sort();
        let packages = target_dir().join("c/packages");
        let folder = packages.join(self.name).join("fluisim");
        if folder.exists() {
            std::fs::remove_dir_all(&folder)?;
        }
        std::fs::create_dir_all(&folder)?;
        let path = packages.join(format!("fluisim-{}-{}.zip", self.name, self.version));
        let mut zip = zip::ZipWriter::new(std::fs::File::create(&path)?);
        for (name, bytes) in &self.files {
            let file = folder.join(name);
            std::fs::create_dir_all(file.parent().context("a folder")?)?;
            std::fs::write(&file, bytes)?;
            zip.start_file(format!("fluisim/{name}"), SimpleFileOptions::default())?;
            zip.write_all(bytes)?;
        }
        zip.finish()?;
        println!("{}", path.display());
        Ok(folder)
    }
}

/// All files below a folder.
fn collect(folder: &Path, inside: &str, files: &mut Vec<(String, Vec<u8>)>) -> Result<()> {
    for entry in std::fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()))? {
        let entry = entry?;
        let name = entry.file_name().into_string().ok().context("a file's name in UTF-8")?;
        let path = if inside.is_empty() { name } else { format!("{inside}/{name}") };
        if entry.file_type()?.is_dir() {
            collect(&entry.path(), &path, files)?;
        } else {
            files.push((path, std::fs::read(entry.path())?));
        }
    }
    Ok(())
}
