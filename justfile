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
