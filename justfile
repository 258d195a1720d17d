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

# The speed of the fast path and of the fluid, with AVX2 and the best instruction set; RUST_PEERS names a program to compare with
bench side="100" threads="1":
    cargo bench -p sph-host --bench bench -- {{side}} {{threads}}

# Instructions of the fast path and of the fluid with AVX2, which valgrind knows, against a table: fails where they grow; --update
count *update:
    cargo bench -p sph-host --bench count -- {{update}}
