#!/bin/sh
# The test library itself: a test that should fail must fail.
. "$(dirname "$0")/lib.sh"

# try BODY: runs a test of that body; leaves its output in the file tap and its exit in $code.
try() {
    mkdir -p tests
    { echo ". '$here/lib.sh'"; echo "$1"; } >tests/try.sh
    code=0
    TMPDIR=$scratch sh tests/try.sh >tap 2>&1 || code=$?
}

passes() { # passes DESCRIPTION BODY
    try "$2; done_testing"
    is "$1" "$code $(tail -n 1 tap)" '0 1..1'
}

fails() {
    try "$2; done_testing"
    like "$1" "$code $(head -n 1 tap)" '^1 not ok 1'
}

passes 'ok: a command that succeeds' 'ok x true'
fails 'ok: a command that fails' 'ok x false'
fails 'ok: a command that is missing' 'ok x no-such-command'
fails 'ok: a function that fails in the middle' 'f() { false && true; }; ok x f'
passes 'is: equal texts' 'is x "a b" "a b"'
fails 'is: other texts' 'is x a b'
passes 'like: a pattern' 'like x "one two" "t.o$"'
fails 'like: no such pattern' 'like x "one two" "^two"'
fails 'same: other files' 'echo 1 >a; echo 2 >b; same x a b'
passes 'must_fail: that code' 'ok x must_fail 3 sh -c "exit 3"'
fails 'must_fail: success' 'ok x must_fail 3 true'
fails 'must_fail: another code' 'ok x must_fail 3 sh -c "exit 4"'
fails 'must_fail: death by a signal' 'ok x must_fail 3 sh -c "kill -SEGV \$\$"'
fails 'must_fail: not even when asked for' 'ok x must_fail 139 sh -c "kill -SEGV \$\$"'
fails 'must_fail: a sanitizer report' 'ok x must_fail 99 sh -c "exit 99"'
fails 'must_fail: a missing program' 'ok x must_fail 127 no-such-program'
passes 'must_fail: leaves what was said' 'must_fail 2 sh -c "echo no >&2; exit 2" >log; is x "$(cat err)" no'
try 'skip x why; done_testing'
is 'skip passes and says why' "$code $(head -n 1 tap)" '0 ok 1 - x # SKIP why'
try 'skip_all why'
is 'skip_all skips' "$code $(cat tap)" '0 1..0 # SKIP why'
try 'ok x true; exit 0'
like 'a test that ends early has no plan' "$(grep -c '^1\.\.' tap)" '^0$'

rm -rf kitsuke-test-*
try 'ok x touch file; done_testing'
is 'the scratch folder goes' "$(ls -d kitsuke-test-* 2>/dev/null)" ''
try 'ok x false; done_testing'
like 'and is kept after a failure' "$(ls -d kitsuke-test-*)" 'kitsuke-test-'
done_testing
