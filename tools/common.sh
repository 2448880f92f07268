# Sourced by the other scripts: goes to the repository root and finds cargo.

cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
    printf 'error: %s\n' "$*" >&2
    exit 1
}

have() {
    command -v "$1" >/dev/null 2>&1
}

# rustup installs below the home directory, which shells read only at login.
find_cargo() {
    if ! have cargo && [ -f "${CARGO_HOME:-$HOME/.cargo}/env" ]; then
        # shellcheck source=/dev/null
        . "${CARGO_HOME:-$HOME/.cargo}/env"
    fi
    have cargo || fail "cargo was not found; install Rust with rustup (https://rustup.rs), then run this again"
}
