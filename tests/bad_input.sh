#!/bin/sh
# A table of spoilt inputs: each gives one clear error with its place, the right exit code, and no
# file of a motion. Readers are tested byte by byte in tests/fuzz; here it is the whole program.
. "$(dirname "$0")/lib.sh"

skirt=$root/garments/skirt.garment
"$KITSUKE" walk --preset paper --frames-per-step 4 --steps 1 -o good.bvh || exit 1

# refused DESCRIPTION PATTERN ARGUMENT...: dress with these arguments
refused() {
    what=$1 pattern=$2
    shift 2
    ok "$what" refuse "$@"
}
refuse() {
    rm -rf out.d
    must_fail 3 "$KITSUKE" dress -q -o out.d "$@" || return 1
    says "$pattern" || return 1
    [ "$(grep -Ec '(: error: |^kitsuke: )' err)" -eq 1 ] || { echo 'not exactly one error'; return 1; }
    left=$(find . -path './out.d/*' ! -name summary.csv)
    [ -z "$left" ] || { echo "left behind: $left"; return 1; }
}
motion() { # motion DESCRIPTION PATTERN: of the file x.bvh
    refused "motion: $1" "$2" x.bvh -g "$skirt"
}
garment() {
    refused "garment: $1" "$2" good.bvh -g x.garment
}
body() {
    refused "body: $1" "$2" good.bvh -g "$skirt" --body x.body
}
roles() {
    refused "roles: $1" "$2" good.bvh -g "$skirt" --roles x.roles
}
once() { # once PATTERN ARGUMENT...: however many motions there are, it is said once, and nothing is begun
    pattern=$1
    shift
    must_fail 3 "$KITSUKE" dress good.bvh "$root/motions" -g "$skirt" "$@" -o once &&
        [ ! -e once ] && says "$pattern" && [ "$(grep -Ec '(: error: |^kitsuke: )' err)" -eq 1 ]
}
line() { grep -n "$1" good.bvh | head -n 1 | cut -d: -f1; }
frame1=$(($(line '^Frame Time') + 1))
last=$(wc -l <good.bvh | tr -d ' ')

ok 'the whole one is dressed' "$KITSUKE" dress -q good.bvh -g "$skirt" -o whole --format none
refused 'motion: missing' "cannot open 'nowhere.bvh': No such file" nowhere.bvh -g "$skirt"
# In the folder where "$unset" leaves the shell there are motions
refused 'motion: no name' "cannot open ''" '' -g "$skirt"
mkdir empty
refused 'motion: a folder without motions' "no motion .* in the folder 'empty'" empty -g "$skirt"
: >x.bvh; motion empty "'x.bvh' is empty"
cp good.bvh x.bvh; chmod a-r x.bvh
if [ -r x.bvh ]; then skip 'motion: unreadable' 'this is root'
else motion unreadable "cannot open 'x.bvh': Permission denied"; fi
rm -f x.bvh
head -c 3000 "$KITSUKE" >x.bvh; motion 'a binary file' 'binary'
{ head -n "$last" good.bvh; printf '\000\001\002'; } >x.bvh
ok 'motion: bytes behind the last frame are no error' "$KITSUKE" dress -q x.bvh -g "$skirt" -o tail --format none
printf 'v 0 0 0\nf 1 1 1\n' >x.bvh; motion 'some other text' 'x.bvh:1:1: error: neither BVH nor'
printf '# A note\nfor the reader\n' >x.bvh
motion 'a text that begins like an AMC' 'x.bvh:2:1: error: neither BVH nor Acclaim'
head -c 300 good.bvh >x.bvh; motion 'cut in the hierarchy' '^x.bvh:[0-9]+:[0-9]+: error: '
sed '/^MOTION/,$d' good.bvh >x.bvh; motion 'no MOTION' 'ends before MOTION'
sed '/^Frame Time/q' good.bvh >x.bvh; motion 'no row' "^x.bvh:$frame1:1: error: .*before the first frame"
sed 's/^Frames:.*/Frames: 0/' good.bvh >x.bvh; motion 'no frames' "^x.bvh:$((frame1 - 2)):9: error: .*no frames"
sed 's/^Frames:.*/Frames: 99999999999999/' good.bvh >x.bvh; motion 'a huge number of frames' 'number of frames is'
sed 's/^Frames:.*/Frames: -4/' good.bvh >x.bvh; motion 'a negative one' 'no frames'
sed 's/^Frame Time.*/Frame Time: 0/' good.bvh >x.bvh; motion 'frame time 0' 'frame time is not positive; give .* --fps'
ok 'motion: and --fps gives it' "$KITSUKE" dress -q x.bvh -g "$skirt" -o fps --fps 30 --format none
for number in nan inf -nan 1e999 0x10 1,5 five; do
    sed "$last"'s/^[^ ]*/'"$number/" good.bvh >x.bvh
    motion "a value '$number'" "^x.bvh:$last:1: error: frame 4, joint 'Hips', Xposition"
done
sed 's/CHANNELS 3/CHANNELS 1000000/' good.bvh >x.bvh; motion 'a million channels' '1000000 CHANNELS: a joint has 0 to 9'
sed 's/CHANNELS 3 Xrotation/CHANNELS 3 Wrotation/' good.bvh >x.bvh; motion 'an unknown channel' "found 'Wrotation'"
sed 's/OFFSET/OFSET/' good.bvh >x.bvh; motion 'an unknown word' "x.bvh:4:2: error: .*found 'OFSET'"
sed '4s/OFFSET.*/OFFSET 0 zero 0/' good.bvh >x.bvh; motion 'a word for a number' "x.bvh:4:11: error: .*found 'zero'"
sed '4s/OFFSET.*/OFFSET 0 1e300 0/' good.bvh >x.bvh; motion 'an offset beyond all bounds' '^(x.bvh:4:|kitsuke: )'
awk 'BEGIN { print "HIERARCHY\nROOT a"
             for (i = 0; i < 10000; i++) print "{\nOFFSET 0 1 0\nCHANNELS 0\nJOINT j" i }' >x.bvh
motion 'joints nested 10,000 deep' '^x.bvh:[0-9]+:[0-9]+: error: .*nested'
awk 'BEGIN { print "HIERARCHY\nROOT a\n{\nOFFSET 0 1 0\nCHANNELS 0"
             for (i = 0; i < 20000; i++) print "JOINT j" i "\n{\nOFFSET 0 1 0\n}" }' >x.bvh
motion '20,000 joints' '^x.bvh:[0-9]+:[0-9]+: error: .*joints'
awk "NR >= $frame1 { NF = int(NF / 2) } { print }" good.bvh >x.bvh
motion 'rows of half the length' 'head and motion are of different skeletons'
sed 's/LeftUpLeg/tail/; s/LeftLeg/tail2/; s/LeftFoot/tail3/; /OFFSET 8.84/s/.*/OFFSET 0 9 -40/' good.bvh >x.bvh
"$KITSUKE" inspect x.bvh >look 2>&1
is 'motion: inspect tells about any skeleton' $? 0
printf '1\nroot 0 0 0 0 0 0\n' >x.amc
refused 'motion: AMC without its skeleton' "no skeleton for 'x.amc': .*give --asf" x.amc -g "$skirt"
refused 'motion: AMC with a skeleton that is not there' "cannot open 'nowhere.asf'" x.amc -g "$skirt" --asf nowhere.asf
printf ':version 1.10\n' >x.asf
refused 'motion: AMC with a skeleton without bones' '^x.asf:[0-9]+:[0-9]+: error: ' x.amc -g "$skirt"
cut() { # every 61st prefix is dressed or refused, never anything else
    n=$(wc -c <good.bvh)
    for i in $(awk "BEGIN { for (i = 0; i < $n; i += 61) print i }"); do
        head -c "$i" good.bvh >x.bvh
        code=0
        "$KITSUKE" dress -q x.bvh -g "$skirt" -o cut -f --format none --frames 1:1 >log.cut 2>&1 || code=$?
        [ "$code" -eq 0 ] || [ "$code" -eq 3 ] || { echo "exit $code at byte $i"; cat log.cut; return 1; }
    done
    code=0
}
ok 'motion: cut anywhere' cut

refused 'garment: missing' "cannot open 'nowhere.garment'" good.bvh -g nowhere.garment
refused 'garment: a folder' "'empty': it is a directory" good.bvh -g empty
: >x.garment; garment empty 'x.garment'
head -c 3000 "$KITSUKE" >x.garment; garment 'a binary file' 'binary'
place='^x.garment:[0-9]+:[0-9]+: error: '
spoilt() { # spoilt DESCRIPTION PATTERN SED: the skirt with a change
    sed "$3" "$skirt" >x.garment
    garment "$1" "$place.*$2"
}
spoilt 'an unknown bone' left_thigth 's/left_thigh/left_thigth/'
spoilt 'called body' body 's/^garment .*/garment body/'
spoilt 'a name that leads out' '' 's/^garment .*/garment ..\/..\/x/'
spoilt 'nan' number 's/^ring hip .*/ring hip pelvis 0.4 ease nan/'
spoilt 'a huge number' '' 's/^ring hip .*/ring hip pelvis 0.4 ease 1e9/'
spoilt 'per cent of a bone' 'from -10 to 10' 's/^ring hip .*/ring hip pelvis 40/'
sed 's/^ring hip .*/ring hip pelvis 0.4 ease -0.5/' "$skirt" >x.garment
garment 'a ring that leaves no room for the body' "ring 'hip' has no size left"
spoilt 'an unknown side' up 's/^seam front.end/seam front.up/'
spoilt 'a seam that does not meet' '' 's/^seam front.end back.start/seam front.end back.end/'
spoilt 'a row that goes nowhere' '' 's/  row knee  left front right/  row knee  left front left/'
{
    printf 'garment rag\nfollow bones\nfit loose\npatch rag\n'
    awk 'BEGIN { for (i = 0; i < 16; i++) print "  0 1 0.2 pelvis 1" }'
} >x.garment
garment 'a degenerate patch' "$place"
awk 'BEGIN { print "garment x"; for (i = 0; i < 30000; i++) print "ring r" i " pelvis 1 ease 0" }' >x.garment
garment '30,000 rings' "$place"

sed '/^part pelvis/,/^caps/d' "$root/garments/adult.body" >bare.body
ok 'garment: on a part that the body does not have' \
    once "ring 'waist' is on 'pelvis', which the body does not have" --body bare.body
refused 'body: missing' "cannot open 'nowhere.body'" good.bvh -g "$skirt" --body nowhere.body
: >x.body; body empty 'x.body'
printf 'body x\npart tail\n  0 0 0 0.1 0.1 0.1\n' >x.body; body 'an unknown bone' '^x.body:2:6: error: .*tail'
printf 'body x\npart pelvis\n' >x.body; body 'a part without sections' '^x.body:[0-9]+:[0-9]+: error: '
head -c 3000 "$KITSUKE" >x.body; body 'a binary file' 'binary'

refused 'roles: missing' "cannot open 'nowhere.roles'" good.bvh -g "$skirt" --roles nowhere.roles
printf 'tail = Hips\n' >x.roles; roles 'an unknown role' "^x.roles:1:1: error: .*tail"
ok 'roles: what no motion could mend' once "^x.roles:1:1: error: .*tail" --roles x.roles
printf 'pelvis = Hipps\n' >x.roles; roles 'an unknown joint' '^x.roles:1:10: error: .*Hipps'
printf 'pelvis Hips\n' >x.roles; roles 'no equals sign' '^x.roles:1:[0-9]+: error: '
printf 'pelvis = Hips\nspine = Hips\n' >x.roles
roles 'a joint twice' "^x.roles:2:9: error: joint 'Hips' plays two roles"
printf 'left_thigh = none\n' >x.roles; roles 'a role taken away' 'left_thigh'
printf '# none\n\npelvis = Hips\n' >x.roles
ok 'roles: by hand' "$KITSUKE" dress -q good.bvh -g "$skirt" -o hand --roles x.roles --format none

inspects() { must_fail "$1" "$KITSUKE" inspect "$2" && grep -Eq "$3" err; }
ok 'inspect: missing' inspects 3 nowhere "cannot open 'nowhere'"
ok 'inspect: a folder' inspects 3 empty 'directory'
printf 'garment x\nring a tail 1 ease 0\n' >x.garment
grep -v '^collide' "$skirt" >bare.garment
like 'inspect: a garment that keeps out of nothing' "$("$KITSUKE" inspect bare.garment)" '^  collides    nothing$'
marked() { # with a byte-order mark, as some editors write it
    printf '\357\273\277# by hand\n' | cat - "$1" >marked && "$KITSUKE" inspect marked
}
like 'inspect: a garment with a byte-order mark' "$(marked "$skirt")" '^marked: garment skirt$'
like 'inspect: a body with one' "$(marked "$root/garments/adult.body")" '^marked: body adult$'
ok 'inspect: a garment with a mistake' inspects 3 x.garment '^x.garment:2:8: error: '
like 'inspect: how large a garment is' "$("$KITSUKE" inspect "$skirt")" \
    '^  size        0\.56[0-9] m wide, 0\.[56][0-9]* m high, 0\.40[0-9] m deep, where the figure is 1.70 m tall$'
printf 'ring a pelvis 1\n' >x.garment
ok 'inspect: a garment without its name' inspects 3 x.garment "^x.garment:1:1: .*begin with 'garment NAME'"
printf 'part head\n' >x.body
ok 'inspect: a body without its name' inspects 3 x.body "^x.body:1:1: .*expected 'body NAME'"
done_testing
