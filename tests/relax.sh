#!/bin/sh
# --relax-arms: arms that hang in the skirt leave it, smoothly, and the same whatever else is asked for.
. "$(dirname "$0")/lib.sh"

skirt=$root/garments/skirt.garment trousers=$root/garments/trousers.garment
dress() { "$KITSUKE" dress -q --no-times --no-body -g "$skirt" "$@"; }
limbs() { joined limb_frames "$1/summary.csv"; } # frames in which a limb goes through the garment

# The paper's walk; in its middle the arms come in by so many degrees and go out again.
arms_in() {
    awk -v most="$1" '/^Frame Time/ { print; rows = 1; next } !rows { print; next }
        { d = k++ - 36; d = most - (d < 0 ? -d : d); if (d < 0) d = 0
          sub(/ -73\.0000 /, sprintf(" %.4f ", -73 - d)); sub(/ 73\.0000 /, sprintf(" %.4f ", 73 + d)); print }' \
        "$root/motions/paper-walk.bvh"
}
arms_in 25 >near.bvh
arms_in 30 >through.bvh
thinned() { # every N-th row of a motion
    awk -v n="$1" '/^Frames:/ { print "Frames:", $2 / n; next }
        /^Frame Time:/ { print "Frame Time:", $3 * n; rows = 1; next }
        !rows || (k++ % n == 0)' near.bvh
}
thinned 2 >half.bvh
thinned 4 >quarter.bvh

dress near.bvh -o plain --format obj
dress near.bvh -o relaxed --format obj --relax-arms
is 'without it arms stay' "$(column arm_turn plain/near/stats.csv | sort -u)" 0.000000
is 'with it none is left in the skirt' "$(limbs relaxed)" '0 '
dress through.bvh -o through --format none
dress through.bvh -o apart --format none --relax-arms
ok 'where they come in farther they leave it no room' test "$(limbs through)" -gt 0
is 'with it they do' "$(limbs apart)" '0 '
"$KITSUKE" dress through.bvh -g "$skirt" -o said --format none 2>err
like 'the last line tells that they are in it' "$(tail -n 1 err)" \
    ", 0 with residuals, $(limbs through | tr -d ' ') with limbs in the cloth, "
"$KITSUKE" dress through.bvh -g "$skirt" -o unsaid --format none --relax-arms 2>err
like 'and nothing where they are not' "$(tail -n 1 err)" ', 0 with residuals, 0\.0 kB in '
most=$(column arm_turn relaxed/near/stats.csv | sort -n | tail -n 1)
is 'the summary tells the largest turn' "$(column max_arm_turn relaxed/summary.csv)" "$most"
ok "which is moderate ($most degrees)" awk -v x="$most" 'BEGIN { exit !(x > 5 && x < 30) }'
smooth() { # no second difference of the turn is larger than 0.15 degrees (10 degrees a second within a frame)
    column arm_turn "$1" | awk 'NR > 2 && ((d = $1 - 2 * b + a) > 0.15 || d < -0.15) { print NR, a, b, $1; bad = 1 }
                                { a = b; b = $1 } END { exit bad }'
}
ok 'and comes and goes smoothly' smooth relaxed/near/stats.csv

# The turn of a frame belongs to the frame.
same_turns() { # FILE FILE TOLERANCE: at times that both have
    paste -d ' ' "$1" "$2" | awk -v t="$3" '{ d = $1 - $2; if (d > t || d < -t) { print NR, $0; bad = 1 } }
                                            END { exit bad || NR < 9 }'
}
column arm_turn relaxed/near/stats.csv | awk 'NR % 4 == 1' >quarter
dress near.bvh -o step --relax-arms --frames 1::4 --format none
column arm_turn step/near/stats.csv >out
ok 'other frames that are left out do not matter' same_turns quarter out 0
dress near.bvh -o late --relax-arms --frames 33 --format obj
same_last() { column arm_turn late/near/stats.csv >a; column arm_turn relaxed/near/stats.csv | sed -n 33p | diff - a; }
ok 'nor does where one begins' same_last
dress near.bvh -o rate --relax-arms --rate 264 --format none
column arm_turn rate/near/stats.csv | awk 'NR % 16 == 1' >out
ok 'nor a higher rate' same_turns quarter out 0.000001
for motion in half quarter; do
    dress $motion.bvh -o thin --force --relax-arms --format none
    rows=$(sed -n 's/^Frames: //p' $motion.bvh)
    column arm_turn thin/$motion/stats.csv | awk -v n="$rows" '(NR - 1) % (n / 18) == 0' >out
    ok "a motion of $motion the rate: the same turns within half a degree" same_turns quarter out 0.5
done

# Arms that are in the skirt up to a jump, and out of it from there on.
awk '/^Frame Time/ { print; rows = 1; next } !rows { print; next }
    { k++; if (k <= 36) { sub(/ -73\.0000 /, " -90.0000 "); sub(/ 73\.0000 /, " 90.0000 ") } else $3 += 500; print }' \
    "$root/motions/paper-walk.bvh" >jump.bvh
"$KITSUKE" dress -q --no-times --no-body -g "$skirt" jump.bvh -o jump --relax-arms --format none 2>/dev/null
is 'nothing is carried over a jump' "$(column arm_turn jump/jump/stats.csv | sed -n '37,$p' | sort -u)" 0.000000
ok 'and all of it kept up to there' test "$(column arm_turn jump/jump/stats.csv | sed -n 36p | cut -d. -f1)" -gt 4

# Chunks (a motion of more than 18 seconds) and threads.
awk '/^Frames:/ { print "Frames:", 30 * $2; next } /^Frame Time/ { rows = 1; print; next }
    !rows { print; next } { row[n++] = $0 }
    END { for (k = 0; k < 30; k++) for (i = 0; i < n; i++) { $0 = row[i]; $3 = 0; print } }' near.bvh >long.bvh
for j in 1 2; do dress long.bvh near.bvh -o threads$j -j $j --relax-arms --frames ::3 --format none; done
ok 'the same bytes on one thread and on two' diff -r -x .done threads1 threads2
turns() { # every walk of the 30 has the turns of the second
    column arm_turn threads1/long/stats.csv | awk '
        { t[NR] = $1; if (NR > 48 && NR < 690 && $1 != t[NR - 24]) { print NR, $1, t[NR - 24]; bad = 1 } }
        END { exit bad || NR != 720 }'
}
ok 'no step where a chunk begins' turns
cp -r threads1 resumed
rm -r resumed/near
dress long.bvh near.bvh -o resumed --relax-arms --frames ::3 --format none --resume
ok 'and the same after --resume' diff -r -x .done threads1 resumed
dress near.bvh -o resumed2 --format none
dress near.bvh -o resumed2 --format none --relax-arms --resume
is 'a folder without it is dressed anew' "$(column max_arm_turn resumed2/summary.csv)" "$most"

# Real arms.
for motion in cmu_daz_02_03_run.bvh mixamorig_freebvh.bvh bandai2_walk_turn_left_normal_001_NC.bvh; do
    if [ ! -f "$KITSUKE_MOTIONS/$motion" ]; then skip "$motion" 'no real motions here'; continue; fi
    "$KITSUKE" dress -q "$KITSUKE_MOTIONS/$motion" -g "$skirt" -g "$trousers" -g "$root/garments/tshirt.garment" \
        -o real --force --format obj --frames 2::3 --relax-arms
    for g in skirt trousers; do
        ok "$motion: no arm goes through the $g" "$KITSUKE" verify -q --garment "real/${motion%.bvh}/$g.####.obj" \
            --body "real/${motion%.bvh}/body.####.obj" \
            --parts left_upper_arm,left_forearm,left_hand,right_upper_arm,right_forearm,right_hand
    done
done
done_testing
