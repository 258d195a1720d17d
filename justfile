# List the tasks
default:
    @just --list

# Everything that CI runs, or some of it: just check lint docs (steps: tests, format, lint, docs, targets)
check *steps:
    .ci/run {{steps}}

# The fast path's speed; RUST_PEERS names a program to compare with
bench side="100" threads="1" level="best":
    cargo run --release -p sph-host --example bench -- {{side}} {{threads}} {{level}}

# Instructions a particle of the fast path with AVX2, which valgrind knows, against a table: fails where they grow; --update
count *update:
    cargo run --release -p sph-host --example count -- {{update}}
