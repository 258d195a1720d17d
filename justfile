# List the tasks
default:
    @just --list

# Everything that CI runs, or some of it: just check lint docs (steps: tests, format, lint, docs, targets)
check *steps:
    .ci/run {{steps}}

# The speed of the fast path and of the fluid, with AVX2 and the best instruction set; RUST_PEERS names a program to compare with
bench side="100" threads="1":
    cargo bench -p sph-host --bench bench -- {{side}} {{threads}}

# Instructions of the fast path and of the fluid with AVX2, which valgrind knows, against a table: fails where they grow; --update
count *update:
    cargo bench -p sph-host --bench count -- {{update}}

# Which changes of sph-core's arithmetic no test notices; letters choose some: just mutants core disc.rs
mutants subject="core" *letters:
    cargo run --manifest-path tests/mutants/Cargo.toml -- {{subject}} {{letters}}

# The C interface, where the `unsafe` is, under Miri as a 32-bit processor runs it; needs the nightly toolchain
miri:
    rustup component add --toolchain nightly miri rust-src
    cargo +nightly miri test --target arm-unknown-linux-gnueabi -p fluisim-c --test fields --test same_bits

# The C library as packages for Arduino, CMake and ESP-IDF: zips in tests/on-target/target/c/packages
pack:
    tests/on-target/run --pack

# The pictures of the README, made anew
pictures:
    cargo run --release -p sph-host --example pendant_gif -- docs/pictures/pendant.gif
    cargo run --release -- run --out target/dam-break --force --quiet
    cp target/dam-break/frame_0025.png docs/pictures/dam-break.png
    cp target/dam-break/front.png docs/pictures/front.png
    cargo run --release -- sample demo:vortex --grid 256,256 --quantity velocity_x --gradient --estimate corrected --out docs/pictures/vortex.png --force
    tests/on-target/run --only board --update
