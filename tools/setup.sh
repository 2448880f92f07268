#!/usr/bin/env bash
# Installs what building and running need and this machine lacks: Vulkan loader, a Vulkan driver, shaderc's libraries and a C++
# compiler; with --tests also Mesa's software driver, the validation layers, Xvfb, an X server without a screen, and what opens windows there. Does
# nothing, quickly, when all is there.
set -euo pipefail
. "$(dirname "$0")/common.sh"

tests=false
case "${1:-}" in
    '') ;;
    --tests) tests=true ;;
    *) fail "usage: tools/setup.sh [--tests]" ;;
esac

has_library() {
    { ldconfig -p || /sbin/ldconfig -p; } 2>/dev/null | grep -F "$1" >/dev/null
}

# Whether a driver manifest whose name matches $1 is installed.
has_driver() {
    compgen -G "/usr/share/vulkan/icd.d/$1" >/dev/null || compgen -G "/etc/vulkan/icd.d/$1" >/dev/null
}

has_layer() {
    compgen -G "/usr/share/vulkan/explicit_layer.d/*$1*" >/dev/null || compgen -G "/etc/vulkan/explicit_layer.d/*$1*" >/dev/null
}

# Whether the static library $1 is where the build looks for it.
has_archive() {
    local dir
    for dir in "${SHADERC_LIB_DIR:-}" "${VULKAN_SDK:+$VULKAN_SDK/lib}" "/usr/lib/$(uname -m)-linux-gnu" /usr/lib64 /usr/lib /usr/local/lib; do
        if [ -n "$dir" ] && [ -f "$dir/lib$1.a" ]; then
            return 0
        fi
    done
    return 1
}

# Prints the Debian packages that are still needed.
missing_packages() {
    has_library libvulkan.so.1 || echo libvulkan1
    if $tests; then
        has_driver 'lvp_icd*.json' || echo mesa-vulkan-drivers
        has_layer khronos_validation || echo vulkan-validationlayers
        have Xvfb || echo xvfb
        have xdotool || echo xdotool
        # What winit loads when it opens a window.
        has_library libX11-xcb.so.1 || echo libx11-xcb1
        has_library libXcursor.so.1 || echo libxcursor1
        has_library libXi.so.6 || echo libxi6
        has_library libxkbcommon-x11.so.0 || echo libxkbcommon-x11-0
    else
        has_driver '*.json' || echo mesa-vulkan-drivers
    fi
    have c++ || echo g++
    has_archive shaderc_combined || echo libshaderc-dev
    # A combined archive from elsewhere needs no companions.
    if [ -z "${SHADERC_LIB_DIR:-}${VULKAN_SDK:-}" ]; then
        has_archive glslang || echo glslang-dev
        has_archive SPIRV-Tools-opt || echo spirv-tools
    fi
}

as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif have sudo; then
        sudo "$@"
    else
        fail "not root and no sudo; as root run: apt-get install ${missing[*]}"
    fi
}

install_packages() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
}

mapfile -t missing < <(missing_packages)
if [ "${#missing[@]}" = 0 ]; then
    exit 0
fi

if ! have apt-get; then
    cat >&2 <<MESSAGE
error: this machine lacks what these Debian packages hold: ${missing[*]}
Install their equivalents, then run this again:
  Fedora  vulkan-loader mesa-vulkan-drivers vulkan-validation-layers gcc-c++ and the Vulkan SDK with VULKAN_SDK set
  Arch    vulkan-icd-loader vulkan-swrast vulkan-validation-layers gcc shaderc
  other   the Vulkan SDK with VULKAN_SDK set, and a C++ compiler
Without shaderc's static libraries, cargo can build them: --features osculate-shader-compiler/build-from-source.
MESSAGE
    exit 1
fi

echo "Installing ${missing[*]}"
# A fresh image has no package lists.
if ! apt-cache show "${missing[@]}" >/dev/null 2>&1; then
    as_root apt-get update
fi
install_packages "${missing[@]}" || { as_root apt-get update && install_packages "${missing[@]}"; }

mapfile -t missing < <(missing_packages)
[ "${#missing[@]}" = 0 ] || fail "still missing after the installation: ${missing[*]}"
