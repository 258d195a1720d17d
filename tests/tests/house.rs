//! Every source file is declared where it belongs: a file that nothing declares is not compiled, and nothing would say so.

use std::path::{Path, PathBuf};

/// The source files below a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

fn crates() -> Vec<PathBuf> {
    ["../sph-core/src", "../sph-host/src", "../sph-lab/src"]
        .map(|path| Path::new(env!("CARGO_MANIFEST_DIR")).join(path))
        .to_vec()
}

/// What the file says that declares the modules of a folder.
fn parent(folder: &Path) -> String {
    let beside = folder.with_extension("rs");
    let candidates = [folder.join("mod.rs"), folder.join("lib.rs"), beside];
    candidates.iter().filter_map(|path| std::fs::read_to_string(path).ok()).collect()
}

#[test]
fn every_source_file_is_declared() {
    let mut files = Vec::new();
    crates().iter().for_each(|folder| sources(folder, &mut files));
    assert!(files.len() > 200);
    for file in files {
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        if matches!(&*name, "lib" | "main" | "mod") {
            continue;
        }
        let parent = parent(file.parent().unwrap());
        // cases are declared by their list
        let is_declared = [format!("mod {name};"), format!("mod {name} {{"), format!(" in {name}, ")]
            .iter()
            .any(|declaration| parent.contains(declaration));
        assert!(
            is_declared,
            "{}: nothing declares it: write `mod {name};` in the folder's mod.rs",
            file.display()
        );
    }
}

/// Estimates that only sph-core offers.
const NOT_IN_THE_COMMAND: [&str; 1] = ["PlainGradient"];

#[test]
fn every_estimate_is_in_the_list_of_the_command() {
    let crates = crates();
    let list = std::fs::read_to_string(crates[1].join("estimate_choice.rs")).unwrap();
    let mut files = Vec::new();
    sources(&crates[0].join("field"), &mut files);
    let mut count = 0;
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let implemented = text.lines().filter(|line| line.starts_with("impl")).filter_map(|line| {
            let (_, name) = line.split_once(" Estimate<T, D> for ")?;
            name.split(|letter: char| !letter.is_alphanumeric()).next()
        });
        for name in implemented.filter(|name| !NOT_IN_THE_COMMAND.contains(name)) {
            count += 1;
            let is_listed = list.split(|letter: char| !letter.is_alphanumeric()).any(|word| word == name);
            assert!(is_listed, "{name} in {} needs its line in `for_each_estimate!`", file.display());
        }
    }
    assert!(count >= 5);
}

/// A package's page has no file of the repository beside it.
#[test]
fn the_readme_of_a_package_has_no_relative_link() {
    for folder in ["sph-core", "sph-lab", "sph-host"] {
        let path = format!("{}/../{folder}/README.md", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        assert!(text.contains("cargo") || text.contains("```rust"));
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            assert!(target.starts_with("https://") || target.starts_with('#'), "{folder}: {target}");
        }
    }
}

/// The package of the command has what was counted on the targets, a copy.
#[test]
fn the_study_tells_the_instructions_that_were_counted() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let read = |path: &str| std::fs::read_to_string(root.join(path)).unwrap();
    let (counted, told) = (read("tests/on-target/counts.csv"), read("sph-host/src/study/instructions.csv"));
    assert!(counted == told, "copy tests/on-target/counts.csv to sph-host/src/study/instructions.csv");
}
