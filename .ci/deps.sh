#!/bin/sh
# Looks for what the build needs beyond make and a C compiler, and with DEPS=yes installs what
# is missing through the system's package manager. Else, or where it may not, it prints the
# command and fails.
#   deps.sh draco    a C++ compiler ($CXX) and the Draco library
#   deps.sh prove    the runner of the tests, a part of Perl
#   deps.sh WORD     a program of that name
set -u
CXX=${CXX:-c++} FLAGS=${FLAGS:-} DEPS=${DEPS:-no}

say() { echo "deps: $*" >&2; }

has_draco() {
    dir=$(mktemp -d) || return 1
    echo '#include <draco/compression/encode.h>
          int main() { draco::Encoder encoder; encoder.Reset(); }' >"$dir/try.cpp"
    # shellcheck disable=SC2086  # flags are words
    $CXX -std=c++17 "$dir/try.cpp" $FLAGS -ldraco -o "$dir/try" >/dev/null 2>&1
    found=$?
    rm -rf "$dir"
    return $found
}

# The names of the needs that are not met: cxx, draco, prove or a program.
missing() {
    for need; do
        case $need in
        draco)
            command -v "${CXX%% *}" >/dev/null 2>&1 || echo cxx
            has_draco || echo draco ;;
        *) command -v "$need" >/dev/null 2>&1 || echo "$need" ;;
        esac
    done
}

manager() {
    for m in apt-get dnf pacman zypper apk brew; do
        command -v $m >/dev/null 2>&1 && { echo $m; return; }
    done
}

# package MANAGER NEED: what the need is called there.
package() {
    case $1:$2 in
    apt-get:cxx) echo g++ ;;      apt-get:draco) echo libdraco-dev ;; apt-get:prove) echo perl ;;
    apt-get:draco_decoder) echo draco ;;
    apt-get:aarch64-linux-gnu-gcc) echo gcc-aarch64-linux-gnu libc6-dev-arm64-cross ;;
    apt-get:sbatch) echo slurm-client ;; apt-get:munged) echo munge ;;
    dnf:cxx) echo gcc-c++ ;;      dnf:draco) echo draco-devel ;;      dnf:prove) echo perl-Test-Harness ;;
    pacman:cxx) echo gcc ;;       pacman:draco) echo draco ;;         pacman:prove) echo perl ;;
    zypper:cxx) echo gcc-c++ ;;   zypper:draco) echo draco-devel ;;   zypper:prove) echo perl ;;
    apk:cxx) echo g++ ;;          apk:draco) echo draco-dev ;;        apk:prove) echo perl-utils ;;
    brew:cxx) echo gcc ;;         brew:draco) echo draco ;;           brew:prove) echo perl ;;
    *) echo "$2" ;;
    esac
}

# command MANAGER PREFIX PACKAGE...: one line of shell. A stale list of packages is no reason to
# stop, so apt-get's update may fail.
command_line() {
    manager=$1 sudo=$2
    shift 2
    case $manager in
    apt-get)
        echo "${sudo}apt-get update;" \
            "${sudo}env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $*" ;;
    dnf) echo "${sudo}dnf install -y $*" ;;
    pacman) echo "${sudo}pacman -Sy --noconfirm --needed $*" ;;
    zypper) echo "${sudo}zypper --non-interactive install $*" ;;
    apk) echo "${sudo}apk add $*" ;;
    brew) echo "brew install $*" ;;
    esac
}

lacking=$(missing "$@" | tr '\n' ' ')
[ -n "$lacking" ] || exit 0

manager=$(manager)
if [ -z "$manager" ]; then
    say "missing: $lacking"
    say "no package manager that this script knows; please install a C++ compiler, Draco with its headers, and prove"
    exit 1
fi
packages=$(for need in $lacking; do package "$manager" "$need"; done | tr '\n' ' ')
packages=${packages% }

# Root needs nothing, brew wants no root, others need sudo; without a terminal sudo must not ask.
sudo='sudo '
[ "$(id -u)" = 0 ] && sudo=''
[ "$manager" = brew ] && sudo=''
# shellcheck disable=SC2086
line=$(command_line "$manager" "$sudo" $packages)
if [ "$DEPS" != yes ]; then
    say "missing: $packages. Install with: $line"
    exit 1
fi
if [ -n "$sudo" ]; then
    if ! command -v sudo >/dev/null 2>&1; then
        say "missing: $packages. As root run: $(command_line "$manager" '' $packages)"
        exit 1
    fi
    [ -t 0 ] || line=$(command_line "$manager" 'sudo -n ' $packages)
fi
say "missing: $packages. Running: $line"
if ! sh -c "$line" >&2 || [ -n "$(missing "$@")" ]; then
    say "still missing: $(missing "$@" | tr '\n' ' '). Please install $packages"
    exit 1
fi
