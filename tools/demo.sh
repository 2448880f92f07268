#!/usr/bin/env bash
# Installs what is missing, builds in release and renders a cage to dragon.png.
set -euo pipefail
. "$(dirname "$0")/common.sh"

tools/setup.sh
find_cargo
cargo build --release --locked --package osculate-cli
"${CARGO_TARGET_DIR:-target}/release/osculate" render assets/cages/dragon.obj -o dragon.png
echo "Wrote $PWD/dragon.png"
