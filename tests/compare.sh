#!/bin/sh
# The experiment: what the shipped walk counts, on every machine; its tables and pictures; folders;
# bad input.
. "$(dirname "$0")/lib.sh"

walk=$root/motions/paper-walk.bvh
skirt=$root/garments/paper-skirt.garment

compare() { "$KITSUKE" compare --no-times --quiet "$@"; }
refuses() { # refuses EXIT PATTERN ARGUMENT...
    wanted=$1 pattern=$2
    shift 2
    must_fail "$wanted" "$KITSUKE" compare "$@" && says "$pattern"
}
runs() { # runs METHOD NUMBER FILE: a column as runs of equal values, "2x11" is eleven times 2
    awk -F, -v method="$1" -v c="$2" '
        function flush() { if (n) printf "%s%sx%d", (runs++ ? " " : ""), last, n }
        $2 == method { if ($c != last) { flush(); n = 0 } last = $c; n++ }
        END { flush(); print "" }' "$3"
}
cells() { # cells TABLE METHOD: the cells of its (first) row in the n-th table, behind the method
    awk -F' *[|] *' -v table="$1" -v method="$2" '/^\|---/ { t++ }
        t == table && $4 == method { for (i = 5; i < NF; i++) printf "%s%s", $i, i < NF - 1 ? " " : "\n"; exit }' "$3"
}

# --- the walk ---
ok 'the shipped walk is compared' sh -c '"$0" compare --no-times "$1" -g "$2" -o run --methods global >table 2>err' \
    "$KITSUKE" "$walk" "$skirt"
is 'nothing on stderr' "$(cat err)" ''
csv=run/compare.csv
is 'the columns of what was done' "$(head -n 1 $csv | cut -d, -f1-10)" \
    'frame,method,nodes,leaves,tests,tests_culled,depth,cells,hits,displacement'
is 'and of what came of it' "$(head -n 1 $csv | cut -d, -f11-)" \
    'residual_edges,residual_cloth,inside,control_points,bytes'
is 'a row for each frame and method' "$(tail -n +2 $csv | cut -d, -f2 | sort | uniq -c | tr -s ' ' | tr '\n' ';')" \
    ' 72 adaptive; 72 global; 72 uniform;'
is 'uniform: 32 nodes in every frame' "$(runs uniform 3 $csv)" 32x72
is 'uniform: 32 leaves' "$(runs uniform 4 $csv)" 32x72
is 'adaptive: nodes, frame by frame' "$(runs adaptive 3 $csv)" "6x10 10x3 2x11 10x3 6x19 10x3 2x11 10x3 6x9"
is 'adaptive: leaves are 2 + 3 k where nodes are 2 + 4 k' \
    "$(awk -F, '$2 == "adaptive" && $4 != 2 + 3 * ($3 - 2) / 4' $csv)" ''
is 'the paper counts all pairs of every node' \
    "$(awk -F, 'NR > 1 && $5 != $3 * 2 * 16 * 16 * 4800' $csv)" ''
is 'global splits as adaptive does' "$(runs global 3 $csv)" "$(runs adaptive 3 $csv)"
is 'no residual with the local deformation' \
    "$(awk -F, '$2 == "adaptive" || $2 == "uniform" { n += $11 + $12 + $13 } END { print n }' $csv)" 0
ok 'the body shows without it' awk -F, '$2 == "global" && $11 { n++ } END { exit !(n > 40) }' $csv
ok 'culling leaves next to nothing of either' awk -F, 'NR > 1 && $6 > $5 / 1000 { exit 1 }' $csv

# --- the paper to the letter ---
for n in 1 2; do
    ok 'the method of the paper' compare "$walk" -g "$skirt" -o paper$n --frames 1:12 --methods paper
done
csv=paper1/compare.csv
ok 'the same bytes again' cmp $csv paper2/compare.csv
ok 'and the same picture' cmp paper1/tests.svg paper2/tests.svg
is 'it splits as adaptive does' "$(runs paper 3 $csv)" "$(runs adaptive 3 $csv)"
is 'and knows no culling' "$(awk -F, '$2 == "paper" && $5 != $6' $csv)" ''
is 'its first frame has no motion to follow: nothing moves, the body shows' \
    "$(awk -F, '$2 == "paper" && $1 == 1 { print $10, ($11 > 0) }' $csv)" '0.000000 1'
ok 'later it moves what is hit' awk -F, '$2 == "paper" && $10 > 0 { n++ } END { exit !n }' $csv

# --- tables ---
is 'three tables' "$(grep -c '^|---' table)" 3
is 'uniform in the table' "$(cells 1 uniform table)" '72 50 32.0 32 32.0 32 78643200 78643200 5662310400 1.00 1.00'
is 'adaptive in the table' "$(cells 1 adaptive table)" '72 50 5.4 10 4.6 8 13380267 24576000 963379200 5.88 4.60'
ok 'at least 4.2 times as many tests, 3.2 in frames with contact' \
    awk -F' *[|] *' '$4 == "adaptive" && !n++ { exit !($14 >= 4.2 && $15 >= 3.2) }' table
is 'no residual frame of uniform' "$(cells 3 uniform table | cut -d' ' -f1,2)" '72 0'
is 'nor of adaptive' "$(cells 3 adaptive table | cut -d' ' -f1,2)" '72 0'
is 'one pair has no total row' "$(grep -c total table)" 1
is 'every row has as many cells as its head' \
    "$(awk -F'|' '/^\| motion/ { n = NF } /^\|/ && NF != n' table)" ''

# --- pictures ---
same 'figure 7 (a)' run/tests.svg "$here/golden/figure7a.svg"
like 'says what it is' "$(cat run/tests.svg)" 'intersection tests'
like 'adaptive is dashed' "$(cat run/tests.svg)" 'stroke-dasharray'
is 'no picture of times without times' "$(ls run)" 'compare.csv
tests.svg'
ok 'a comparison with times' "$KITSUKE" compare "$walk" -g "$skirt" -o timed --frames 1:4 --repeat 2
is 'has columns for them' "$(head -n 1 timed/compare.csv | cut -d, -f16-)" 'tests_s,tests_culled_s,solve_s'
is 'and a picture of them' "$(ls timed)" 'compare.csv
tests.svg
times.svg'
like 'which says what it is' "$(cat timed/times.svg)" 'time in tests \(ms\)'
is 'the same counts as without' "$(cut -d, -f1-15 timed/compare.csv)" "$(head -n 13 run/compare.csv | grep -v global)"
ok 'a comparison of one frame' compare "$walk" -g "$skirt" -o one --frames 12
is 'has one row for each method' "$(wc -l <one/compare.csv | tr -d ' ')" 3

# --- earlier files ---
ok 'an earlier run is not replaced' refuses 4 "'run/compare.csv' is there" "$walk" -g "$skirt" -o run --no-times
touch run/mine
ok 'but with --force' compare "$walk" -g "$skirt" -o run --force --frames 1:3
is 'and nothing else' "$(ls run)" 'compare.csv
mine
tests.svg'

# --- folders ---
mkdir walks
cp "$walk" walks/one.bvh
cp "$walk" walks/two.bvh
echo 'not a motion' >walks/bad.bvh
compare walks -g "$skirt" -g "$root/garments/skirt.garment" -o many --frames 10:13 >table 2>err
is 'one bad motion decides the exit' $? 3
is 'and says so once' "$(grep -c 'error.*bad.bvh\|bad.bvh.*error' err)" 1
is 'each pair has its folder' "$(cd many && find . -name '*.csv' | sort | tr '\n' ' ')" \
    './one/paper-skirt/compare.csv ./one/skirt/compare.csv ./two/paper-skirt/compare.csv ./two/skirt/compare.csv '
is 'the table ends with totals' "$(tail -n 2 table | cut -d'|' -f2-4 | tr -d ' ')" '**total**||uniform
**total**||adaptive'
is 'which add up' "$(awk -F' *[|] *' '/^\|---/ { t++ } t != 1 || $4 != "uniform" { next }
    $2 == "**total**" { print n - $13, f - $5 } { n += $13; f += $5 }' table)" '0 0'
ok 'a folder without motions' refuses 3 'no motion' "$root/garments" -g "$skirt" -o none

# --- nothing to compare ---
grep -v '^collide' "$skirt" >bare.garment
ok 'a garment that touches nothing' refuses 3 'never touches the body' "$walk" -g bare.garment -o bare --no-times
is 'has a table' "$(cells 1 adaptive out | tail -n 1 | grep -c 'no contact')" 1
is 'and no picture' "$(ls bare)" compare.csv
ok 'frames without contact' refuses 3 'never touches the body' "$walk" -g "$skirt" -o calm --no-times --frames "14:24"

# --- bad input ---
ok 'no motion' refuses 2 'nothing to compare' -g "$skirt" -o bad
ok 'no garment' refuses 2 'nothing to put on' "$walk" -o bad
ok 'no folder' refuses 2 'no place to write' "$walk" -g "$skirt"
ok 'an empty range of frames' refuses 2 'frame' "$walk" -g "$skirt" -o bad --frames 900:
ok 'a missing motion' refuses 3 'nowhere.bvh' nowhere.bvh -g "$skirt" -o bad
ok 'a missing garment' refuses 3 'nowhere.garment' "$walk" -g nowhere.garment -o bad
ok 'an unknown method' refuses 2 "'--methods'" "$walk" -g "$skirt" -o bad --methods magic
ok 'no runs at all' refuses 2 "'--repeat'" "$walk" -g "$skirt" -o bad --repeat 0
ok 'two garments from one pipe' refuses 2 'standard input' - -g "$skirt" -g "$root/garments/skirt.garment" -o bad
echo 'a file' >file
ok 'the paper knows no fixed topology' must_fail 2 "$KITSUKE" dress --method paper --topology fixed "$walk" \
    -g "$skirt" -o bad
ok 'a folder that is a file' refuses 4 'file' "$walk" -g "$skirt" -o file --no-times --frames 1:2
"$KITSUKE" walk --preset paper --steps 60 -o long.bvh
ok 'where nothing can be written nothing is computed' must_fail 4 timeout 30 "$KITSUKE" compare long.bvh -g "$skirt" \
    -o /proc/self --repeat 16
is 'nothing is written' "$(ls -d bad 2>/dev/null)" ''
done_testing
