#!/bin/sh
# Many motions: parts of a list and their summaries, progress for programs, bounds, chunks, hostile names.
. "$(dirname "$0")/lib.sh"

skirt=$root/garments/skirt.garment
mkdir -p in/deep
for steps in 1 2 3 4 5; do "$KITSUKE" walk --preset paper --frames-per-step 4 --steps $steps -o in/walk$steps.bvh; done
cp in/walk3.bvh in/deep/walk3.bvh
cp in/walk1.bvh in/deep/walk1.bvh
printf 'no motion\n' >in/bad.bvh
dress() { "$KITSUKE" dress -q --no-times --body-detail 8 --detail 2 -g "$skirt" "$@"; }
shards() { # shards N FOLDER ARGUMENT...: all parts, the last one first
    n=$1 folder=$2
    shift 2
    for k in $(awk "BEGIN { for (k = $n; k > 0; k--) print k }"); do
        dress in --shard "$k/$n" -o "$folder" "$@" || [ $? -eq 3 ] || return 1
    done
}

must_fail 3 dress in -o whole >log
ok 'three shards in one folder' shards 3 parts
is 'each has its summary' "$(cd parts && echo summary.*)" 'summary.1-of-3.csv summary.2-of-3.csv summary.3-of-3.csv'
like 'which tells its part' "$(tail -n 1 parts/summary.2-of-3.csv)" '^# shard 2 of 3 of 8 motions$'
ok 'their summaries are joined' "$KITSUKE" dress --merge parts -q
same 'into that of a single run' parts/summary.csv whole/summary.csv
ok 'and all the rest is that of a single run' diff -r -x 'summary.*-of-*' parts whole
ok 'more shards than motions' shards 11 many
ok 'can be joined too' "$KITSUKE" dress --merge many -q
same 'to the same' many/summary.csv whole/summary.csv
ok 'shards on different machines' eval 'shards 2 far && mkdir a b && mv far/summary.1-of-2.csv a && mv far/summary.2* b'
ok 'are joined where -o says' "$KITSUKE" dress --merge b a -o joined -q
same 'to the same, in any order' joined/summary.csv whole/summary.csv
ok 'several folders need -o' must_fail 2 "$KITSUKE" dress --merge a b
ok 'a shard that is missing: exit 3' must_fail 3 "$KITSUKE" dress --merge a
like 'with its number' "$(cat err)" 'shard 2 of 2 is missing'
ok 'a shard twice: exit 3' must_fail 3 "$KITSUKE" dress --merge a a -o joined
sed '/^walk2,/d' a/summary.1-of-2.csv >b/summary.1-of-2.csv
ok 'a shard that lacks rows: exit 3' must_fail 3 "$KITSUKE" dress --merge b
(grep '^#' a/summary.1-of-2.csv | sed '$d'; grep '^motion,' a/summary.1-of-2.csv
    echo '# shard 1 of 2147483647 of 2147483647 motions') >b/summary.1-of-2.csv
ok 'nor one of more shards than there can be: exit 3' must_fail 3 "$KITSUKE" dress --merge b
like 'which is said' "$(cat err)" 'holds 0 motions, which do not fit its shard 1 of 2147483647 of 2147483647'
cp in/walk1.bvh b/summary.1-of-2.csv
ok 'what is no summary: exit 3' must_fail 3 "$KITSUKE" dress --merge b
ok 'no folder: exit 3' must_fail 3 "$KITSUKE" dress --merge nowhere
ok 'nothing to merge: exit 2' must_fail 2 "$KITSUKE" dress --merge
same 'what failed left the old one' joined/summary.csv whole/summary.csv
dress in/walk1.bvh -o one
dress in/walk2.bvh -o two
"$KITSUKE" dress --merge two one -o both -q
is 'summaries of different lists follow one another' \
    "$(awk -F, '/,ok,/ { printf "%s ", $1 }' both/summary.csv)" 'walk2 walk1 '
(dress in/walk1.bvh -o timed && "$KITSUKE" dress -q -f -g "$skirt" in/walk1.bvh -o timed) >log
ok 'those of runs with and without times have other columns: exit 3' \
    must_fail 3 "$KITSUKE" dress --merge one timed -o both
like 'and are named' "$(cat err)" "'one/summary.csv' and 'timed/summary.csv' have different columns"
resumed() { rm -r parts/walk2 && must_fail 3 dress in --resume -o parts && diff -r -x 'summary.*-of-*' parts whole; }
ok 'one run may finish what shards began' resumed
for part in 0/3 4/3 3 a/b 1/0 1/3/2 1.5/3; do
    ok "--shard $part: exit 2" must_fail 2 "$KITSUKE" dress in -g "$skirt" -o none --shard $part
done

# Progress as JSON
"$KITSUKE" dress in -g "$skirt" -o json --progress json --format none 2>err
last=$(grep '^{' err | tail -n 1)
like 'the last line of JSON' "$last" \
    '^{"motions":8,"done":8,"failed":1,"frames":76,"seconds":[0-9.]+,.*,"part":1.0000,"finished":true}$'
if command -v python3 >log; then
    grep '^{' err >lines
    ok 'every line of it is JSON' python3 -c 'import json; [json.loads(line) for line in open("lines")]'
else
    skip 'every line of it is JSON' 'no python3'
fi

"$KITSUKE" dress in -g "$skirt" -o line --progress always --format none 2>err
like 'the line tells how many have failed' "$(tr '\r' '\n' <err)" '[0-9]/8 motions, 1 failed, '

# Bounds
refuses() { # refuses PATTERN ARGUMENT...
    pattern=$1
    shift
    must_fail 3 dress in/walk2.bvh -o bounds "$@" && says "$pattern" && [ ! -e bounds/walk2 ]
}
ok '--max-frames refuses' refuses 'in/walk2.bvh:[0-9]+:9: error: 8 frames are more than the limit of 7' --max-frames 7
ok 'and what --rate makes of them' refuses "'in/walk2.bvh' has [0-9]+ frames at 1000 a second, more .* limit of 8" \
    --max-frames 8 --rate 1000
ok '--max-joints: so is one of more joints' refuses 'more than 5 joints' --max-joints 5
ok 'limits that are just kept' dress in/walk2.bvh -o bounds --max-frames 8 --max-joints 100
ok '--max-memory: exit 3' must_fail 3 dress in/walk2.bvh -o memory --max-memory 1
like 'says what was allowed' "$(cat err)" 'needs more memory than the limit of 1 MB'
like 'and counts as refused' "$(cat memory/summary.csv)" '^walk2,skirt,refused,'
ok 'and writes nothing' test ! -e memory/walk2
ok '--max-memory that suffices' dress in/walk2.bvh -o memory --max-memory 200

# Chunks: a long motion in pieces, the same whatever the number of threads
"$KITSUKE" walk --preset paper --frames-per-step 8 --steps 80 -o long.bvh
chunks() { dress long.bvh -o "chunks$1" -j "$1" --format none "${2:---no-body}" "${3:---no-body}"; }
ok 'a motion of 640 frames on one thread' chunks 1
ok 'the same motion on two' chunks 2
ok 'and on five' chunks 5
ok 'write the same bytes' eval 'diff -r chunks1 chunks2 && diff -r chunks1 chunks5'
# Every chunk but the first begins with the cloth of the one before.
steady() { awk -F, '/^#/ { next } !at { for (i = 1; i <= NF; i++) if ($i == "restarted") at = i; next }
    $1 != ++n || $at != (n == 1) { bad = 1 } END { exit bad || n != 640 }' chunks1/long/stats.csv; }
ok 'every frame once, in order, and nothing starts afresh in between' steady
part() { # the frames round the second chunk, alone, after a warm-up of their own
    dress long.bvh -o part --frames 180:300 --format obj && dress long.bvh -o full --format obj --frames 100:300 &&
        cmp part/long/skirt.0290.obj full/long/skirt.0290.obj
}
ok 'a selection shows the same frames' part
# Less than 18 seconds of 66 frames are not cut; a longer walk is, behind 12 seconds.
"$KITSUKE" walk --preset paper --steps 34 -o fine.bvh
numbers() { sed -n 's/^v //p' "$1" | tr ' ' '\n'; }
alike() {
    awk '/^Frames:/ { $2 = 1187 } /^Frame Time/ { n = 1188 } { print } n && !--n { exit }' fine.bvh >whole.bvh
    for motion in whole fine; do
        "$KITSUKE" dress $motion.bvh -q -g "$root/garments/paper-skirt.garment" --body-detail 8 --detail 2 --no-times \
            --topology fixed --format obj --no-body --frames 600:840 -o cut || return 1
    done
    for frame in $(seq 793 840); do
        numbers cut/whole/paper-skirt.0$frame.obj >a.txt
        numbers cut/fine/paper-skirt.0$frame.obj >b.txt
        paste a.txt b.txt | awk '{ d = $1 - $2; if (d > 1.5e-6 || d < -1.5e-6) exit 1 }' || return 1
    done
}
ok 'a chunk begins with the cloth of the one before' alike
one_job() {
    head -c $(($(wc -c <long.bvh) - 20)) long.bvh >broken.bvh
    "$KITSUKE" dress broken.bvh -g "$skirt" -o broken --format none -j 4 2>err
    grep -q 'ends within frame 640' err && [ "$(grep -c '^[0-9]' broken/broken/stats.csv)" -eq 639 ]
}
ok 'a motion that is cut at its end' one_job

# Names that want out of the folder, or are not for every system
mkdir -p 'names/...' 'names/a
b' names/con names/.hidden
long=$(awk 'BEGIN { for (i = 0; i < 250; i++) printf "n" }')
for name in '.../...bvh' 'a
b/c	d.bvh' con/aux.bvh '.hidden/.done.bvh' "$long.bvh" 'x.done.bvh' 'summary.csv.lock.bvh' 'Stats.CSV.bvh' '*?.bvh' \
    '"quoted", with comma.bvh' '#.bvh' "$(printf '\377\376.bvh')" '~.bvh' '$(touch out).bvh' '.bvh'; do
    cp in/walk1.bvh "names/$name"
done
printf 'names/%s\n' ../names/con/aux.bvh ../../../../../../../../../../../tmp/../etc/passwd.bvh '%s%n.bvh' >list
cp in/walk1.bvh 'names/%s%n.bvh'
mkdir -p cage/inner
find names -name '*.bvh' -print0 >all
tr '\n' '\000' <list >>all
hostile() {
    must_fail 3 dress --files-from all -o cage/inner/out --format none
}
ok 'hostile names: all but the one that does not exist are dressed' hostile
is 'nothing outside of the folder' \
    "$(cd cage && find . -mindepth 1 -maxdepth 2 | sort | tr '\n' ' ')" './inner ./inner/out '
is 'no control byte in a name' \
    "$(find cage | tr -d '\n' | tr -d -c '\001-\037\177' | wc -c | tr -d ' ')" 0
is 'nor one that another system does not take' "$(find cage | grep '[\\:*?"<>|]')" ''
is 'nor one that a file of ours may have, on any disk' \
    "$(find cage/inner/out -mindepth 1 -type d | grep -Ei '\.(obj|drc|csv|tmp|lock|done)$')" ''
is 'every motion has a folder of its own' "$(find cage -name stats.csv | wc -l | tr -d ' ')" \
    "$(grep -c ',ok,' cage/inner/out/summary.csv)"
like 'as many as there were' "$(grep -c ',ok,' cage/inner/out/summary.csv)" '^1[5-9]$'
hostile_message() {
    must_fail 3 dress "$(printf 'a\nb.bvh')" -o cage/inner/none --format none &&
        says '^kitsuke: cannot open .a[?]b[.]bvh'
}
ok 'a message shows no control byte of a name' hostile_message
ok 'they can be resumed' eval 'must_fail 3 dress --files-from all -o cage/inner/out --format none --resume --strict'
is 'a summary has a line for each row' "$(awk -F, 'NR > 3 && !/,(ok|refused|failed),/' cage/inner/out/summary.csv)" ''
done_testing
