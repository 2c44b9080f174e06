#!/bin/sh
# kitsuke walk at the command line: the motions that are shipped are what their lines in
# motions/README.md make, they are read as humans, and what cannot be walked is refused.
. "$(dirname "$0")/lib.sh"

# Equal words, numbers to 0.0002: the last printed digit may differ between maths libraries.
alike() { # alike FILE FILE
    awk 'function far(a, b) { return a - b > 0.0002 || b - a > 0.0002 }
        NR == FNR { line[FNR] = $0; lines = FNR; next }
        { n = split(line[FNR], was)
          if (n != NF) { print "line " FNR ": " NF " words, not " n; exit 1 }
          for (i = 1; i <= NF; i++)
              if ($i != was[i] && (was[i] !~ /^[-0-9.]+$/ || far($i, was[i]))) {
                  print "line " FNR ", word " i ": " was[i] " and " $i; exit 1 } }
        END { if (FNR != lines) { print lines " and " FNR " lines"; exit 1 } }' "$1" "$2"
}

sed -n 's/^| `\([a-z-]*\.bvh\)` .*`kitsuke walk \(.*\)` |$/\1 \2/p' "$root/motions/README.md" >table
is 'motions/README.md lists every motion' "$(cut -d' ' -f1 table | sort | tr '\n' ' ')" \
    "$(cd "$root/motions" && ls ./*.bvh | cut -c3- | sort | tr '\n' ' ')"
while read -r file options; do
    # shellcheck disable=SC2086  # several words
    "$KITSUKE" walk $options -o "$file"
    [ -z "${UPDATE_GOLDEN:-}" ] || cp "$file" "$root/motions/$file"
    ok "motions/$file is what 'kitsuke walk $options' makes" alike "$root/motions/$file" "$file"
    "$KITSUKE" inspect "$file" >told 2>&1
    like "$file: a human of 1.7 m in centimetres" "$(tr -s '\n ' ' ' <told)" 'unit cm .* height 1\.[67][0-9]* m'
    is "$file: nothing to warn of" "$(grep warning told)" ''
done <table

"$KITSUKE" walk --preset paper >paper.bvh
ok 'without -o to standard output' alike "$root/motions/paper-walk.bvh" paper.bvh
is '36 frames a step, two steps' "$(sed -n 's/^Frames: //p' paper.bvh)" 72
"$KITSUKE" walk --preset paper --frames-per-step 10 --steps 3 >short.bvh
is '--frames-per-step and --steps' "$(sed -n 's/^Frames: //p' short.bvh)" 30
"$KITSUKE" walk --step-length 0.6 --speed 1.2 --frames-per-step 25 >timed.bvh
is 'frame time from speed and step length' "$(sed -n 's/^Frame Time: //p' timed.bvh)" 0.02000000
"$KITSUKE" walk --height 1.2 >child.bvh
like '--height' "$("$KITSUKE" inspect child.bvh)" 'height  *1\.[12][0-9]* m'
sizes=''
for height in 0.5 0.55 0.6 0.7 0.8 0.825 0.83 0.9 1 1.3 2 2.2 2.5; do
    "$KITSUKE" walk --height "$height" --steps 2 >sized.bvh
    sizes="$sizes$("$KITSUKE" inspect sized.bvh 2>&1 | awk -v want="$height" '/^  warning/ { print want ":", $0 }
        $1 == "height" && ($2 > 1.02 * want || $2 < 0.98 * want) { print want ": " $2 " m" }')"
done
is 'a child, an adult and a giant are read as tall as they are' "$sizes" ''
is 'the same walk has the same bytes' "$("$KITSUKE" walk | cksum)" "$("$KITSUKE" walk | cksum)"

refuses() { # refuses PATTERN ARGUMENT...: exit 2, that word, and no file
    pattern=$1
    shift
    rm -f no.bvh
    must_fail 2 "$KITSUKE" walk "$@" -o no.bvh || return 1
    says "$pattern" || return 1
    ls | grep no.bvh && { echo 'a file was written'; return 1; }
    return 0
}
ok 'a step longer than legs can make' refuses 'step length of 2 m is not between' --step-length 2
ok 'a step longer than a child can make' refuses 'step length' --step-length 0.7 --height 0.9
ok 'a long step up a steep slope' refuses 'legs are too short' --step-length 1 --slope 35
ok 'a cliff' refuses "option '--slope'" --slope 36
ok 'no steps' refuses "option '--steps'" --steps 0
ok 'a million steps' refuses "option '--steps'" --steps 1000000
ok 'too many frames in all' refuses 'too many' --steps 10000 --frames-per-step 1000
ok 'three frames a step' refuses "option '--frames-per-step'" --frames-per-step 3
ok 'stairs without a count' refuses 'RISE:RUN:COUNT' --stairs 0.17:0.29
ok 'no stairs' refuses 'RISE:RUN:COUNT' --stairs 0.17:0.29:0
ok 'half a stair' refuses 'RISE:RUN:COUNT' --stairs 0.17:0.29:2.5
ok 'stairs with a tail' refuses 'RISE:RUN:COUNT' --stairs 0.17:0.29:5:6
ok 'a wall' refuses 'stair rise' --stairs 0.5:0.29:3
ok 'a ladder' refuses 'stair run' --stairs 0.2:0.1:3
ok 'too many stairs' refuses 'stair count' --stairs 0.17:0.29:5000
ok 'stairs on a slope' refuses 'exclude each other' --stairs 0.17:0.29:3 --slope 5
ok 'fewer steps than stairs' refuses 'too few for 9 stairs' --stairs 0.17:0.29:9 --steps 5
ok 'a squat uphill' refuses 'needs level ground' --preset squat --slope 5
ok 'a squat at a speed' refuses 'takes no' --preset squat --speed 1
ok 'a turn in two steps' refuses 'too few to turn' --preset turn --steps 2
ok 'standing still' refuses "option '--speed'" --speed 0
ok 'steps quicker than anybody' refuses 'time of a step' --speed 5 --step-length 0.3
ok 'an unknown walk' refuses "option '--preset'" --preset moonwalk
done_testing
