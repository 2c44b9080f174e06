#!/bin/sh
# --resume: what is finished is left alone, what is not is done, and in the end it is as if nothing had happened.
. "$(dirname "$0")/lib.sh"

mkdir in in/b
cp "$root/garments/skirt.garment" "$root/garments/trousers.garment" .
for steps in 1 2 3; do "$KITSUKE" walk --preset paper --frames-per-step 6 --steps $steps -o in/walk$steps.bvh; done
cp in/walk2.bvh in/b/walk2.bvh
printf 'no motion\n' >in/bad.bvh
small="--no-times --detail 2 --body-detail 8 -j 2"
# shellcheck disable=SC2086  # words
dress() { "$KITSUKE" dress in -g skirt.garment -g trousers.garment $small "$@"; }
dressed() { # dressed PATTERN ARGUMENT...: with these arguments the last line of stderr matches
    pattern=$1
    shift
    must_fail 3 dress "$@" || return 1
    tail -n 1 err | grep -Eq -e "$pattern" || { echo "no line like: $pattern"; return 1; }
}
again() { # again PATTERN ARGUMENT...: resumed on a copy of the whole run
    rm -rf out.d
    cp -R whole out.d
    dressed "$@" --resume -o out.d
}
is_whole() { diff -r whole out.d; }

ok 'a whole run' dressed '^4 of 5 motions dressed, 48 frames' -o whole
ok 'resumed: everything was done before' again '^4 of 5 motions dressed \(4 before\)$'
ok 'and it is the same, with its summary' is_whole
like 'what could not be read is read again' "$(cat err)" 'in/bad.bvh:1:1: error: '
ok 'into an empty folder it is a run like any other' dressed '^4 of 5 motions dressed, 48' --resume -o out2
ok 'of the same bytes' diff -r whole out2
cp -R whole kept
ok 'without it folders are refused' must_fail 4 dress in/walk1.bvh in/walk2.bvh in/walk3.bvh -o kept
like 'which tells about it' "$(cat err)" '--resume goes on'
ok 'and keep their summary' diff -r whole kept

touch -d '2001-01-01' in/walk1.bvh 2>log || touch -t 200101010000 in/walk1.bvh
mv skirt.garment moved.garment && cp moved.garment skirt.garment
ok 'dates do not count' again '\(4 before\)'
cp in/walk1.bvh kept.bvh
sed '$s/^[^ ]*/0.125/' kept.bvh >in/walk1.bvh
ok 'one number of one input does' again '\(3 before\), 6 frames'
ok 'and its motion is another' must_fail 1 diff -r whole out.d
cp kept.bvh in/walk1.bvh
ok 'the old input brings the old bytes back' dressed '\(3 before\), 6 frames' --resume -o out.d
ok 'and all is whole' is_whole
sed 's/^# .*/# changed/' moved.garment >skirt.garment
ok 'a changed garment: everything is done again' again ' dressed, 48 frames'
cp moved.garment skirt.garment
cp "$root/garments/adult.body" own.body
printf 'pelvis = Hips\n' >own.roles
own() { # own PATTERN: the last line of a resumed run
    "$KITSUKE" dress in/walk1.bvh -g skirt.garment --body own.body --roles own.roles -o own --format none \
        --resume 2>err && says "$1"
}
ok 'with a body and roles' eval 'own ", 6 frames" && own "1 before"'
for file in own.body own.roles; do
    echo '# changed' >>$file
    ok "$file is an input too" own ', 6 frames'
done
for option in '--detail 3' '--no-body' '--format obj' '--frames 1:5' '--rate 20' '--unit in' '--split uniform'; do
    # shellcheck disable=SC2086  # an option and its value
    ok "another option: $option" again '^4 of 5 motions dressed, ' $option
done
ok 'how it is done is no such option' again '\(4 before\)' -j 1 --verbose --progress never --max-joints 500
stale() { find out.d -name 'walk1' -exec sh -c 'ls "$1"' sh {} \; ; }
again ' dressed, ' --frames 1:2 --no-body --format obj >log
is 'of the old frames none is left' "$(stale | tr '\n' ' ')" \
    'skirt.0001.obj skirt.0002.obj stats.csv trousers.0001.obj trousers.0002.obj '

# Records that are missing or torn
partly() { # partly PATTERN COMMAND...: after COMMAND in a copy of the run
    pattern=$1
    shift
    rm -rf out.d
    cp -R whole out.d
    "$@" || return 1
    dressed "$pattern" --resume -o out.d && is_whole
}
tear() { head -c 400 out.d/walk3/.done >torn && mv torn out.d/walk3/.done; }
ok 'no record' partly '\(3 before\), 18 frames' rm out.d/walk3/.done
ok 'half a record' partly '\(3 before\), 18 frames' tear
ok 'an empty one' partly '\(3 before\), 18 frames' cp /dev/null out.d/walk3/.done
ok 'no summary' partly '\(4 before\)' rm out.d/summary.csv
ok 'no folder' partly '\(3 before\)' rm -r out.d/b/walk2
ok 'what a killed run leaves' partly '\(3 before\)' \
    sh -c 'cd out.d/walk3 && mv .done .done.tmp && mv stats.csv stats.csv.tmp'
long_ago() { # a temporary that is longer than what will stand there
    rm out.d/summary.csv
    seq 5000 >out.d/summary.csv.tmp
}
ok 'nothing of it is read again' partly '\(4 before\)' long_ago
asf() {
    printf ':version 1.10\n' >in/x.asf
    "$KITSUKE" dress in/walk1.bvh -g skirt.garment --no-times -o asf -q --resume
}
ok 'a skeleton beside a BVH file is none of its inputs' asf
rm in/x.asf
real=$KITSUKE_MOTIONS/cmu_02_03_run.amc
if [ -f "$real" ]; then
    mkdir acclaim
    cp "$real" acclaim/x.amc
    cat "${real%_03*}.asf" >acclaim/y.asf # which may be written, though the source may not
    skeleton() { # skeleton PATTERN ARGUMENT...: the last line of a resumed run
        pattern=$1
        shift
        "$KITSUKE" dress acclaim/x.amc -g skirt.garment -o amc --frames 1:2 --format none --resume "$@" 2>err &&
            says "$pattern"
    }
    for way in '' '--asf acclaim/y.asf'; do
        # shellcheck disable=SC2086  # an option and its value, or nothing
        ok "a skeleton is an input ${way:+(--asf)}" eval 'skeleton ", 2 frames" $way && skeleton "1 before" $way'
        echo '# changed' >>acclaim/y.asf
        # shellcheck disable=SC2086
        ok "and its motion is dressed anew when it changes ${way:+(--asf)}" skeleton ', 2 frames' $way
    done
else
    skip 'a skeleton is an input' 'no motions'
fi
ok '--strict is asked of what was done before too' again '\(4 before\)' --strict

# Killed, then resumed
killed() { # killed SECONDS
    rm -rf out.d
    "$KITSUKE" dress in -g skirt.garment -g trousers.garment $small -o out.d 2>log &
    pid=$!
    sleep "$1"
    kill -9 "$pid" 2>log
    wait "$pid" 2>log
    torn=$(find out.d -name '*.obj' -exec sh -c 'for f; do tail -n 1 "$f" | grep -q "^f " || echo "$f"; done' sh {} +)
    [ -z "$torn" ] || { echo "torn: $torn"; return 1; }
    dressed '^4 of 5' --resume -o out.d && is_whole
}
for seconds in 0.02 0.05 0.1; do ok "kill -9 after $seconds s" killed $seconds; done

# Two runs on one folder
mkfifo pipe
exec 3<>pipe
"$KITSUKE" dress - -g skirt.garment -o shared -q --no-times <pipe 2>first.err 3>&- &
first=$!
for _ in 1 2 3 4 5 6 7 8 9 10; do [ -e shared/.summary.csv.lock ] && break; sleep 0.1; done
ok 'a second run on the same folder is refused: exit 4' \
    must_fail 4 "$KITSUKE" dress in/walk1.bvh -g skirt.garment -o shared
like 'with the reason' "$(cat err)" 'another run is writing here'
cat in/walk1.bvh >pipe
exec 3>&-
wait $first
is 'the first one ends as it should' $? 0
is 'and no lock is left' "$(cd shared && find . -name '*.lock')" ''
ok 'then the second may' "$KITSUKE" dress in/walk1.bvh -g skirt.garment -o shared -q

# Runs with summaries of their own, as shards have, may still meet in one motion's folder.
if command -v flock >log; then
    mkdir -p held/walk1
    ok 'a motion that another run is at is refused: exit 4' \
        must_fail 4 flock held/walk1 "$KITSUKE" dress in/walk1.bvh -g skirt.garment -o held
    like 'with the reason too' "$(cat err)" "another run is writing here: 'held/walk1' is locked"
else
    skip 'a motion that another run is at is refused' 'no flock'
fi

# A file that grows beyond its limit
limited() { (ulimit -f 20 && must_fail 4 dress -o limit --format obj) && grep -q 'File too large' err; }
ok 'a limit of the size of files is an error, not a death' limited
ok 'and can be resumed from' dressed '^4 of 5' --resume -o limit
ok 'to the same bytes' diff -r whole limit
# What came through a pipe cannot be compared with what comes next.
through_pipe() { "$KITSUKE" dress in/walk1.bvh -g /dev/stdin -o piped --frames 1 --resume 2>err; }
through_pipe <skirt.garment
like 'a garment in a file is known again' "$(through_pipe <skirt.garment; tail -n 1 err)" '\(1 before\)'
sed 's/^ring hip .*/ring hip pelvis 0.4 ease 0.05/' skirt.garment | through_pipe
like 'one from a pipe is put on' "$(tail -n 1 err)" '^1 of 1 motion dressed, 1 frame,'
is 'and leaves no record' "$(ls piped/walk1/.done 2>/dev/null)" ''
cat skirt.garment | through_pipe
like 'so another one is not taken for it' "$(tail -n 1 err)" '^1 of 1 motion dressed, 1 frame,'
done_testing
