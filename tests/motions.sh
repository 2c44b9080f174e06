#!/bin/sh
# The whole job on real motions, a few frames of each: who is dressed, who is refused, and that nothing shows
# through where people walk, run, jump and climb. Then what holds on any motion: memory, and every build's bytes.
. "$(dirname "$0")/lib.sh"

g=$root/garments
dress() { "$KITSUKE" dress -q --no-times -g "$g/skirt.garment" -g "$g/trousers.garment" -g "$g/tshirt.garment" "$@"; }
rows() { awk -F, '/^#/ || /^motion,/ { next } { print }' "$1/summary.csv"; }

if [ -d "$KITSUKE_MOTIONS" ]; then
    ok 'one of 26 is no human: exit 3' must_fail 3 dress "$KITSUKE_MOTIONS" -o real --format none --frames 1::90
    is '25 are dressed in all three' "$(rows real | awk -F, '$3 == "ok" && $4 > 0' | wc -l | tr -d ' ')" 75
    is 'one is refused' "$(rows real | awk -F, '$3 != "ok" { print $1, $3, $4 }' | sort -u)" \
        'fairmotion_sinusoidal_noend refused 0'
    like 'and told which roles it lacks' "$(rows real | grep -m 1 noend)" 'missing roles: pelvis, chest, '
    is 'nothing shows through walks, runs, jumps, steps and turns' \
        "$(rows real | awk -F, '/walk|_run|jump|steps|uneven/ && ($5 || $6 || $7 || $8) { print $1, $2 }')" ''
    is 'and there were some' "$(rows real | awk -F, '/walk|_run|jump|steps|uneven/' | wc -l | tr -d ' ')" 39
    # The hand cannot be helped; that must not end the attempts to free the hip.
    ok 'a hand that goes through a hip leaves the hip dressed' "$KITSUKE" dress -q --strict --format none -o hip \
        "$KITSUKE_MOTIONS/cmu_daz_02_03_run.bvh" -g "$root/garments/trousers.garment" --frames 60:96
else
    skip 'real motions' 'no folder with them'
fi

# Many frames cost time, not memory. Address space is what a shell can limit.
"$KITSUKE" walk --steps 140 --frames-per-step 40 -o long.bvh
limited() { (ulimit -v 65536 && dress long.bvh -o long -j 1 --format none --frames ::40); }
if [ "$KITSUKE_BUILD" = san ]; then skip '5,600 frames in 64 MB' 'sanitizers reserve terabytes'
elif (ulimit -v 65536) 2>log; then ok '5,600 frames in 64 MB' limited
else skip '5,600 frames in 64 MB' 'no ulimit -v'; fi

# The builds that are there.
"$KITSUKE" dress -q --no-times "$root/motions/squat.bvh" -g "$root/garments/skirt.garment" \
    -g "$root/garments/trousers.garment" -o this --frames 1:80:20 --format obj,drc
for build in release debug san; do
    other=$root/build/$build/kitsuke
    if [ "$build" = "$KITSUKE_BUILD" ]; then continue
    elif [ ! -x "$other" ] || [ "$("$other" --version)" != "$("$KITSUKE" --version)" ] ||
        [ -n "$(find "$root/src" "$root/include" "$root/garments" -newer "$other" -type f | head -n 1)" ]; then
        skip "the $build build writes the same bytes" 'not built, or older than the source'
    else
        "$other" dress -q --no-times "$root/motions/squat.bvh" -g "$root/garments/skirt.garment" \
            -g "$root/garments/trousers.garment" -o "$build" --frames 1:80:20 --format obj,drc
        ok "the $build build writes the same bytes" diff -r this "$build"
    fi
done
done_testing
