# List the tasks
default:
    @just --list

# Everything that CI runs
check: test format lint docs targets

# The tests
test:
    cargo test

# Formatting
format:
    cargo fmt --all --check

# Clippy, warnings are errors
lint:
    cargo clippy --workspace --all-targets --all-features -- -D warnings

# Documentation, warnings are errors
docs:
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --all-features

# sph-core on bare-metal targets
targets:
    tests/on-target/run

# The fast path's speed; RUST_PEERS names a program to compare with
bench side="100" threads="1" level="best":
    cargo run --release -p sph-host --example bench -- {{side}} {{threads}} {{level}}

# Instructions a particle of the fast path with AVX2, which valgrind knows, against a table: fails where they grow; --update
count *update:
    cargo run --release -p sph-host --example count -- {{update}}
