#!/usr/bin/env bash
# Installs what is missing, then runs every test. With OSCULATE_REFERENCE set to a folder of reference data, the tests that
# compare with it run too. Arguments go to `cargo test`.
set -euo pipefail
. "$(dirname "$0")/common.sh"

tools/setup.sh --tests
find_cargo

# Compiled shaders of the software driver: keeping them saves most of a second run.
export MESA_SHADER_CACHE_DIR="${MESA_SHADER_CACHE_DIR:-${CARGO_TARGET_DIR:-$PWD/target}/mesa-shader-cache}"
mkdir -p "$MESA_SHADER_CACHE_DIR"

choose_driver

if [ -n "${OSCULATE_REFERENCE:-}" ]; then
    [ -d "$OSCULATE_REFERENCE" ] || fail "OSCULATE_REFERENCE is not a folder: $OSCULATE_REFERENCE"
    cargo test --workspace --locked "$@" -- --include-ignored
else
    cargo test --workspace --locked "$@"
fi
