#!/bin/sh
# The counts of stats.csv against a count of the written files that shares no code with the program. The
# global shape alone, a sheet that the thighs pierce and a deep squat show plenty to count.
. "$(dirname "$0")/lib.sh"

command -v python3 >log || skip_all 'no python3'
count() { python3 "$root/tests/count_pairs.py" "$@"; }
{
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >flat.obj
    printf 'v 0.2 0.2 -1\nv 0.2 0.2 1\nv 3 3 0\nf 1 2 3\n' >through.obj
    printf 'v 0 0 0\nv -1 0 0\nv -1 -1 0\nf 1 2 3\n' >corner.obj
    printf 'v 0.2 0.2 0.000001\nv 0.3 0.2 0.000001\nv 0.2 0.3 0.000001\nf 1 2 3\n' >above.obj
}
is 'the counter: an edge through a triangle' "$(count through.obj flat.obj)" 1
is 'in one plane: the two edges that end in a corner' "$(count corner.obj flat.obj)" 2
is 'a triangle a micrometre above another' "$(count above.obj flat.obj)" 0
is 'a triangle and itself: all three edges' "$(count flat.obj flat.obj)" 3

{
    printf 'garment sheet\nfollow bones\nfit tight\npatch sheet\n'
    for x in -0.6 -0.2 0.2 0.6; do
        for z in -0.6 -0.2 0.2 0.6; do printf '%s 0.7 %s pelvis 1\n' "$x" "$z"; done
    done
    printf 'collide sheet left_thigh\n' # the right one is no collider: it counts as a limb
} >sheet.garment
"$KITSUKE" dress -q "$root/motions/squat.bvh" -g "$root/garments/skirt.garment" -g "$root/garments/trousers.garment" \
    -g "$root/garments/tshirt.garment" -o global --format obj --method global --frames 1:80:79
"$KITSUKE" dress -q "$root/motions/squat.bvh" -g sheet.garment -g "$root/garments/tshirt.garment" -o push --format obj \
    --frames 80
value() { # value FILE FRAME GARMENT COLUMN...: the sum
    file=$1 frame=$2 garment=$3
    shift 3
    awk -F, -v frame="$frame" -v garment="$garment" -v names="$*" '/^#/ { next }
        !at { n = split(names, name, " "); for (i = 1; i <= NF; i++) for (k = 1; k <= n; k++)
            if ($i == name[k]) use[i] = 1; at = 1; next }
        $1 == frame && $3 == garment { for (i in use) sum += $i } END { print sum + 0 }' "$file"
}
total=0
for run in global/squat push/squat; do
    for mesh in "$run"/*.obj; do
        file=${mesh##*/} garment=${file%%.*} frame=$(echo "${file#*.}" | sed 's/^0*//; s/\..*//')
        [ "$garment" = body ] && continue
        body=$run/body.${file#*.}
        counted() { value "$run/stats.csv" "$frame" "$garment" "$@"; }
        is "$mesh: body edges through the garment" "$(counted residual_edges limb_edges)" \
            "$(count "$body" "$mesh")"
        cloth=$(count "$mesh" "$body")
        is "$mesh: garment edges through the body" "$(counted residual_cloth limb_cloth)" "$cloth"
        total=$((total + cloth))
    done
done
is 'there was something to count' "$((total > 100))" 1
limb=$(value push/squat/stats.csv 80 sheet limb_edges)
is 'what is no collider counts as a limb' "$((limb > 0))" 1
is 'what shows is marked as capped' "$(value push/squat/stats.csv 80 sheet capped)" 1

done_testing
