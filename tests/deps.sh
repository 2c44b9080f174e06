#!/bin/sh
# What a fresh machine does: .ci/deps.sh among false package managers that only note what they
# are asked for.
. "$(dirname "$0")/lib.sh"
deps=$root/.ci/deps.sh

# machine UID PROGRAM...: a folder `bin` with only the tools of every system and false PROGRAMs.
# A false manager cannot update its list, but puts a c++ and a prove there, as the true one would.
machine() {
    rm -rf bin calls
    mkdir bin
    : >calls
    for tool in sh env tr cat chmod mktemp rm sed; do ln -s "$(command -v $tool)" bin/$tool; done
    program id "echo $1"
    shift
    for p; do
        case $p in
        c++) program c++ 'exit 0' ;;
        c++-without-draco) program c++ 'exit 1' ;;
        sudo) program sudo '[ "$1" = -n ] && shift' "echo sudo >>'$PWD/calls'" 'exec "$@"' ;;
        sudo-that-refuses) program sudo 'exit 1' ;;
        apt-get-that-fails) program apt-get 'exit 100' ;;
        *) program "$p" "echo \"$p \$*\" >>'$PWD/calls'" 'case "$*" in *update*) exit 1 ;; esac' \
            "cd '$PWD/bin' && for p in c++ prove; do rm -f \$p; echo '#!/bin/sh' >\$p; chmod +x \$p; done" ;;
        esac
    done
}

program() { # program NAME LINE...
    name=$1
    shift
    { echo '#!/bin/sh'; printf '%s\n' "$@"; } >"bin/$name"
    chmod +x "bin/$name"
}

run_deps() { # run_deps DEPS NEED...
    wish=$1
    shift
    env PATH="$PWD/bin" DEPS="$wish" CXX=c++ sh "$deps" "$@"
}

machine 0 c++ apt-get
ok 'nothing is missing' run_deps yes draco
is 'then nothing is called' "$(cat calls)" ''

machine 0 apt-get
ok 'root on Debian' run_deps yes draco
is 'installs compiler and Draco, though the update failed' "$(cat calls)" \
    "apt-get update
apt-get install -y --no-install-recommends g++ libdraco-dev"

machine 0 c++-without-draco apt-get
ok 'a compiler without Draco' run_deps yes draco prove
like 'installs only what is missing' "$(cat calls)" 'recommends libdraco-dev perl$'

machine 1000 apt-get sudo
ok 'a user with sudo' run_deps yes draco
is 'goes through sudo' "$(grep -c sudo calls)" 2

machine 1000 apt-get
ok 'a user without sudo is told' must_fail 1 run_deps yes draco
like 'the command' "$(cat err)" 'As root run: apt-get update; env .*apt-get install .* g\+\+ libdraco-dev'
is 'and nothing is called' "$(cat calls)" ''

machine 1000 apt-get sudo-that-refuses
ok 'where sudo refuses it stops' must_fail 1 run_deps yes draco
like 'and says what to install' "$(cat err)" 'Please install g\+\+ libdraco-dev'

machine 0 apt-get
ok 'DEPS=no forbids it' must_fail 1 run_deps no draco
like 'with the command' "$(cat err)" 'Install with: apt-get update; env .*apt-get install'
is 'and nothing is called' "$(cat calls)" ''

machine 0 apt-get-that-fails
ok 'a manager that fails' must_fail 1 run_deps yes draco
machine 0
ok 'no manager at all' must_fail 1 run_deps yes draco
like 'says so' "$(cat err)" 'no package manager'

for case in 'dnf:dnf install -y gcc-c++ draco-devel' 'pacman:pacman -Sy --noconfirm --needed gcc draco' \
    'zypper:zypper --non-interactive install gcc-c++ draco-devel' 'apk:apk add g++ draco-dev' \
    'brew:brew install gcc draco'; do
    machine 0 "${case%%:*}"
    ok "${case%%:*}" run_deps yes draco
    is "${case%%:*}: $(cat calls)" "$(cat calls)" "${case#*:}"
done
done_testing
