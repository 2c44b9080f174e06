#!/bin/bash
# A campaign of faults (make test-faults; FAULTS=20 makes it shorter): whatever happens to a run, every
# file that it leaves is whole, and --resume ends with the bytes of a run to which nothing happened.
# First at random moments, then at every single call (tests/faults.c).
[ -w /dev/shm ] && [ -z "${TMPDIR:-}" ] && export TMPDIR=/dev/shm # in memory, for every run waits for its disk
. "$(dirname "$0")/lib.sh"

FAULTS=${FAULTS:-100}
RANDOM=${FAULTS_SEED:-1}
mkdir -p in/b
cp "$root/garments/skirt.garment" "$root/garments/trousers.garment" .
for steps in 1 2 3; do "$KITSUKE" walk --preset paper --frames-per-step 8 --steps $steps -o in/walk$steps.bvh; done
cp in/walk2.bvh in/b/walk2.bvh
"$KITSUKE" walk --preset paper --frames-per-step 8 --steps 60 -o in/long.bvh # two chunks
printf 'no motion\n' >in/bad.bvh
args=(in -g skirt.garment -g trousers.garment --no-times --detail 2 --body-detail 8 --frames ::12 -j 3 --format obj,drc)
dress() { "$KITSUKE" dress "${args[@]}" "$@"; }

must_fail 3 dress -o whole -q >log || exit 1
start=$(date +%s%N)
must_fail 3 dress -o timed -q >log || exit 1
lasts=$((($(date +%s%N) - start) / 1000000)) # milliseconds
rm -r timed
echo "# an undisturbed run writes $(find whole -type f | wc -l) files in $lasts ms"

# Every file is either as in the whole run, or a temporary or a lock, or a record or summary in the making.
torn() { # torn FOLDER: prints what is neither
    [ ! -d "$1" ] || diff -rq whole "$1" |
        grep -v -e '^Only in whole' -e '\.tmp$' -e '\.lock$' -e '/summary\.csv differ$'
}
is_sound() { # no torn file, and resumed the same bytes
    local bad
    bad=$(torn "$1")
    [ -z "$bad" ] || { echo "torn: $bad"; return 1; }
    must_fail 3 dress -o "$1" --resume -q || return 1
    diff -r whole "$1"
}
after() { # after MILLISECONDS SIGNAL ARGUMENT...: what the run that was hit so long after its start returned
    local ms=$1 signal=$2 pid code=0
    shift 2
    "$KITSUKE" dress "${args[@]}" -q "$@" 2>hit.err &
    pid=$!
    sleep "$(printf '%d.%03d' $((ms / 1000)) $((ms % 1000)))"
    kill -s "$signal" "$pid" 2>/dev/null
    wait "$pid" 2>/dev/null || code=$?
    return $code
}

# Killed at any moment, once or again while it resumes.
kills=0 rounds=0
killed() {
    while [ $kills -lt "$FAULTS" ]; do
        rm -rf out.d
        rounds=$((rounds + 1))
        local again=$((RANDOM % 3 + 1))
        for ((i = 0; i < again; i++)); do
            after $((RANDOM % (lasts + lasts / 4))) KILL -o out.d --resume
            [ $? -eq 137 ] && kills=$((kills + 1))
            local bad
            bad=$(torn out.d)
            [ -z "$bad" ] || { echo "torn: $bad"; return 1; }
        done
        is_sound out.d || return 1
    done
    find out.d -name '*.lock' -o -name '*.tmp' | grep . && return 1
    return 0
}
ok "kill -9, $FAULTS times" killed
echo "# $kills kills in $rounds runs"

for signal in INT TERM; do
    signalled() {
        for ((n = 0; n < FAULTS / 10 + 1; n++)); do
            rm -rf out.d
            local code=0
            after $((RANDOM % lasts)) $signal -o out.d || code=$?
            # killed before it listens, interrupted, or just done
            case $code in 130 | 143 | 3) ;; *) echo "exit $code"; cat hit.err; return 1 ;; esac
            [ $code -ne 130 ] || [ ! -s hit.err ] || grep -q -e '--resume' hit.err || { cat hit.err; return 1; }
            [ $code -eq 143 ] || [ -z "$(find out.d -name '*.tmp' -o -name '*.lock' 2>/dev/null)" ] || return 1
            is_sound out.d || return 1
        done
    }
    ok "SIG$signal at random moments" signalled
done
pipe() { # the reader of stderr goes away at once
    rm -rf out.d
    { dress -o out.d --verbose --progress always; echo $? >code; } 2>&1 | true
    [ "$(cat code)" -eq 3 ] && diff -r whole out.d
}
ok 'SIGPIPE: nobody reads what it says' pipe

# Disks that are full at any byte
mkdir disk
if mount -t tmpfs -o size=64k none disk 2>log; then
    need=$(($(du -sk whole | cut -f 1) + 64))
    full() {
        local code n=$((FAULTS / 2)) failed=0
        for ((i = 0; i < n; i++)); do
            umount disk
            mount -t tmpfs -o "size=$((8 + need * i / n))k" none disk
            code=0
            dress -o disk/out -q 2>full.err || code=$?
            [ $code -ne 4 ] || failed=$((failed + 1))
            [ $code -eq 3 ] || { [ $code -eq 4 ] && grep -q 'No space left' full.err; } ||
                { echo "exit $code"; cat full.err; return 1; }
            [ -z "$(find disk -name '*.tmp' -o -name '*.lock')" ] || { find disk -name '*.tmp'; return 1; }
            mount -o remount,size=200m disk
            is_sound disk/out || return 1
        done
        echo "$failed of $n disks were full" >full.log
        [ $failed -gt $((n / 2)) ]
    }
    ok 'a disk that is full at any byte' full
    sed 's/^/# /' full.log
    mount -o remount,ro disk
    ok 'a disk that is read-only: exit 4' must_fail 4 dress -o disk/other -q
    like 'with its reason' "$(cat err)" 'Read-only file system'
    ok 'a run on it that was finished: exit 4, and nothing is touched' must_fail 4 dress -o disk/out -q --resume
    ok 'it is whole' diff -r whole disk/out
    umount disk
else
    skip 'a disk that is full at any byte' 'cannot mount a small one'
    skip 'a disk that is read-only' 'cannot mount one'
fi

# Inputs that go or change while they are read: not before, for a file that was cut by then is a shorter motion.
gone() {
    local n t pid code
    for ((n = 0; n < 5; n++)); do
        rm -rf out.d
        cp in/long.bvh kept.bvh
        "$KITSUKE" dress "${args[@]}" -o out.d -q 2>err &
        pid=$!
        for ((t = 0; t < 500; t++)); do
            [ ! -e out.d/long ] || break
            sleep 0.01
        done
        sleep "0.$(printf '%03d' $((RANDOM % (lasts < 900 ? lasts : 900))))"
        if [ $((n % 2)) -eq 0 ]; then rm in/long.bvh; else head -c 5000 kept.bvh >in/long.bvh; fi
        code=0
        wait $pid || code=$?
        cp kept.bvh in/long.bvh
        [ $code -eq 3 ] || { echo "exit $code"; cat err; return 1; }
        is_sound out.d || return 1
    done
}
ok 'a motion that goes or is cut while it is read' gone

# Faults at every call, one after the other
if [ "$KITSUKE_BUILD" = san ] || ! ${CC:-cc} -shared -fPIC -O1 -Wl,-z,defs -o fault.so "$here/faults.c" -ldl 2>log; then
    skip 'faults at every call' 'the library that makes them cannot be built, or not be used with sanitizers'
    done_testing
fi
"$KITSUKE" walk --preset paper --frames-per-step 4 --steps 1 -o tiny.bvh
tiny=(dress tiny.bvh -g skirt.garment --frames 1:2 --no-times --detail 2 --body-detail 8 -q --resume)
rm -rf whole && "$KITSUKE" "${tiny[@]}" -o whole
under() { # under FAULT COMMAND...: under that fault; false where it did not come to it
    local fault=$1
    shift
    rm -f hit
    code=0
    FAULT=$fault FAULT_HIT=hit LD_PRELOAD=$PWD/fault.so "$@" >fault.out 2>fault.err </dev/null || code=$?
    [ -e hit ]
}
every() { # every KIND JOBS CODES: a run with that fault at the first call, the second, and so on, each resumed
    local n bad
    rm -rf out.d
    for ((n = 1; n < 10000; n++)); do
        under "$1:$n" "$KITSUKE" "${tiny[@]}" -o out.d -j "$2" || break
        case " $3 " in *" $code "*) ;; *) echo "$1:$n: exit $code"; cat fault.err; return 1 ;; esac
        [ "$code" -eq 0 ] || [ "$code" -eq 137 ] || [ -s fault.err ] || { echo "$1:$n: no message"; return 1; }
        bad=$(torn out.d)
        [ -z "$bad" ] || { echo "$1:$n: torn: $bad"; return 1; }
        [ "$code" -eq 137 ] || [ -z "$(find out.d -name '*.tmp' 2>/dev/null)" ] || { echo "$1:$n: .tmp"; return 1; }
        { "$KITSUKE" "${tiny[@]}" -o out.d && diff -r whole out.d; } || { echo "$1:$n: not resumed"; return 1; }
        rm -rf out.d
    done
    echo "$1, on $2 threads: $((n - 1)) calls" >>calls
    diff -r whole out.d && [ $n -gt 30 ]
}
: >calls
# exit 0: the lock could not be closed, which is nothing lost
ok 'no space left at any one call that changes a file' every write 1 '0 4'
ok 'nor at any behind it' every full 1 '0 4'
ok 'killed in front of every such call' every kill 1 137
ok 'and on two threads' every kill 2 137
ok 'no memory at any one allocation' every memory 1 '0 3 4 5'
short() { under short:1 "$KITSUKE" "${tiny[@]}" -o short; [ "$code" -eq 0 ] && diff -r whole short; }
ok 'writes that take but half of what they get' short

# A folder whose names cannot all be had may hold anything
cp -r whole listed
kept() { # kept MESSAGE ARGUMENT...: a run that cannot list the folder says so, and leaves what is there
    local message=$1 code
    shift
    under list:1 "$KITSUKE" "${tiny[@]::${#tiny[@]}-1}" -o listed "$@"
    [ "$code" -eq 4 ] && grep "$message" fault.err && diff -r -x .done -x summary.csv whole listed
}
ok 'a folder that cannot be listed is not taken for empty' kept 'holds files of an earlier run'
ok 'nor for cleared' kept "cannot list the folder 'listed/tiny'" --force

# Every other command, where each allocation fails once: the same output, or none and the reason
frugal() { # frugal ARGUMENT...: ends with the output in the file or folder `made`
    local n
    rm -rf made wanted
    "$KITSUKE" "$@" >wanted.out || return 1
    [ ! -e made ] || mv made wanted
    for ((n = 1; n < 20000; n++)); do
        rm -rf made
        under memory:$n "$KITSUKE" "$@" || break
        case $code in
        0) cmp wanted.out fault.out && { [ ! -e wanted ] || diff -r wanted made; } || { echo "memory:$n"; return 1; } ;;
        3 | 4 | 5)
            [ -s fault.err ] || { echo "memory:$n: no message"; return 1; }
            [ "$1" != compare ] || [ ! -s fault.out ] || { echo "memory:$n: a table"; return 1; }
            ;;
        *) echo "memory:$n: exit $code"; cat fault.err; return 1 ;;
        esac
        [ -z "$(find . -name '*.tmp')" ] || { echo "memory:$n: .tmp"; return 1; }
    done
    echo "$1: $((n - 1)) allocations" >>calls
    [ $n -gt 1 ]
}
cloth=(-g skirt.garment --frames 1:2 --detail 2 --body-detail 8)
cp -r whole shard && "$KITSUKE" dress tiny.bvh "${cloth[@]}" -o shard --shard 1/1 -q --force
"$KITSUKE" dress tiny.bvh "${cloth[@]}" --no-times --print-job >tiny.job
ok 'no memory: walk' frugal walk --preset paper --steps 1 -o made
ok 'no memory: inspect' frugal inspect tiny.bvh skirt.garment "$root/garments/adult.body"
ok 'no memory: draw' frugal draw tiny.bvh "${cloth[@]}" -o made
ok 'no memory: compare' frugal compare tiny.bvh "${cloth[@]}" --repeat 1 --no-times -q -o made
ok 'no memory: verify' frugal verify whole --quiet
ok 'no memory: a merge' frugal dress --merge shard -o made -q
ok 'no memory: a job' frugal dress --job tiny.job -o made -q --format obj
sed 's/^/# /' calls

# A thread that comes late to its own motion, when others have dressed it, and helps with the next one
mkdir late && cp tiny.bvh late/a.bvh && cp in/long.bvh late/b.bvh
late=(dress late -g skirt.garment --no-times --detail 2 --body-detail 8 --frames ::8 --format none -q)
"$KITSUKE" "${late[@]}" -o prompt -j 1
late() { under late:30 "$KITSUKE" "${late[@]}" -o later -j 3; [ "$code" -eq 0 ] && diff -r prompt later; }
ok 'threads that dress what others have opened' late
done_testing
