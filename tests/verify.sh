#!/bin/sh
# kitsuke verify: what it finds in meshes on the disk, and what it says of those that are not there.
. "$(dirname "$0")/lib.sh"

walk=$root/motions/paper-walk.bvh
verify() { # verify CODE ARGUMENT...: with its table in `table`, without the comment lines
    wanted=$1 got=0
    shift
    "$KITSUKE" verify "$@" >raw 2>err </dev/null || got=$?
    grep -v '^#' raw >table
    [ "$got" -eq "$wanted" ] || { echo "exit code $got, wanted $wanted: verify $*"; cat err; return 1; }
}
told() { joined "$1" table; }

# cube FILE LOW HIGH: with a group
cube() {
    awk -v a="$2" -v b="$3" 'BEGIN {
        for (k = 0; k < 8; k++) print "v", (k % 2 ? b : a), (int(k / 2) % 2 ? b : a), (k > 3 ? b : a)
        print "g box\nf 1 3 4 2\nf 1 2 6 5\nf 1 5 7 3\nf 8 6 2 4\nf 8 4 3 7\nf 5 6 8 7" }' >"$1"
}

# Planted cases
cube a.0001.obj 0 1
cube b.0001.obj 0.5 1.5
ok 'two cubes that interpenetrate: exit 1' verify 1 --garment 'b.*.obj' --body 'a.*.obj'
is 'their pairs' "$(told pairs)" '18 '
is 'the corner inside' "$(told inside)" '1 '
is 'its depth' "$(told deepest)" '0.500000 '
is 'the part' "$(told worst_part)" 'box '
is 'the name of the garment is that of its files' "$(told garment)" 'b '
like 'and a summary' "$(cat err)" '^1 mesh, 1 with findings: 18 pairs, 1 vertices inside, deepest 500.00 mm, 0 cracks$'
ok '--unit' verify 1 --garment 'b.*.obj' --body 'a.*.obj' --unit cm
is 'the depth in metres' "$(told deepest)" '0.005000 '
ok '--list' verify 1 --garment 'b.*.obj' --body 'a.*.obj' --list -q
is 'each pair, each vertex' "$(column kind table | sort | uniq -c | tr -s ' \n' ' ')" ' 1 inside 18 pair '
is 'the vertex that is inside' "$(grep inside table)" ',1,b,inside,1,box,7,0.500000,0.500000,0.500000,0.500000'
is '--quiet says nothing' "$(cat err)" ''
cube b.0001.obj 1 2
ok 'cubes that share a corner: exit 1' verify 1 --garment 'b.*.obj' --body 'a.*.obj'
is 'nothing inside' "$(told inside)" '0 '
cube b.0001.obj 1.5 2
ok 'cubes apart: exit 0' verify 0 --garment 'b.*.obj' --body 'a.*.obj'
cube b.0001.obj 0.25 0.75
ok 'inside without a crossing: exit 1' verify 1 --garment 'b.*.obj' --body 'a.*.obj'
is 'no pair' "$(told pairs)" '0 '
is 'all corners inside' "$(told inside)" '8 '
cube a.0002.obj 0 1
printf 'nonsense\n' >b.0002.obj
ok 'a finding in one frame and another that cannot be read: exit 3' verify 3 --garment 'b.*.obj' --body 'a.*.obj'
is 'both are told' "$(told inside)$(grep -c b.0002.obj err)" '8 1'
rm a.0002.obj b.0002.obj
ok 'other parts only' verify 2 --garment 'b.*.obj' --body 'a.*.obj' --parts box,lid
ok 'a part that is not there, with those that are' says "has no group 'lid'; it has box"
ok '--parts' verify 1 --garment 'b.*.obj' --body 'a.*.obj' --parts box

# A strip of two halves that are GAP millimetres apart along the seam
strip() {
    awk -v gap="$1" 'BEGIN {
        for (half = 0; half < 2; half++) for (y = 0; y <= 10; y++) for (x = 0; x <= 1; x++)
            print "v", (half ? 100 + gap : 0) + 100 * x, 20 * y, 5000
        for (half = 0; half < 2; half++) for (y = 0; y < 10; y++) {
            k = 22 * half + 2 * y + 1
            print "f", k, k + 1, k + 3, k + 2 } }' >strip.obj
}
strip 1
ok 'a seam that gapes by a millimetre: exit 1' verify 1 --garment strip.obj --body a.0001.obj --unit mm
is 'is a crack, on both sides' "$(told cracks)" '22 '
strip 3
ok 'three millimetres are a slit: exit 0' verify 0 --garment strip.obj --body a.0001.obj --unit mm
strip 0
ok 'where the halves meet nothing gapes: exit 0' verify 0 --garment strip.obj --body a.0001.obj --unit mm

# Frames
for n in 0001 0002 0003 0004 0005; do cube m.$n.obj 1.5 2; cube body.$n.obj 0 1; done
for pattern in 'm.*.obj' 'm.####.obj' 'm.%04d.obj' 'm.%d.obj'; do
    ok "pattern $pattern" verify 0 --garment "$pattern" --body 'body.*.obj'
    is "pattern $pattern: all frames" "$(told frame)" '1 2 3 4 5 '
done
for k in 1 2; do cp m.000$k.obj long.000000000$k.obj; done
ok 'numbers with ten digits' verify 0 --garment 'long.*.obj' --body 'body.*.obj' --frames 1:2
is 'are numbers too' "$(told frame)" '1 2 '
ok 'a body without a number stands still' verify 0 --garment 'm.*.obj' --body body.0001.obj
is 'in all frames' "$(told frame)" '1 2 3 4 5 '
ok 'two files without a number' verify 0 --garment m.0001.obj --body body.0001.obj
is 'are one frame' "$(told frame)" '1 '
ok '--frames' verify 0 --garment 'm.*.obj' --body 'body.*.obj' --frames 2::2
is 'the selected ones' "$(told frame)" '2 4 '
ok 'frames that are not there' verify 2 --garment 'm.*.obj' --body 'body.*.obj' --frames 7:9
ok 'a pattern that nothing fits' verify 3 --garment 'x.*.obj' --body 'body.*.obj'
ok 'its message' says "no file is called like 'x\\.\\*\\.obj'"
rm m.0003.obj
ok 'a missing frame: exit 3' verify 3 --garment 'm.*.obj' --body 'body.*.obj'
ok 'with its number' says 'm\.\*\.obj: error: frame 3 is missing'
is 'the others are there' "$(told frame)" '1 2 4 5 '
rm body.0003.obj body.0002.obj
ok 'missing on one side and on both' verify 3 --garment 'm.*.obj' --body 'body.*.obj'
ok 'a range' says 'body\.\*\.obj: error: frames 2 to 3 are missing'
ok 'and a gap in both is told for both' says 'm\.\*\.obj: error: frame 3 is missing'
mkdir end
for n in 1 2 4; do cube end/m.$n.obj 1.5 2; cube end/body.$n.obj 0 1; done
ok 'a gap before the last frame: exit 3' verify 3 --garment 'end/m.*.obj' --body 'end/body.*.obj'
ok 'is told' says 'm\.\*\.obj: error: frame 3 is missing'
rm m.0002.obj m.0004.obj body.0004.obj
ok 'a row of every fourth frame has no gap' verify 0 --garment 'm.*.obj' --body 'body.*.obj'
printf 'v 1 2 3\nv 1 2 nonsense\n' >m.0005.obj
ok 'a file that cannot be read: exit 3' verify 3 --garment 'm.*.obj' --body 'body.*.obj'
ok 'with its place' says "m\.0005\.obj:2:7: error: expected a number, found 'nonsense'"
is 'and the frame before' "$(told frame)" '1 '
printf 'v 1 2 3\n' >body.0005.obj
ok 'a mesh without triangles: exit 3' verify 3 --garment 'm.*.obj' --body 'body.*.obj'
ok 'is no mesh' says 'body\.0005\.obj: error: no triangles'
: >body.0001.obj
ok 'an empty file: exit 3' verify 3 --garment 'm.*.obj' --body 'body.*.obj'
ok 'a folder that is not there: exit 3' verify 3 nowhere
mkdir bare lone
cube lone/body.0001.obj 0 1
ok 'a body without garments: exit 3' verify 3 lone
ok 'its message' says 'lone: error: a body without garments'
ok 'a folder without meshes: exit 3' verify 3 bare
ok 'its message' says "no meshes .* in 'bare'"
cube bare/cloth.0001.obj 0 1
ok 'garments without a body: exit 3' verify 3 bare
ok 'its message' says 'bare: error: garments without a body'

# Accelerations: a cube on a path that bends by 2 along each axis, a body that stands still
rm m.*.obj
cube m.0001.obj 2 3
cube m.0002.obj 3 4
cube m.0003.obj 6 7
cube still.obj 0 1
ok '--acceleration' verify 0 --garment 'm.*.obj' --body still.obj --acceleration --rate 1
is 'over a frame and the two before it' "$(told acceleration)" '  3.4641 '
is 'that of the body' "$(told body_acceleration)" '  0.0000 '
mv m.0003.obj m.0005.obj
mv m.0002.obj m.0003.obj
ok 'every second frame' verify 0 --garment 'm.*.obj' --body still.obj --acceleration --rate 2
is 'is half the rate' "$(told acceleration)" '  3.4641 '
mv m.0005.obj m.0004.obj
ok 'frames unequally far apart' verify 3 --garment 'm.*.obj' --body still.obj --acceleration --rate 2
is 'have none' "$(told acceleration)" '   '

# Our own
skirt=$root/garments/skirt.garment trousers=$root/garments/trousers.garment
"$KITSUKE" dress "$walk" -g "$skirt" -g "$trousers" -o out -q --format obj,drc --frames 1::12
hips=pelvis,spine,chest,left_thigh,right_thigh,left_shin,right_shin
ok 'the walk of the paper is clean against torso and legs' verify 0 out --parts $hips
is 'the motion is named' "$(column motion table | sort -u)" paper-walk
is 'borders: skirt 2, trousers 3' "$(told borders | cut -c 1-8)" '2 3 2 3 '
ok '--landmarks' verify 0 out --parts $hips --landmarks
is 'hips are covered' "$(column cover_hips table | sort -u)" 1.0000
is 'knees too' "$(column cover_knees table | sort -u)" 1.0000
is 'a row for each mesh' "$(wc -l <table | tr -d ' ')" "$(($(find out -name '*.obj' ! -name 'body*' | wc -l) + 1))"
"$KITSUKE" dress "$walk" -g "$skirt" -o fast -q --rate 50 --frames 1:3
ok 'the rate stands in stats.csv' verify 0 fast --parts $hips --acceleration
told acceleration >told
ok 'or is given' verify 0 fast --parts $hips --acceleration --rate 50
is 'with the same result' "$(told acceleration)" "$(cat told)"
like 'which is one' "$(cat told)" '^  [0-9.]+ $'
cp fast/paper-walk/stats.csv stats.csv
for row in 3 3,0.0; do
    (sed '$d' stats.csv; printf '%s' "$row") >fast/paper-walk/stats.csv
    ok "a last row of '$row', broken off" verify 0 fast --parts $hips --acceleration
    is 'does not count' "$(told acceleration)" "$(cat told)"
done
cp stats.csv fast/paper-walk/stats.csv
ok 'another rate' verify 0 fast --parts $hips --acceleration --rate 30
ok 'is another result' test "$(told acceleration)" != "$(cat told)"
ok 'all frames' verify 0 out --parts $hips
cp table whole
mkdir two
cp -r fast/paper-walk two/long
cp -r fast/paper-walk two/brief
rm two/brief/*.000[23].*
ok 'frames that one of two motions does not have' verify 2 two --frames 2:3 --parts $hips
is 'are those of the other' "$(joined motion table)" 'long long '
if [ -e /dev/full ]; then
    full() { "$KITSUKE" verify fast >/dev/full 2>err; [ $? -eq 4 ] && says 'standard output: No space left'; }
    ok 'a full disk: exit 4, and why' full
else
    skip 'a full disk' 'no /dev/full'
fi
ok 'a folder of one motion' verify 0 out/paper-walk --parts $hips
is 'gives the same rows' "$(cut -d, -f 2- table)" "$(cut -d, -f 2- whole)"
mkdir decoded
cp out/paper-walk/*.drc decoded
ok 'what Draco keeps of cloth and body is as clean' verify 0 decoded
ok 'Draco beside OBJ' verify 1 --garment 'out/paper-walk/skirt.*.drc' --body 'out/paper-walk/skirt.*.obj'
sed 's/^ring hip.*/ring hip pelvis 0.40 size 0.05 0.05 0.05/' "$skirt" >tight.garment
for unit in m cm; do
    "$KITSUKE" dress "$walk" -g tight.garment -o $unit -q --method global --output-unit $unit --frames 1:1
    ok "a skirt in the body is found ($unit)" verify 1 $unit
    told deepest >$unit.depth
    like 'its depth is in metres' "$(cat $unit.depth)" '^0\.0[0-9]+ $'
done
ok 'a body in centimetres and a garment in metres: exit 3' \
    verify 3 --garment 'm/paper-walk/skirt.*.obj' --body 'cm/paper-walk/body.*.obj'
ok 'are not compared' says 'its unit is 1 m, that of the body 0.01 m'
done_testing
