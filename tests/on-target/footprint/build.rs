//! Links firmware by a script that lays out flash and RAM and nothing else.

fn main() {
    let cfg = |name| std::env::var(name).unwrap_or_default();
    if cfg("CARGO_CFG_TARGET_OS") == "none" {
        println!("cargo::rustc-link-arg-bins=-T{}/footprint.ld", cfg("CARGO_MANIFEST_DIR"));
    }
    println!("cargo::rerun-if-changed=footprint.ld");
}
