//! Completions and pages for man.

use std::process::Command;

use crate::support::Folder;

const COMMANDS: [&str; 5] = ["run", "sample", "kernels", "completions", "man"];

#[test]
fn completions_know_every_command_and_option() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish"] {
        let script = folder.succeed(&format!("completions {shell}")).stdout;
        for word in COMMANDS.iter().chain(&["gradient", "resolution", "resume", "wendland-c2"]) {
            assert!(script.contains(word), "{shell}: {word} is missing");
        }
    }
    folder.fail_with(2, "completions tcl", &["tcl", "bash"]);
}

#[test]
fn bash_reads_its_completions() {
    let folder = Folder::new();
    let script = folder.succeed("completions bash").stdout;
    let complete = "COMP_WORDS=(fluisim sample --grad); COMP_CWORD=2; _fluisim fluisim --grad sample; echo ${COMPREPLY[@]}";
    let Ok(bash) = Command::new("bash").args(["-c", &format!("{script}\n{complete}")]).output() else {
        return; // a machine without bash
    };
    assert!(bash.status.success(), "{}", String::from_utf8_lossy(&bash.stderr));
    assert_eq!(String::from_utf8_lossy(&bash.stdout).trim(), "--gradient");
}

#[test]
fn there_is_a_page_for_every_command() {
    let folder = Folder::new();
    let page = folder.succeed("man").stdout;
    assert!(page.contains(".TH fluisim 1"), "{page}");
    for command in COMMANDS {
        assert!(page.contains(&format!("fluisim\\-{command}(1)")), "{command} is missing");
        let page = folder.succeed(&format!("man {command}")).stdout;
        assert!(page.contains(&format!(".TH fluisim-{command} 1")), "{page}");
    }
    assert!(folder.succeed("man sample").stdout.contains("smoothing\\-length"));
    folder.fail_with(2, "man teapot", &["teapot", "sample"]);
}
