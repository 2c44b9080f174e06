#!/bin/sh
# kitsuke dress from end to end: what is written where, the same bytes every time, and nothing lost.
. "$(dirname "$0")/lib.sh"

walk=$root/motions/paper-walk.bvh
skirt=$root/garments/skirt.garment
trousers=$root/garments/trousers.garment

dress() { "$KITSUKE" dress -q --no-times "$@"; }
list() { (cd "$1" && find . -type f ! -name .done | sort | tr '\n' ' '); }
count() { find "$1" -type f -name "$2" | wc -l | tr -d ' '; }

# Layout
dress "$walk" -g "$skirt" -g "$trousers" -o layout --frames 9:11 --format obj,drc
is 'two garments, two formats: the layout' "$(list layout)" "$({ for f in body skirt trousers; do
    for n in 0009 0010 0011; do printf './paper-walk/%s.%s.%s\n' $f $n drc $f $n obj; done; done
    printf './paper-walk/stats.csv\n./summary.csv\n'; } | sort | tr '\n' ' ')"
is 'stats.csv: a row for each frame and garment' "$(joined frame layout/paper-walk/stats.csv)" '9 9 10 10 11 11 '
is 'summary.csv: a row for each garment' "$(joined garment layout/summary.csv)" 'skirt trousers '
is 'bytes of the summary are the bytes of the files' "$(column bytes layout/summary.csv | head -n 1)" \
    "$(cat layout/paper-walk/skirt.* | wc -c | tr -d ' ')"
is 'Draco files are Draco files' "$(head -c 5 layout/paper-walk/skirt.0009.drc)" DRACO
like 'groups of the body are its roles' "$(grep '^g ' layout/paper-walk/body.0009.obj)" '^g left_thigh'
dress "$walk" -g "$skirt" -o bare --frames 1:2 --no-body
is '--no-body' "$(cd bare/paper-walk && list .)" \
    './skirt.0001.drc ./skirt.0001.obj ./skirt.0002.drc ./skirt.0002.obj ./stats.csv '
dress "$walk" -g "$skirt" -o none --frames 1:2 --format none
is '--format none leaves the statistics' "$(list none)" './paper-walk/stats.csv ./summary.csv '
is 'and they are the same' "$(cat none/paper-walk/stats.csv)" "$(cat bare/paper-walk/stats.csv)"
"$KITSUKE" dress -q "$walk" -g "$skirt" -o times --frames 1:2 --format none
like 'with times there are columns of seconds' "$(grep '^frame,' times/paper-walk/stats.csv)" \
    ',pose_s,.*,write_s,arm_turn$'
is 'without there are none' "$(grep -c '_s,' none/paper-walk/stats.csv)" 0
six=
for n in 1 2 3 4 5 6; do
    sed "s/^garment .*/garment skirt$n/" "$skirt" >skirt$n.garment
    six="$six -g skirt$n.garment"
done
"$KITSUKE" dress -q "$walk" $six -o six -j 1 --frames 1:12 --format none --detail 2 --body-detail 64 \
    --progress json 2>err
spent() { awk -F, '/^#/ { next } !n { for (n = 1; n <= NF; n++) is_time[n] = $n ~ /_s$/; next }
    { for (i = 1; i <= NF; i++) if (is_time[i]) s += $i } END { print s }' six/paper-walk/stats.csv; }
took=$(sed -n 's/.*"seconds":\([0-9.]*\),.*"finished":true.*/\1/p' err)
ok 'the columns of six garments on one thread do not add up to more than the run took' \
    awk "BEGIN { exit !($(spent) > 0 && $(spent) < $took + 0.1) }"

# Frames and rates. The walk has 72 frames at 66 a second.
dress "$walk" -g "$skirt" -o full --format obj
is 'a mesh for every frame' "$(count full 'skirt.*.obj')" 72
dress "$walk" -g "$skirt" -o step --frames 3::30
is '--frames 3::30' "$(joined frame step/paper-walk/stats.csv)" '3 33 63 '
same 'a selected frame shows the same body' step/paper-walk/body.0033.obj full/paper-walk/body.0033.obj
is 'and has the same time' "$(column time step/paper-walk/stats.csv | tail -n 1)" \
    "$(column time full/paper-walk/stats.csv | sed -n 63p)"
dress "$walk" -g "$skirt" -o late --frames 70:999
is 'a last frame behind the end is the end' "$(joined frame late/paper-walk/stats.csv)" '70 71 72 '
dress "$walk" -g "$skirt" -o one --frames 7
is '--frames 7 is that frame' "$(column frame one/paper-walk/stats.csv)" 7
dress "$walk" -g "$skirt" -o rate66 --rate 66 --format obj
ok 'resampled at its own rate it shows the same' diff -r -x '*.csv' -x .done full rate66
dress "$walk" -g "$skirt" -o rate33 --rate 33
is 'half the rate: half the frames' "$(count rate33 'body.*.obj')" 36
same 'its frame 10 is frame 19' rate33/paper-walk/body.0010.obj full/paper-walk/body.0019.obj
dress "$walk" -g "$skirt" -o rate132 --rate 132 --frames 1:41:5
same 'twice the rate: its frame 41 is frame 21' rate132/paper-walk/body.0041.obj full/paper-walk/body.0021.obj
between() { # every vertex of frame 2j of the doubled rate lies within 3 mm of the middle of frames j and j+1
    paste -d ' ' rate132/paper-walk/body.0026.obj full/paper-walk/body.0013.obj full/paper-walk/body.0014.obj |
        awk '$1 == "v" { for (i = 2; i <= 4; i++) { d = $i - ($(i + 4) + $(i + 8)) / 2; if (d * d > 9e-6) bad = 1; n++ }
             if ($2 != $6) moved = 1 } END { exit !(n > 3000 && !bad && moved) }'
}
ok 'a frame between two lies between them' between

# Options of the meshes
dress "$walk" -g "$skirt" -o cm --frames 1:1 --output-unit cm
scaled() {
    paste -d ' ' cm/paper-walk/body.0001.obj full/paper-walk/body.0001.obj |
        awk '$1 == "v" { for (i = 2; i <= 4; i++) { d = $i / 100 - $(i + 4); if (d * d > 1e-11) bad = 1; n++ } }
             END { exit !(n > 3000 && !bad) }'
}
ok '--output-unit cm: numbers a hundred times as large' scaled
tall() { awk '$1 == "v" { if ($3 > most) most = $3 } END { print most }' "$1/paper-walk/body.0001.obj"; }
dress "$walk" -g "$skirt" -o double --frames 1:1 --scale 2
is '--scale 2: twice as tall' "$(awk "BEGIN { r = $(tall double) / $(tall full); print (r > 1.9 && r < 2.1) }")" 1
dress "$walk" -g "$skirt" -o inch --frames 1:1 --unit in
is '--unit in: 2.54 times as tall' "$(awk "BEGIN { r = $(tall inch) / $(tall full); print (r > 2.4 && r < 2.7) }")" 1
dress "$walk" -g "$skirt" -o coarse --frames 1:1 --detail 2 --body-detail 8
faces() { grep -c '^f ' "$1"; }
fewer() { [ "$(faces "coarse/paper-walk/$1.0001.obj")" -lt "$(faces "full/paper-walk/$1.0001.obj")" ]; }
ok '--detail: fewer facets of the garment' fewer skirt
ok '--body-detail: fewer facets of the body' fewer body
dress "$walk" -g "$skirt" -o fixed --frames 1:40:13 --topology fixed
fixed() { for f in fixed/paper-walk/skirt.*.obj; do grep '^f ' "$f" | cmp -s - first || return 1; done; }
grep '^f ' fixed/paper-walk/skirt.0001.obj >first
ok '--topology fixed: the same triangles in every frame' fixed

# Many motions
mkdir -p in/a in/b in/empty
cp "$walk" in/a/walk.bvh
cp "$walk" in/b/walk.BVH
cp "$walk" in/walk.bvh
"$KITSUKE" walk --preset paper --frames-per-step 5 -o in/a/short.bvh
printf 'no motion\n' >in/a/bad.bvh
printf 'not looked at\n' >in/a/notes.txt
batch() { "$KITSUKE" dress -q in -g "$skirt" --frames 1:4 --no-times "$@"; }
ok 'one bad motion: the worst exit code' must_fail 3 batch -o many -j 1
cp err many.err
is 'the others are dressed, folders named by their paths, rows in order' \
    "$(awk -F, '/^#/ || /^motion,/ { next } { printf "%s=%s ", $1, $3 }' many/summary.csv)" \
    'a/bad=refused a/short=ok a/walk=ok b/walk=ok walk=ok '
like 'the bad one has its reason in the summary' "$(cat many/summary.csv)" '^a/bad,skirt,refused,0,.*in/a/bad.bvh'
is 'and one message on stderr' "$(grep -c error: many.err)" 1
is 'and makes no folder' "$(ls many/a)" "$(printf 'short\nwalk')"
must_fail 3 batch -o threads -j 4 >log
ok 'four threads write the same bytes' diff -r many threads
same 'and say the same on stderr' err many.err
wardrobe() { "$KITSUKE" dress -q in/a/walk.bvh -g "$skirt" -g "$trousers" -g "$root/garments/tshirt.garment" \
    --frames 1:12 --no-times --format obj,drc -o "$1" -j "$2"; }
ok 'three garments on one thread' wardrobe worn1 1
ok 'the same garments on five' wardrobe worn5 5
ok 'write the same bytes' diff -r worn1 worn5
ok 'a folder without motions: exit 3' must_fail 3 dress in/empty -g "$skirt" -o empty
cp "$walk" in/a/walk.amc
dress in/a/walk.bvh in/b/walk.BVH in/a/walk.amc -g "$skirt" -o names --frames 1:1 --no-body --format none
is 'names that collide grow' "$(cd names && find . -name stats.csv | sort | tr '\n' ' ')" \
    './in/a/walk/stats.csv ./in/b/walk/stats.csv ./walk.amc/stats.csv '
mkdir case
cp "$walk" case/Walk.bvh
if [ -e case/walk.bvh ]; then skip 'names that differ by case only' 'this disk does not tell them apart'
else
    cp "$walk" case/walk.bvh
    dress case -g "$skirt" -o cased --frames 1:1 --format none
    is 'names that differ by case only are two on every disk' \
        "$(cd cased && find . -name stats.csv | tr A-Z a-z | sort | uniq -d)$(count cased stats.csv)" 2
fi
dress in/walk.bvh ./in//walk.bvh in/./walk.bvh -g "$skirt" -o once --frames 1:1 --format none
is 'a file that was named three times is dressed once' "$(column motion once/summary.csv)" walk

# Names that try to get out
long=$(awk 'BEGIN { for (i = 0; i < 240; i++) printf "x" }')
mkdir -p 'odd/..x' odd/summary.csv
for name in '...bvh' '-rf.bvh' "$(printf 'a\nb\033[2J.bvh')" "$long.bvh" 'stats.csv.bvh' '..x/..bvh' \
    'summary.csv/a\b:c.bvh' ' .bvh' 'ü.bvh'; do
    cp "$walk" "odd/$name"
done
find odd -name '*.bvh' -exec "$KITSUKE" dress -q -g "$skirt" -o inner/out --frames 1:1 --no-body {} +
is 'nine odd names: nine motions' "$(count inner/out skirt.0001.obj)" 9
is 'none of them outside' "$(ls -A inner) $(find odd -name '*.obj')" 'out '
is 'no control byte in a name' "$(find inner | tr -d '\n' | tr -d -c '\001-\037\177' | wc -c | tr -d ' ')" 0
(mkdir deep && cd deep && dress ../in/a/../walk.bvh -g "$skirt" -o out --frames 1:1 --format none)
is 'a path with .. stays inside' "$(list deep)" './out/summary.csv ./out/walk/stats.csv '

# What is there already
cp -R step again
printf 'mine\n' >again/paper-walk/notes.txt
ok 'a motion folder with files is refused: exit 4' must_fail 4 dress "$walk" -g "$skirt" -o again --frames 1:2
like 'the message says how to go on' "$(cat err)" "'again/paper-walk' holds files of an earlier run; --force"
mkdir crowded
cp "$walk" crowded/a.bvh
cp "$walk" crowded/a.amc
must_fail 4 "$KITSUKE" dress crowded -g "$skirt" -o crowded >log
like 'a file where a folder has to be is no earlier run' "$(cat err)" "cannot make the folder 'crowded/a.amc': Not a"
is 'nothing was touched' "$(list again/paper-walk)" "$(list step/paper-walk | sed 's/ \.\/skirt/ .\/notes.txt&/')"
printf 'mine\n' | tee again/paper-walk/sketch.12.obj >again/paper-walk/sketch.obj
printf 'torn\n' >again/paper-walk/skirt.0099.obj.tmp
dress "$walk" -g "$skirt" -o again --frames 1:2 --force --no-body
is '--force leaves none of the old frames, and what is not ours' "$(list again/paper-walk)" \
    "$(printf './%s ' notes.txt sketch.12.obj sketch.obj skirt.0001.drc skirt.0001.obj skirt.0002.drc skirt.0002.obj \
        stats.csv)"
cp again/paper-walk/stats.csv kept.csv
cp "$walk" new.bvh
ok 'one folder that is there and one that is not' must_fail 4 dress "$walk" new.bvh -g "$skirt" -o again --frames 1:2
is 'are both in the summary' "$(joined status again/summary.csv)" 'failed ok '
must_fail 2 dress new.bvh -g "$skirt" -o behind --frames 500: >log
is 'frames that the motion does not have: refused' "$(joined status behind/summary.csv)" 'refused '
printf 'garbage\n' >gone.bvh
mkdir -p again/gone && printf 'old\n' >again/gone/stats.csv
ok '--force with a motion that cannot be read keeps the old files' \
    must_fail 3 dress gone.bvh -g "$skirt" -o again --force
is 'they are there' "$(cat again/gone/stats.csv)" old

# Where nothing can be written
printf 'a file\n' >file
ok 'a file in the place of the folder: exit 4' must_fail 4 dress "$walk" -g "$skirt" -o file --frames 1:1
ok 'a folder below it: exit 4' must_fail 4 dress "$walk" -g "$skirt" -o file/out --frames 1:1
mkdir locked && chmod a-w locked
if [ -w locked ]; then skip 'a folder without permission' 'this is root'
else ok 'a folder without permission: exit 4' must_fail 4 dress "$walk" -g "$skirt" -o locked/out --frames 1:1; fi
mkdir disk
if mount -t tmpfs -o size=1m none disk 2>log; then
    ok 'a full disk: exit 4' must_fail 4 dress "$walk" -g "$skirt" -o disk/out
    like 'the message says why' "$(cat err)" 'No space left on device'
    whole=$(for f in disk/out/paper-walk/*.obj; do cmp -s "$f" "full/paper-walk/${f##*/}" || echo "$f"; done)
    is 'what is there is whole' "$whole" ''
    is 'no temporary file is left' "$(count disk '*.tmp')" 0
    umount disk
else
    skip 'a full disk' 'cannot mount a small one'
fi

# --strict: a sheet that the thighs pierce; no push can free it
{
    printf 'garment skirt\nfollow bones\nfit tight\npatch sheet\n'
    for x in -0.6 -0.2 0.2 0.6; do
        for z in -0.6 -0.2 0.2 0.6; do printf '%s 0.7 %s pelvis 1\n' "$x" "$z"; done
    done
    printf 'collide sheet left_thigh right_thigh\n'
} >tight.garment
ok 'what cannot be solved is counted, not hidden' dress "$walk" -g tight.garment -o tight --frames 1:2 --format none
is 'in residual_frames' "$(column residual_frames tight/summary.csv)" 2
ok '--strict makes it exit 1' must_fail 1 dress "$walk" -g tight.garment -o strict --frames 1:2 --strict \
    --progress json
like 'it has not failed all the same' "$(grep finished err)" '"done":1,"failed":0,.*"finished":true'
like 'and says where' "$(cat err)" "paper-walk.bvh: error: the body shows through 'skirt' in 2 of 2 frames"
is 'everything is written all the same' "$(count strict '*.obj')" 4
ok '--strict with a sound garment: exit 0' dress "$walk" -g "$skirt" -o sound --frames 1:2 --strict

# Interrupted
interrupt() { # interrupt SIGNAL: in the middle of a run
    rm -rf stop
    "$KITSUKE" dress -q in in/walk.bvh "$walk" -g "$skirt" -g "$trousers" -o stop -j 1 --format obj,drc 2>err &
    pid=$!
    for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
        [ -n "$(find stop -name '*.obj' 2>log)" ] && break
        sleep 0.1
    done
    kill -s "$1" "$pid"
    code=0
    wait "$pid" || code=$?
    is "$1: exit 130" "$code" 130
    is "$1: said once" "$(grep -c interrupted err)" 1
    is "$1: no temporary file is left" "$(count stop '*.tmp')" 0
    torn=$(find stop -name '*.obj' -exec sh -c 'for f; do tail -n 1 "$f" | grep -q "^f " || echo "$f"; done' sh {} +)
    is "$1: every file is whole" "$torn" ''
    like "$1: the summary tells what was not done" "$(cat stop/summary.csv)" ',failed,.*,interrupted,0.000000$'
}
interrupt INT
interrupt TERM

# Real motions
run=$KITSUKE_MOTIONS/cmu_daz_02_03_run.bvh amc=$KITSUKE_MOTIONS/cmu_02_03_run.amc
restarts() { column restarted "$1/cmu_daz_02_03_run/stats.csv" | tr -d '\n'; }
if [ -f "$run" ]; then
    "$KITSUKE" dress "$run" -g "$skirt" -o run --frames 1:12 --format none 2>err
    like 'a T-pose in front is told' "$(cat err)" 'the first [0-9] frames stand apart'
    is 'and cloth starts afresh behind it' "$(restarts run)" 111100000000
    dress "$run" -g "$skirt" -o slow --rate 30 --format none
    like 'a jump between two resampled frames is not missed' "$(restarts slow)" '^1100'
    dress "$amc" -g "$skirt" -o amc --frames 1:2 --format none
    is 'an AMC finds its skeleton' "$(column frames amc/summary.csv)" 2
    ok 'or is told it' dress "$amc" --asf "${amc%_03*}.asf" -g "$skirt" -o asf --frames 1:2 --format none
    ok 'no human: exit 3' must_fail 3 dress "$KITSUKE_MOTIONS/fairmotion_sinusoidal_noend.bvh" -g "$skirt" -o toy
    like 'with the roles that are missing' "$(cat err)" 'missing roles: pelvis, chest, '
else
    skip 'real motions' 'no folder with them'
fi
done_testing
