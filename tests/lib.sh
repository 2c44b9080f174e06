# TAP for shell tests. A test begins with
#     . "$(dirname "$0")/lib.sh"
# and ends with done_testing. It runs in a scratch folder of its own, which is kept when
# something failed. Environment: KITSUKE the program, KITSUKE_BUILD its build,
# KITSUKE_MOTIONS a folder of real motions.
#
#     ok 'says what' COMMAND...          passes where the command succeeds
#     is 'says what' GOT WANTED          equal texts
#     like 'says what' GOT PATTERN       a line of GOT matches the extended regular expression
#     same 'says what' FILE GOLDEN       equal files; UPDATE_GOLDEN=1 writes GOLDEN anew
#     must_fail CODE COMMAND...          for ok: exactly that exit code; stdout and stderr are
#                                        left in the files out and err
#     says PATTERN                       for ok: a line of that err matches
#     column NAME FILE                   the values of a column of a CSV file, one in a line
#     joined NAME FILE                   all in one, a space behind each
#     skip 'says what' 'why'             a test that cannot be made here
#     skip_all 'why'                     nor any of them
set -u
LC_ALL=C
ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}exitcode=99
UBSAN_OPTIONS=${UBSAN_OPTIONS:+$UBSAN_OPTIONS:}exitcode=99
export LC_ALL ASAN_OPTIONS UBSAN_OPTIONS
unset CDPATH

here=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$here")
KITSUKE=${KITSUKE:-$root/build/kitsuke}
KITSUKE_BUILD=${KITSUKE_BUILD:-release}
KITSUKE_MOTIONS=${KITSUKE_MOTIONS:-../shared/motions}
case $KITSUKE in /*) ;; *) KITSUKE=$PWD/$KITSUKE ;; esac
case $KITSUKE_MOTIONS in /*) ;; *) KITSUKE_MOTIONS=$root/$KITSUKE_MOTIONS ;; esac
export KITSUKE KITSUKE_BUILD KITSUKE_MOTIONS

tests=0 failures=0
scratch=$(mktemp -d "${TMPDIR:-/tmp}/kitsuke-test-XXXXXX") || { echo 'Bail out! mktemp failed'; exit 1; }
cd "$scratch" || exit 1
trap 'if [ "$failures" -eq 0 ]; then chmod -R u+w "$scratch"; rm -rf "$scratch"; else echo "# kept: $scratch"; fi' EXIT
trap 'exit 130' INT TERM HUP

result() { # result CODE DESCRIPTION: the log explains a failure
    tests=$((tests + 1))
    if [ "$1" -eq 0 ]; then
        echo "ok $tests - $2"
    else
        failures=$((failures + 1))
        echo "not ok $tests - $2"
        sed 's/^/#   /' log | head -n 40
    fi
}

ok() {
    description=$1
    shift
    code=0
    "$@" >log 2>&1 </dev/null || code=$?
    [ "$code" -eq 0 ] || echo "exit $code: $*" >>log
    result "$code" "$description"
}

is() {
    printf 'got    %s\nwanted %s\n' "$2" "$3" >log
    [ "$2" = "$3" ]
    result $? "$1"
}

like() {
    printf 'got    %s\nwanted %s\n' "$2" "$3" >log
    printf '%s\n' "$2" | grep -Eq -e "$3"
    result $? "$1"
}

same() {
    [ -z "${UPDATE_GOLDEN:-}" ] || cp "$2" "$3"
    diff -u "$3" "$2" >log 2>&1
    result $? "$1"
}

# Death by a signal, a missing program and a sanitizer's report are nothing that may be wanted.
must_fail() {
    wanted=$1 got=0
    shift
    "$@" >out 2>err </dev/null || got=$?
    sed 's/^/stderr: /' err
    if [ "$wanted" -eq 0 ] || [ "$wanted" -eq 99 ] || { [ "$wanted" -gt 125 ] && [ "$wanted" -ne 130 ]; }; then
        echo "exit code $wanted cannot be asked for"
        return 1
    fi
    [ "$got" -eq "$wanted" ] && return 0
    echo "exit code $got, wanted $wanted: $*"
    return 1
}

says() {
    grep -Eq -e "$1" err || { echo "stderr has no line like: $1"; cat err; return 1; }
}

column() {
    awk -F, -v name="$1" '/^#/ { next } at { print $at; next }
        { for (i = 1; i <= NF; i++) if ($i == name) at = i }' "$2"
}
joined() { column "$@" | tr '\n' ' '; }

skip() {
    tests=$((tests + 1))
    echo "ok $tests - $1 # SKIP $2"
}

skip_all() {
    echo "1..0 # SKIP $1"
    exit 0
}

done_testing() {
    echo "1..$tests"
    [ "$failures" -eq 0 ]
    exit
}
