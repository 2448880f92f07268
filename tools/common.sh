# Sourced by the other scripts: goes to the repository root, finds cargo, and chooses a driver.

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

# Without a GPU, names Mesa's software driver, so that the loader does not try the drivers of absent hardware.
choose_driver() {
    if [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] && ! compgen -G '/dev/dri/renderD*' >/dev/null \
        && ! compgen -G '/dev/nvidia[0-9]*' >/dev/null; then
        local manifest
        manifest=$(compgen -G '/usr/share/vulkan/icd.d/lvp_icd*.json' | head -n 1)
        export VK_DRIVER_FILES="$manifest" VK_ICD_FILENAMES="$manifest"
    fi
}
