#!/bin/sh
# kitsuke draw: the figures of the paper to the byte, whatever view, and no picture of nothing.
. "$(dirname "$0")/lib.sh"

walk=$root/motions/paper-walk.bvh
skirt=$root/garments/paper-skirt.garment

draw() { "$KITSUKE" draw "$walk" -g "$skirt" "$@"; }
refuses() { # refuses EXIT PATTERN ARGUMENT...
    refusal=$1 pattern=$2
    shift 2
    must_fail "$refusal" "$KITSUKE" draw "$@" && says "$pattern"
}
pictures() { grep -c '<g transform="translate' "$1"; }
titles() { sed -n 's/^<text[^>]*>\(.*\)<\/text>$/\1/p' "$1" | tr '\n' ';'; }

# The figures. After a change that is meant, look at them, then UPDATE_GOLDEN=1 tests/draw.sh.
for n in 5 6; do
    ok "figure $n is drawn" "$KITSUKE" draw --job "$root/tests/golden/figure$n.job" -o figure$n.svg
    same "figure $n is the one that the README shows" figure$n.svg "$root/tests/golden/figure$n.svg"
done
is 'figure 5 compares' "$(titles figure5.svg)" '(a) global deformation only;(b) global and local deformation;'
is 'figure 6 counts' "$(titles figure6.svg)" '(a) shape;(b) uniform: 32 patches;(c) adaptive: 8 patches;'
small() { [ "$(wc -c <figure5.svg)" -lt 300000 ] && [ "$(wc -c <figure6.svg)" -lt 450000 ]; }
ok 'they are no large files' small
seen() { grep -c 'stroke="#9c1c12"' "$1"; } # pictures with control points that nothing hides
is 'figure 5 has no control points' "$(seen figure5.svg)" 0
is 'figure 6 has them in two of its pictures' "$(seen figure6.svg)" 2

# Sheets
ok 'without --frames six are drawn' draw -o six.svg --size 60
is 'from the first to the last' "$(titles six.svg | tr -d '()a-f ')" 'rm1;rm15;rm29;rm43;rm57;rm72;'
ok 'lists and spans' draw -o list.svg --size 60 --frames 40,3:9:3,2,6
is 'each frame once, in order' "$(titles list.svg)" '(a) frame 2;(b) frame 3;(c) frame 6;(d) frame 9;(e) frame 40;'
ok 'frames and cells' draw -o both.svg --size 60 --frames 5,9 --cell none=A --cell global,cells,points
is 'a row for each frame' "$(titles both.svg)" \
    '(a) frame 5, A;(b) frame 5, global,cells,points: 8 cells;(c) frame 9, A;(d) frame 9, global,cells,points: 8 cells;'
ok 'one picture needs no title' draw -o one.svg --size 60 --frames 5
is 'and has none' "$(titles one.svg)" ''
draw -o - --size 60 --frames 5 >stdout.svg
same 'standard output gets the same bytes' stdout.svg one.svg
for view in front back left right iso 200 -35/-40; do
    ok "--view $view" draw -o view.svg --size 60 --frames 5 --view "$view" --follow --zoom 2
    is "--view $view: a picture" "$(pictures view.svg)" 1
done
ok 'without --follow the figure walks through the view' draw -o walks.svg --size 60 --frames 1,72 --view left
ok 'with it the camera walks along' draw -o stays.svg --size 60 --frames 1,72 --follow --view left
wide() { sed -n 's/.*<svg[^>]* width="\([0-9.]*\)".*/\1/p' "$1"; }
ok 'and the pictures are narrower' awk "BEGIN { exit !($(wide stays.svg) < $(wide walks.svg)) }"
trousers=$root/garments/trousers.garment
cells_drawn() { sed -n 's/^<text[^>]*>.* \([0-9]*\) cells<\/text>$/\1/p' "$1" | tr '\n' ' '; }
"$KITSUKE" draw -q "$walk" -g "$trousers" -o time.svg --size 50 --frames 1:40:3 --cell push,cells
"$KITSUKE" dress -q "$walk" -g "$trousers" -o time --frames 1:40:3 --format none
is 'cells open and close in time as when the frames are dressed' "$(cells_drawn time.svg)" \
    "$(joined cells time/paper-walk/stats.csv)"
awk '/^Frame Time/ { rows = 1; print; next } rows { x = $1; $1 = $3; $3 = -x; $4 += 90 } { print }' "$walk" >turned.bvh
for view in front left; do
    draw -o plain_$view.svg --size 400 --frames 30 --view $view
    "$KITSUKE" draw turned.bvh -g "$skirt" -o turned_$view.svg --size 400 --frames 30 --view $view
    is "who heads elsewhere is seen from the $view of the figure" "$(wide turned_$view.svg)" "$(wide plain_$view.svg)"
done
ok 'which are not alike' test "$(wide plain_front.svg)" != "$(wide plain_left.svg)"
ok 'the method to the letter has pictures too' draw -o paper.svg --size 60 --frames 8,9 --method paper --show patches
well_formed() { # tags that open close
    for f in figure6.svg list.svg both.svg paper.svg; do
        for tag in svg g clipPath title; do
            [ "$(grep -o "<$tag[ >]" $f | wc -l)" -eq "$(grep -o "</$tag>" $f | wc -l)" ] || return 1
        done
        ! grep -Eq 'nan|inf' $f || return 1
    done
}
ok 'what opens closes, and every number is one' well_formed

# Nonsense
ok 'no motion' refuses 2 'nothing to draw' -g "$skirt" -o x.svg
ok 'two motions' refuses 2 'takes one motion' "$walk" "$walk" -g "$skirt" -o x.svg
ok 'no garment' refuses 2 'nothing to put on' "$walk" -o x.svg
ok 'no output' refuses 2 'no place to write to' "$walk" -g "$skirt"
cp "$walk" own.bvh
cp "$skirt" own.garment
ok 'the motion is not drawn over' refuses 2 "'own.bvh' is read" own.bvh -g own.garment -o ./own.bvh
ok 'nor the garment' refuses 2 "'own.garment' is read" own.bvh -g own.garment -o ./own.garment
is 'and both are as they were' "$(cmp "$walk" own.bvh 2>&1; cmp "$skirt" own.garment 2>&1)" ''
ok 'a frame behind the end' refuses 2 "asks for frame 73, but .* has 72" "$walk" -g "$skirt" -o x.svg --frames 3,73
ok 'too many' refuses 2 '72 pictures are too many' "$walk" -g "$skirt" -o x.svg --frames 1:72
ok 'too many with their cells' refuses 2 '80 pictures are too many' "$walk" -g "$skirt" -o x.svg --frames 1:40 \
    --cell push --cell none
ok 'an unknown view' refuses 2 "option '--view': expected front" "$walk" -g "$skirt" -o x.svg --view top
ok 'an elevation over the head' refuses 2 "EL from -89 to 89" "$walk" -g "$skirt" -o x.svg --view 0/90
ok 'an unknown word in a cell' refuses 2 "option '--cell'.*'push,foo'" "$walk" -g "$skirt" -o x.svg --cell push,foo
ok 'nine cells' refuses 2 'at most 8' "$walk" -g "$skirt" -o x.svg $(printf -- '--cell push %.0s' 1 2 3 4 5 6 7 8 9)
ok 'a missing motion' refuses 3 nowhere nowhere.bvh -g "$skirt" -o x.svg
ok 'a folder that is not there' refuses 4 'nowhere/x.svg' "$walk" -g "$skirt" -o nowhere/x.svg --frames 1 --size 50
is 'nothing of all this left a picture' "$(ls x.svg 2>/dev/null)" ''

done_testing
