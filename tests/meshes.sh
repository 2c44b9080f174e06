#!/bin/sh
# The written meshes, by verify and by arithmetic of our own: whole but for the garment's openings, and lit
# from outside in every fold of a squat and a turn.
. "$(dirname "$0")/lib.sh"

# dark FILE...: what is wrong in OBJ files, in all of them together
dark() {
    awk 'FNR == 1 { v = n = 0; delete seen }
    $1 == "v" { v++; for (k = 1; k < 4; k++) p[v, k] = $(k + 1) }
    $1 == "vn" { n++; for (k = 1; k < 4; k++) q[n, k] = $(k + 1); long = sqrt($2 * $2 + $3 * $3 + $4 * $4)
        if (long < 0.9999 || long > 1.0001) print FILENAME ": a normal is not unit" }
    $1 == "f" {
        for (k = 1; k < 4; k++) { split($(k + 1), c, "/"); t[k] = c[1]; m[k] = c[3]
            if (c[1] < 1 || c[1] > v || (c[2] != "" && c[2] != c[1]) || c[3] < 1 || c[3] > n)
                print FILENAME ": no corner: " $0 }
        low = t[1] < t[2] ? t[1] : t[2]; if (t[3] < low) low = t[3]
        high = t[1] > t[2] ? t[1] : t[2]; if (t[3] > high) high = t[3]
        if (seen[low, t[1] + t[2] + t[3] - low - high, high]++) print FILENAME ": twice: " $0
        for (k = 1; k < 4; k++) { a[k] = p[t[2], k] - p[t[1], k]; b[k] = p[t[3], k] - p[t[1], k] }
        x = a[2] * b[3] - a[3] * b[2]; y = a[3] * b[1] - a[1] * b[3]; z = a[1] * b[2] - a[2] * b[1]
        if (x * x + y * y + z * z == 0) print FILENAME ": no area: " $0
        for (k = 1; k < 4; k++)
            if (x * q[m[k], 1] + y * q[m[k], 2] + z * q[m[k], 3] <= 0) print FILENAME ": away from: " $0 }' "$@"
}
# creases FILE...: how many corners have a normal of their own
creases() {
    awk '$1 == "f" { for (k = 2; k < 5; k++) { split($k, c, "/"); own += c[1] != c[3] } } END { print own + 0 }' "$@"
}
# by_garment NAME: a column of verify's table, garment by garment, each value once
by_garment() {
    awk -F, -v name="$1" '/^#/ { next } !at { while ($++at != name); while ($++by != "garment"); next }
        !seen[$by, $at]++ { print $by ":" $at }' told | sort | tr '\n' ' '
}

# What finds nothing must be able to find something.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nvn 0 0 1\nf 1/1/1 2/2/2 3/3/2\n' >planted.obj
is 'a normal that looks away is found' "$(dark planted.obj)" 'planted.obj: away from: f 1/1/1 2/2/2 3/3/2'
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n' >planted.obj
is 'and a triangle without area' "$(dark planted.obj | head -1)" 'planted.obj: no area: f 1/1/1 2/2/1 3/3/1'

garments=$root/garments
for topology in adaptive fixed; do
    for preset in squat turn; do
        out=$preset-$topology
        "$KITSUKE" walk --preset $preset -o $preset.bvh
        ok "$preset, $topology" "$KITSUKE" dress $preset.bvh -o $out --format obj --topology $topology -q \
            --frames 10::40 -g "$garments/skirt.garment" -g "$garments/trousers.garment" \
            -g "$garments/paper-skirt.garment" -g "$garments/tshirt.garment"
        "$KITSUKE" verify $out >told 2>/dev/null
        is 'no cracks' "$(by_garment cracks)" 'paper-skirt:0 skirt:0 trousers:0 tshirt:0 '
        is 'as many openings as the garments have' "$(by_garment borders)" 'paper-skirt:2 skirt:2 trousers:3 tshirt:4 '
    done
    is "faces of $topology are whole, have an area, and normals on their side" \
        "$(dark squat-$topology/squat/[pst]*.0050.obj | head -3)" ''
done
like 'in folds corners have normals of their own' "$(creases squat-fixed/squat/[pst]*.obj)" '^[1-9]'

"$KITSUKE" dress turn.bvh -o flesh --format obj -q --frames 161:241:4 -g "$garments/skirt.garment"
is 'bodies are whole too where their parts press on each other' "$(dark flesh/turn/body.*.obj | head -3)" ''
like 'and some of their corners have normals of their own' "$(creases flesh/turn/body.*.obj)" '^[1-9]'

# A vest, as garments/README.md tells of armholes and straps: two armholes, a neckline and a hem.
cat >vest.garment <<END
garment vest
ring hem   pelvis 0.35 ease 0.025
ring waist spine  0.40 ease 0.018
ring chest chest  0.38 ease 0.015
ring left_yoke_front chest 0.70 ease 0.012
ring left_yoke_back  chest 0.70 ease 0.012
ring left_strap      chest 1.00 size 0.030 0.001 0.001 shift 0.105 0.022 0
move left_yoke_front.left  -0.035 0 0.04
move left_yoke_front.front  0.060 0.02 -0.02
move left_yoke_back.left   -0.035 0 -0.05
move left_yoke_back.back    0.060 0.02 0.01
panel left_front
  row hem left front
  row waist left front
  row chest left front
  row left_yoke_front left front
  row left_strap left front right
panel left_back
  row hem left back
  row waist left back
  row chest left back
  row left_yoke_back left back
  row left_strap left front right
seam left_front.bottom left_back.bottom
collide left_front pelvis spine chest neck left_upper_arm
collide left_back  pelvis spine chest neck left_upper_arm
mirror left_ right_
END
ok 'a vest' "$KITSUKE" dress squat.bvh -o vest --format obj -q --strict --frames 10::40 -g vest.garment
"$KITSUKE" verify vest >told 2>/dev/null
is 'with all its openings' "$(by_garment borders)" 'vest:4 '
is 'and no other' "$(by_garment cracks)" 'vest:0 '

# Shorts that say nothing of how cloth lies in the fold of a hip.
cat >shorts.garment <<END
garment shorts
detail 4
ring waist       pelvis     1.30 ease 0.008
ring hip         pelvis     0.50 ease 0.020
ring left_crotch left_thigh 0.30 ease 0.020
ring left_hem    left_thigh 0.62 ease 0.025
panel left_front
  row waist       left front
  row hip         left front
  row left_crotch left front right
  row left_hem    left front right
panel left_back
  row waist       left back
  row hip         left back
  row left_crotch left back right
  row left_hem    left back right
seam left_front.start left_back.start
collide waist..left_crotch    spine pelvis left_thigh right_thigh
collide left_crotch..left_hem pelvis left_thigh left_shin
mirror left_ right_
join left_crotch.right right_crotch.left
pin waist
END
ok 'shorts without bindings' "$KITSUKE" dress squat.bvh -o shorts --format none -q --strict --frames ::20 \
    -g shorts.garment
done_testing
