#!/bin/sh
# Job files: a command line as text. What they say, what wins, where mistakes are, and the way back.
. "$(dirname "$0")/lib.sh"

skirt=$root/garments/skirt.garment
mkdir -p jobs motions
"$KITSUKE" walk --preset paper --frames-per-step 4 --steps 2 -o motions/walk.bvh || exit 1
cp motions/walk.bvh 'motions/two words # and "quotes".bvh'
cp "$skirt" jobs/
dress() { "$KITSUKE" dress -q "$@"; }
refuses() { # refuses PATTERN: the job x.job, exit 2 and a line of stderr
    must_fail 2 "$KITSUKE" dress --job jobs/x.job && says "$1"
}

cat >jobs/plain.job <<'JOB'
# Everything that a run needs, relative to this folder.
motion ../motions/walk.bvh      # a comment
garment	skirt.garment
output ../made
frames 2:5:3
format obj
no-body
no-times yes
quiet
JOB
ok 'a job is a whole command line' "$KITSUKE" dress --job jobs/plain.job
is 'paths are seen from the file, values are taken' "$(find made -type f ! -name .done | sort | tr '\n' ' ')" \
    'made/summary.csv made/walk/skirt.0002.obj made/walk/skirt.0005.obj made/walk/stats.csv '
dress motions/walk.bvh -g "$skirt" -o typed --frames 2:5:3 --format obj --no-body --no-times
ok 'and writes the bytes of that command line' diff -r made typed
printf 'motion %s\ngarment %s\noutput made\n' "$PWD/motions/walk.bvh" "$skirt" >jobs/far.job
ok 'a path from the root is taken as it is' dress --job jobs/far.job --frames 1 --format none
is 'and one that is not, not' "$(ls -d jobs/made)" jobs/made
(cd jobs && dress --job plain.job -f)
ok 'from the folder itself' diff -r made typed
dress -f --job - <<'JOB'
motion motions/walk.bvh
garment jobs/skirt.garment
output piped
frames 1
format none
JOB
is 'from standard input, relative to the current folder' "$(joined frames piped/summary.csv)" '1 '
ok 'what the command line says wins' dress --job jobs/plain.job --frames 1:3 --body-detail 8 --no-no-body -o wins
is 'a value, a switch and a path' "$(find wins -name '*.obj' | wc -l | tr -d ' ')" 6
dress --job jobs/plain.job -o lists motions/*.bvh -f
is 'a list on the command line replaces the list' "$(joined frames lists/summary.csv)" '2 2 '
"$KITSUKE" dress --job jobs/plain.job -v -f 2>err
like 'a switch wins over the one it contradicts' "$(cat err)" 'together'

printf 'motion ../motions/walk.bvh\n  detial 3\n' >jobs/x.job
ok 'an unknown key, with its place and the nearest one' \
    refuses "^jobs/x.job:2:3: error: unknown option 'detial'; did you mean 'detail'"
printf 'detail 300\n' >jobs/x.job
ok 'a value out of range' refuses "^jobs/x.job:1:8: error: option '--detail': expected .*'300'"
printf 'detail\n' >jobs/x.job
ok 'no value' refuses "^jobs/x.job:1:7: error: 'detail' needs a value: N"
printf 'steps 3\n' >jobs/x.job
ok 'a key of another command' refuses "^jobs/x.job:1:1: error: 'dress' has no option 'steps'"
printf 'job plain.job\n' >jobs/x.job
ok 'a job in a job' refuses '^jobs/x.job:1:1: error: a job file cannot name another'
printf 'no-body perhaps\n' >jobs/x.job
ok 'a switch that is neither on nor off' refuses "^jobs/x.job:1:9: error: .*'perhaps'"
printf 'no-quiet yes\n' >jobs/x.job
ok 'a switch taken back twice' refuses '^jobs/x.job:1:10: error: '
printf 'output "a\n' >jobs/x.job
ok 'an open quote' refuses "^jobs/x.job:1:10: error: expected '\"'"
printf 'output "a\\q"\n' >jobs/x.job
ok 'an unknown escape' refuses '^jobs/x.job:1:10: error: '
printf 'output "a" b\n' >jobs/x.job
ok 'more behind the quotes' refuses '^jobs/x.job:1:12: error: '
ok 'a job file that is not there: exit 3' must_fail 3 "$KITSUKE" dress --job jobs/nowhere.job
head -c 2000 "$KITSUKE" >jobs/x.job
ok 'a binary file: exit 3' must_fail 3 "$KITSUKE" dress --job jobs/x.job

# The way back
odd='motions/two words # and "quotes".bvh'
new='motions/new
line.bvh'
cp motions/walk.bvh "$new"
set -- "$odd" "$new" motions/walk.bvh -g jobs/skirt.garment --frames 1:7:3 --output-unit in --rate 33.3 \
    --draco-speed 0 --format obj,drc --no-times --no-body -q
"$KITSUKE" dress "$@" -o first --print-job >first.job
is '--print-job does nothing else' "$(ls -d first 2>&1 | grep -c 'No such')" 1
ok 'the command line runs' "$KITSUKE" dress "$@" -o first
ok 'its job runs' "$KITSUKE" dress --job first.job -o second
ok 'and writes the same bytes' diff -r first second
"$KITSUKE" dress --job first.job --print-job >again.job
same 'the job of the job is the job' again.job first.job
like 'it holds what was said' "$(cat first.job)" '^frames 1:7:3$'
is 'and nothing else' "$(grep -c -v '^#' first.job)" 13
"$KITSUKE" walk --speed 0.9 --steps 3 --print-job >walk.job
"$KITSUKE" walk --job walk.job >a.bvh
"$KITSUKE" walk --speed 0.9 --steps 3 >b.bvh
same 'other commands have jobs too' a.bvh b.bvh
like 'also for the folders that they read' "$("$KITSUKE" verify first --list --print-job)" '^folder first$'
for value in '"x' '"' 'x"y"' '#x' 'x #y' 'x#y' ' x' 'x ' 'a\b' 'tab	x' \
    'a b c d e f g h i j k l m n o p q r s t u v w x y z'; do
    "$KITSUKE" walk -o "$value" --print-job >a.job && "$KITSUKE" walk --job a.job --print-job >b.job &&
        cmp -s a.job b.job || echo "$value"
done >lost
is 'a value begins, goes on and ends as it likes' "$(cat lost)" ''

# Lists of files
printf '%s\n' motions/walk.bvh "$odd" '' motions/nowhere.bvh >list
must_fail 3 "$KITSUKE" dress -q --files-from list -g "$skirt" -o listed --frames 1 --format none >log
is '--files-from: one path in a line, blanks and # and all' "$(joined status listed/summary.csv)" 'ok ok refused '
find motions -name '*.bvh' -print0 | "$KITSUKE" dress -q --files-from - -g "$skirt" -o zero --frames 1 --format none
is 'separated by NUL from standard input, with a newline in a name' "$(column status zero/summary.csv | wc -w)" 3
printf '\357\273\277%s\r\n%s\r\n' motions/walk.bvh "$odd" >dos
"$KITSUKE" dress -q --files-from dos -g "$skirt" -o dos.out --frames 1 --format none
is 'as Windows writes it, with a byte-order mark' "$(joined status dos.out/summary.csv)" 'ok ok '
ok 'a list that is a folder: exit 3' eval 'must_fail 3 "$KITSUKE" dress --files-from motions -g "$skirt" -o none &&
    says "cannot read .motions.: it is a directory"'
ok 'a list that is not there: exit 3' must_fail 3 "$KITSUKE" dress --files-from nowhere -g "$skirt" -o none
: >empty
ok 'an empty list: exit 3' must_fail 3 "$KITSUKE" dress --files-from empty -g "$skirt" -o none
ok 'standard input as a motion and as the list' must_fail 2 "$KITSUKE" dress --files-from - - -g "$skirt" -o none
dress 'motions/*.bvh' -g "$skirt" -o glob --frames 1 --format none
is 'a pattern in quotes' "$(column status glob/summary.csv | wc -w)" 3
cp motions/walk.bvh 'motions/[x].bvh'
dress 'motions/[x].bvh' -g "$skirt" -o bracket --frames 1 --format none
is 'a name that looks like a pattern is a name first' "$(joined motion bracket/summary.csv)" '[x] '
ok 'a pattern that matches nothing: exit 3' must_fail 3 dress 'motions/*.amc' -g "$skirt" -o none
done_testing
