#!/bin/sh
# The command line: help, version, exit codes, and every option refused with nonsense.
. "$(dirname "$0")/lib.sh"

walk=$root/motions/paper-walk.bvh
skirt=$root/garments/skirt.garment
commands='compare draw dress inspect verify walk'

refuses() { # refuses EXIT PATTERN ARGUMENT...
    refusal=$1 pattern=$2
    shift 2
    must_fail "$refusal" "$KITSUKE" "$@" && says "$pattern"
}

ok 'without arguments: purpose, an example, where to read on' refuses 2 "Use 'kitsuke --help'"
is 'and nothing on standard output' "$(wc -c <out | tr -d ' ')" 0
like '--version' "$("$KITSUKE" --version)" '^kitsuke [0-9]+\.[0-9]+\.[0-9]+$'
is '-V is --version' "$("$KITSUKE" -V)" "$("$KITSUKE" --version)"
like '--help tells the exit codes' "$("$KITSUKE" --help)" 'Exit status: 0 done'
is 'help is --help' "$("$KITSUKE" help)" "$("$KITSUKE" --help)"
is '-h is --help' "$("$KITSUKE" -h)" "$("$KITSUKE" --help)"

for command in $commands; do
    "$KITSUKE" "$command" --help >help.$command 2>err
    is "$command --help: exit 0" $? 0
    like "$command --help: an example that can be typed" "$(sed -n '/^Example/,/^$/p' help.$command)" \
        "^  kitsuke $command "
    is "$command --help: no line over 80 columns" "$(awk 'length > 80' help.$command)" ''
    is "$command --help: nothing on stderr" "$(cat err)" ''
    is "$command -h" "$("$KITSUKE" $command -h)" "$(cat help.$command)"
    is "help $command" "$("$KITSUKE" help $command)" "$(cat help.$command)"
    like "--help lists $command" "$("$KITSUKE" --help)" "^  $command "
done

like 'help tells the range of a number, its step and its default' "$(tr -s ' \n' ' ' <help.dress)" \
    'round each section of the body \(8\.\.64, a multiple of 4; default: 16\)'
in_readme() {
    for command in $commands; do
        for name in $(sed -n 's/^  \(-.,\|   \) --\([a-z-]*\).*/\2/p' help.$command); do
            grep -q -e "\`--$name\`" "$root/README.md" && continue
            case $name in help | version) ;; *) echo "README.md says nothing of --$name"; return 1 ;; esac
        done
    done
}
ok 'the README names every option' in_readme

# Every option with a value that is no name of a file, as the help lists them.
nonsense() {
    for command in $commands; do
        sed -n 's/^  \(-.,\|   \) --\([a-z-]*\) \([A-Z].*\)$/\2 \3/p' help.$command >options
        [ -s options ] || [ "$command" = inspect ] || return 1
        while read -r name argument _; do
            case $argument in FILE | DIR | NAMES) continue ;; esac
            refuses 2 "option '--$name'" "$command" "--$name=nonsense" || return 1
            refuses 2 "option '--$name'" "$command" "--$name=" || return 1
            refuses 2 "option '--$name'" "$command" "--$name" || return 1
        done <options
    done
}
ok 'every option refuses nonsense, an empty value and none' nonsense

ranges() {
    for command in $commands; do
        tr '\n' ' ' <help.$command | sed 's/  */ /g; s/ --/\n--/g' |
            sed -n 's/^--\([a-z-]*\) [A-Z/]* .*(\(-*[0-9.]*\)\.\.\([0-9.]*\)[,;)].*/\1 \2 \3/p' >options
        while read -r name low high; do
            refuses 2 "option '--$name'" "$command" "--$name" "$(awk "BEGIN { print $low - 1 }")" || return 1
            refuses 2 "option '--$name'" "$command" "--$name" "$(awk "BEGIN { print $high + 1 }")" || return 1
            refuses 2 "option '--$name'" "$command" "--$name" nan || return 1
            echo "$name" >>ranged
        done <options
    done
    [ "$(wc -l <ranged)" -ge 15 ] || { echo 'too few options with a range were found'; cat ranged; return 1; }
}
ok 'every number outside its range, as the help tells it, is refused' ranges

files() {
    for option in roles body garment; do
        refuses 3 nowhere dress "$walk" -g "$skirt" -o o --frames 1:1 "--$option" nowhere || return 1
        [ ! -e o/paper-walk ] || return 1
    done
}
ok 'every option that names a file says when there is none: exit 3' files

ok 'an unknown option, with the nearest one' \
    refuses 2 "unknown option '--detial'; did you mean '--detail'" dress --detial 3
ok 'the beginning of an option is suggested, not taken' \
    refuses 2 "did you mean '--draco-position-bits'" dress --draco-pos 3
ok 'an unknown letter' refuses 2 "unknown option '-z' in '-qz'" dress -qz
ok 'an option of another command' refuses 2 "'inspect' has no option '--garment'" inspect --garment x
ok 'an unknown command, with the nearest one' refuses 2 "did you mean 'dress'" drees
ok 'the nearest, not the first that is near' refuses 2 "did you mean 'draw'" drew
ok 'an option in front of the command' refuses 2 "expected a command in front of '-q'" -q dress
ok 'a mistake tells where to read on' refuses 2 "^Use 'kitsuke dress --help'" dress --nope
ok 'contradicting options are both named' refuses 2 "'--quiet' and '--verbose'" dress -q -v
ok 'also where one stands in a job file' eval 'printf "quiet\nverbose\n" >both.job &&
    refuses 2 "contradict" dress --job both.job'
ok 'a list has no columns to add' refuses 2 "'--list' and '--landmarks'" verify x --list --landmarks
ok 'none beside another format' refuses 2 "'none'" dress --format obj,none
ok 'a switch takes yes and no only' refuses 2 "option '--force' is a switch" dress --force=perhaps
ok 'no motion' refuses 2 'nothing to dress' dress -g "$skirt" -o o
ok 'no garment' refuses 2 'nothing to put on' dress "$walk" -o o
ok 'no output' refuses 2 'no place to write to' dress "$walk" -g "$skirt"
ok 'the same garment twice' refuses 2 "both called 'skirt'" dress "$walk" -g "$skirt" -g "$skirt" -o o
ok 'frames that the motion does not have' refuses 2 "begins at 5000" dress "$walk" -g "$skirt" -o o --frames 5000:6000
for span in 0 3:2 1:2:0 a 1:2:3:4 1.5 -3 1::-1; do
    ok "--frames $span" refuses 2 "option '--frames'" dress "--frames=$span"
done
for command in dress compare; do
    ok "$command writes a folder, not standard output" refuses 2 "expected a folder" $command "$walk" -g "$skirt" -o -
done
is 'and makes none that is called -' "$(ls -d ./- 2>/dev/null)" ''
ok 'nothing to inspect' refuses 2 'nothing to inspect' inspect
ok '--joints of frames that the motion does not have' refuses 2 'begins at 73' inspect --joints --frames 73 "$walk"
"$KITSUKE" inspect --joints --frames 60::6 "$walk" >joints.csv
is 'and of those that it has' "$(cut -d, -f1 joints.csv | uniq | tr '\n' ' ')" 'frame 60 66 72 '
ok '--joints takes one file' refuses 2 "'--joints'" inspect --joints "$walk" "$walk"
ok 'nothing to verify' refuses 2 'nothing to verify' verify
ok 'a garment without a body' refuses 2 "needs '--body'" verify -g x
ok 'folders or meshes, not both' refuses 2 "'x' and '--body'" verify --body b x
ok 'walk reads no file' refuses 2 "'walk' reads no file" walk "$walk"

# The same run, spelled in many ways.
run() { # run FOLDER ARGUMENT...: and what it wrote, without times
    folder=$1
    shift
    "$KITSUKE" dress --no-times "$@" >out 2>err || { cat err; return 1; }
    cmp "$folder/paper-walk/stats.csv" plain/paper-walk/stats.csv
}
"$KITSUKE" dress "$walk" -g "$skirt" -o plain --frames 1:2 --no-times -q
ok '--name value' run a "$walk" --garment "$skirt" --output a --frames 1:2
ok '--name=value' run b "$walk" --garment="$skirt" --output=b --frames=1:2
ok '-oDIR' run c "$walk" -g"$skirt" -oc --frames 1:2
ok 'a cluster that ends in a value' run d "$walk" --frames 1:2 -g "$skirt" -qfod
ok 'options behind and between operands' run e -o e -g "$skirt" --frames 1:2 "$walk" -q
ok '-- ends the options' run f -o f -g "$skirt" --frames 1:2 -q -- "$walk"
ok 'the last one wins' run g "$walk" -g "$skirt" -o nowhere --frames 4:9 --frames 1:2 -o g
ok 'a switch is taken back' run h "$walk" -g "$skirt" --frames 1:2 -o h --no-body --no-no-body --strict --no-strict
ok 'and the body is there again' test -f h/paper-walk/body.0001.obj
ok 'nothing was written to the folder that lost' test ! -e nowhere
cp "$walk" ./-x.bvh
ok 'an operand that begins with a dash' "$KITSUKE" inspect -- -x.bvh
must_fail 3 "$KITSUKE" dress - -g "$skirt" -o i >log
is 'where nothing comes from' "$(cat err)" "kitsuke: '<stdin>' is empty"
from_pipe() { "$KITSUKE" dress - -g "$skirt" -o i --frames 1:1 -q <"$walk" && [ -f i/stdin/skirt.0001.obj ]; }
ok '- is standard input' from_pipe
# Whatever a command line names may be a pipe, which can be read only once.
piped() { # piped FILE ARGUMENT...: one frame, dressed with the file on /dev/stdin, is that of files
    file=$1
    shift
    rm -rf piped
    cat "$file" | "$KITSUKE" dress -o piped --frames 1 --no-times -q "$@" &&
        diff piped/*/stats.csv from_files/*/stats.csv
}
"$KITSUKE" dress "$walk" -g "$skirt" -o from_files --frames 1 --no-times -q
ok 'a motion may be a pipe' piped "$walk" /dev/stdin -g "$skirt"
ok 'a garment, too' piped "$skirt" "$walk" -g /dev/stdin
ok 'a body' piped "$root/garments/adult.body" "$walk" -g "$skirt" --body /dev/stdin
printf 'pelvis = Hipps\n' >x.roles
piped_roles() { cat x.roles | "$KITSUKE" dress "$walk" -g "$skirt" -o piped --roles /dev/stdin -f -q 2>err; }
piped_roles
is 'roles from one are not passed over' "$?,$(head -n 1 err)" \
    "3,/dev/stdin:1:10: error: unknown joint 'Hipps'; did you mean 'Hips'?"
like 'inspect looks into one' "$(cat "$walk" | "$KITSUKE" inspect /dev/stdin)" '^/dev/stdin: BVH motion$'
like 'and tells how it knows the unit' "$("$KITSUKE" inspect "$walk")" \
    '^  unit        cm \(0\.01 m\), found from the size$'
like 'or that it was told' "$("$KITSUKE" inspect --unit cm "$walk")" '^  unit        given \(0\.01 m\)$'

"$KITSUKE" inspect "$walk" >out 2>err
is 'inspect says nothing on stderr' "$(cat err)" ''
"$KITSUKE" dress "$walk" -g "$skirt" -o j --frames 1:2 >out 2>err
is 'dress says nothing on standard output' "$(cat out)" ''
like 'but a summary on stderr' "$(cat err)" '^1 of 1 motion dressed, 2 frames, '
"$KITSUKE" dress "$walk" -g "$skirt" -o j -f --frames 1:2 -q >out 2>err
is '--quiet says nothing' "$(cat out err)" ''
must_fail 3 "$KITSUKE" dress none.bvh -g "$skirt" -o j -f >log
is 'one motion that fails is one message' "$(wc -l <err | tr -d ' ')" 1
"$KITSUKE" dress "$walk" -g "$skirt" -o j -f --frames 1:2 -v 2>err
stages() {
    awk '/ s +[0-9.]+ %/ { for (i = 1; i <= NF; i++) if ($i == "s") sum += $(i - 1) } /together/ { whole = $2 }
         END { d = sum - whole; exit !(whole > 0 && d < 0.01 && d > -0.01) }' err
}
ok '--verbose prints stages that add up to the whole' stages
# Waiting is no work: no more than all threads have had.
"$KITSUKE" dress "$walk" -g "$skirt" -g "$root/garments/trousers.garment" -o j -f --frames 1:8 -j 3 -v 2>err
worked() { awk '/together/ { if ($2 <= 3 * $8 + 0.003) good = 1 } END { exit !good }' err && stages; }
ok 'and on three threads to no more than they had' worked
"$KITSUKE" dress "$walk" -g "$skirt" -o j -f --frames 1:3 --progress always 2>err
like '--progress always draws a line' "$(tr '\r' '\n' <err)" '^.\[J[01]/1 motions, [0-9]+ frames/s'
"$KITSUKE" dress "$walk" -g "$skirt" -o j -f --frames 1:3 2>err
is 'no progress on a pipe' "$(tr -d -c '\r' <err | wc -c | tr -d ' ')" 0

if [ -w /dev/full ]; then
    full() { must_fail 4 sh -c '"$KITSUKE" inspect --joints "$1" >/dev/full' sh "$walk" && says 'standard output'; }
    ok 'standard output on a full disk: exit 4' full
    full_output() { must_fail 4 sh -c '"$KITSUKE" walk -o - >/dev/full' && says 'cannot write to standard output: No'; }
    ok 'also where it is what --output names' full_output
    ok 'what cannot be written is named' refuses 4 "cannot write '/dev/full': No space left" walk -o /dev/full
else
    skip 'standard output on a full disk' 'no /dev/full'
fi
gone() { "$KITSUKE" inspect --joints "$walk" 2>err | head -n 1 >out && [ ! -s err ]; }
ok 'a reader that goes away ends it quietly' gone
gone_verify() { # nobody reads before 'true' has ended
    "$KITSUKE" dress "$walk" -g "$skirt" --frames 1:2 -o gone -q || return 1
    (sleep 0.2; exec "$KITSUKE" verify gone 2>err) | true
    [ ! -s err ]
}
ok 'that of verify too' gone_verify
done_testing
