//! The folder for CMake: programs in C and C++ on this computer, firmware for some processors, and the component of ESP-IDF between mocks
//! of the functions it calls.

use super::archive::target_dir;
use super::machine::{is_there, run};
use super::packages::Packages;
use super::{Context, M0, M4F, Result};
use std::path::Path;
use std::process::Command;

/// What a toolchain file says, and the archive that follows from it: the processor's name and the options.
const CROSS: [(&str, &str, &str); 4] = [
    (M0.triple, "cortex-m0plus", "-mthumb -mcpu=cortex-m0plus"),
    // as the SDK of the RP2350 compiles
    (
        "thumbv7em-none-eabi",
        "cortex-m33",
        "-mthumb -mcpu=cortex-m33 -march=armv8-m.main+fp+dsp -mfloat-abi=softfp -mcmse",
    ),
    ("thumbv8m.main-none-eabihf", "arm", "-mthumb -mcpu=cortex-m33 -mfpu=fpv5-sp-d16 -mfloat-abi=hard"),
    (M4F.triple, "arm", "-mthumb -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard"),
];

/// True when everything is built and the programs print the golden digests.
pub(crate) fn check(packages: &Packages, on_host: bool) -> Result<bool> {
    if !is_there("cmake") {
        println!("\nCMake: SKIPPED: there is no cmake here");
        return Ok(true);
    }
    println!("\nCMake");
    let out = target_dir().join("c/cmake");
    if out.exists() {
        std::fs::remove_dir_all(&out)?;
    }
    let mut good = true;
    if on_host {
        let prefix = packages.cmake.parent().context("a folder")?;
        project("cmake", &out.join("host"), &[format!("-DCMAKE_PREFIX_PATH={}", prefix.display())])?;
        build(&out.join("host"))?;
        for language in ["c", "cpp"] {
            good &= is_golden(&out.join("host").join(format!("golden_{language}")))?;
        }
    }
    for cross in CROSS.into_iter().filter(|_| is_there("arm-none-eabi-g++")) {
        good &= chooses(packages, &out, cross)?;
    }
    project("esp-idf", &out.join("esp-idf"), &[format!("-DCOMPONENT={}", packages.esp_idf.display())])?;
    println!("the component of ESP-IDF asks for files that are there");
    Ok(good)
}

/// Whether the archive follows from what a toolchain file says; the firmware is linked with it.
fn chooses(packages: &Packages, out: &Path, (triple, processor, flags): (&str, &str, &str)) -> Result<bool> {
    let folder = out.join(triple);
    let config = packages.cmake.join("fluisim-config.cmake");
    let options = [
        format!("-DFLUISIM={}", config.display()),
        "-DCMAKE_SYSTEM_NAME=Generic".into(),
        format!("-DCMAKE_SYSTEM_PROCESSOR={processor}"),
        "-DCMAKE_C_COMPILER=arm-none-eabi-gcc".into(),
        "-DCMAKE_CXX_COMPILER=arm-none-eabi-g++".into(),
        "-DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY".into(),
        format!("-DCMAKE_C_FLAGS={flags}"),
        format!("-DCMAKE_CXX_FLAGS={flags}"),
    ];
    let said = project("cmake", &folder, &options)?;
    build(&folder)?;
    let chosen = said.lines().any(|line| line == format!("-- fluisim: {triple}"));
    println!("{triple:<30} {} for {processor}, {flags}", if chosen { "chosen" } else { "NOT CHOSEN" });
    Ok(chosen)
}

/// Configures the project in the folder `c/NAME`; gives what CMake says.
fn project(name: &str, out: &Path, options: &[String]) -> Result<String> {
    let mut cmake = Command::new("cmake");
    cmake.arg("-S").arg(crate::root().join("c").join(name)).arg("-B").arg(out).args(options);
    run(&mut cmake)
}

fn build(folder: &Path) -> Result<()> {
    run(Command::new("cmake").arg("--build").arg(folder))?;
    Ok(())
}

/// Whether a program prints rows of the golden file and no others.
fn is_golden(program: &Path) -> Result<bool> {
    let golden = crate::read("digest/golden.txt")?;
    let printed = run(&mut Command::new(program))?;
    let strange = printed.lines().filter(|row| !golden.lines().any(|line| line == *row)).count();
    let rows = printed.lines().count();
    println!("{:<30} {rows} digests, {strange} differ", program.file_name().unwrap_or_default().display());
    Ok(rows > 0 && strange == 0)
}
