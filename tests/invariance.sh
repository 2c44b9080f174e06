#!/bin/sh
# What must not matter: where on earth someone walks, which way, from which file axes, on which side of
# a mirror, in which order the joints stand. And what must be borne: poses at the end of what a human
# can do. (Units, channels, names and other habits of files: tests/defects.sh.)
. "$(dirname "$0")/lib.sh"

"$KITSUKE" walk --frames-per-step 6 --steps 2 -o walk.bvh || exit 1
g=$root/garments
dress() {
    "$KITSUKE" dress -q --no-times --format obj --topology fixed --detail 4 \
        -g "$g/skirt.garment" -g "$g/trousers.garment" -g "$g/tshirt.garment" "$@"
}
dress walk.bvh -o plain

# Awk: `root` moves the root of each frame (v[1..3] its place in cm, v[4] its turn about y).
move() {
    awk "$1"' BEGIN { CONVFMT = OFMT = "%.12g" } /^Frame Time/ { rows = 1; print; next } !rows || !NF { print; next }
        { for (i = 1; i <= 4; i++) v[i] = $i; root(); for (i = 1; i <= 4; i++) $i = v[i]; print }' walk.bvh >x.bvh
}
# is_moved METRES PROGRAM: back() takes a point p[1..3] of the moved meshes to its place in the plain ones.
is_moved() {
    rm -rf x.d
    dress x.bvh -o x.d
    for file in plain/walk/*.obj; do
        paste -d ' ' "x.d/x/${file##*/}" "$file" | awk -v most="$1" "$2"' $1 == "v" {
            for (i = 1; i <= 3; i++) p[i] = $(i + 1)
            back()
            for (i = 1; i <= 3; i++) { d = p[i] - $(i + NF / 2 + 1); if (d > most || -d > most) bad++ }
            n++ }
            END { if (bad || n < 100) { print bad + 0 " numbers of " 3 * n " are off"; exit 1 } }' || return 1
    done
}
move 'function root() { v[1] += 1000000; v[2] += 300; v[3] -= 250000 }'
# There the last digit of a place decides which tangent plane a fold of the skin is measured by.
ok 'ten kilometres away' is_moved 5e-5 'function back() { p[1] -= 10000; p[2] -= 3; p[3] += 2500 }'
move 'function root(x) { v[4] += 90; x = v[1]; v[1] = v[3]; v[3] = -x }'
ok 'a quarter turn' is_moved 2e-6 'function back(x) { x = p[1]; p[1] = -p[3]; p[3] = x }'
move 'function root(x) { v[4] += 37; x = v[1]; c = cos(a = 37 * atan2(0, -1) / 180); s = sin(a)
    v[1] = c * x + s * v[3]; v[3] = c * v[3] - s * x }'
ok 'another turn: decisions do not hang on the last digit' is_moved 1e-5 'function back(x) {
    c = cos(a = 37 * atan2(0, -1) / 180); s = sin(a)
    x = p[1]; p[1] = c * x - s * p[3]; p[3] = s * x + c * p[3] }'

# Half the size, measured in half the unit: garments are the same. Bodies are not, since a small one has a larger head.
dress walk.bvh --scale 0.5 --unit cm --output-unit 0.5 --no-body -o half
halved() {
    for file in half/walk/*.obj; do
        grep -v '^#' "$file" >half.obj
        grep -v '^#' "plain/walk/${file##*/}" | cmp -s - half.obj || { echo "$file"; return 1; }
    done
}
ok 'a figure of half the size: every length of the method is measured by the height' halved

# Axes renamed in a circle: what was y is z, then x. The figure's heading in the output is its own.
around() {
    awk '$1 == "OFFSET" { x = $2; y = $3; $2 = $4; $3 = x; $4 = y } $1 == "CHANNELS" {
        for (i = 3; i <= NF; i++) $i = substr("YZX", index("XYZ", substr($i, 1, 1)), 1) substr($i, 2) } { print }' "$1"
}
around walk.bvh >z_up.bvh
around z_up.bvh >x_up.bvh
tall() {
    awk '$1 == "v" { if ($3 > most) most = $3; if ($3 < least || !n++) least = $3 }
        END { printf "%.3f", most - least }' "$1"
}
for up in z x; do
    like "$up up is seen" "$("$KITSUKE" inspect ${up}_up.bvh)" "^  up +$up$"
    dress ${up}_up.bvh -o up --frames 3
    for mesh in body skirt tshirt; do
        is "$up up: $mesh as tall" "$(tall up/${up}_up/$mesh.0003.obj)" "$(tall plain/walk/$mesh.0003.obj)"
    done
done

# A mirror: left and right change names, x its sign. Patches have a way to run, so pushes may differ a little;
# global shapes may not.
awk '/JOINT/ { if (/Left/) sub(/Left/, "Right"); else sub(/Right/, "Left") }
    $1 == "OFFSET" { $2 = -$2 }
    $1 == "CHANNELS" { for (i = 3; i <= NF; i++) sign[++n] = $i ~ /Xpos|[YZ]rot/ ? -1 : 1 }
    /^Frame Time/ { rows = 1; print; next }
    rows { for (i = 1; i <= NF; i++) $i *= sign[i] } { print }' walk.bvh >mirror.bvh
dress walk.bvh mirror.bvh -o mirrors --frames 1:12:4 --method global
sides() { # the box of a mesh, its x as it is or mirrored
    awk -v sign="$2" '$1 == "v" { $2 *= sign; for (i = 2; i <= 4; i++) {
        if (!n || $i < low[i]) low[i] = $i; if (!n || $i > high[i]) high[i] = $i } n++ }
        END { for (i = 2; i <= 4; i++) printf "%.4f %.4f ", low[i] + 5e-6, high[i] + 5e-6 }' "$1"
}
mirrored() {
    for file in mirrors/walk/*.obj; do
        awk -v a="$(sides "$file" 1)" -v b="$(sides "mirrors/mirror/${file##*/}" -1)" 'BEGIN {
            split(a, p, " "); n = split(b, q, " ")
            for (i = 1; i <= n; i++) { d = p[i] - q[i]; if (d > 2e-4 || -d > 2e-4) { print a; print b; exit 1 } } }' ||
            return 1
    done
}
ok 'a mirrored walk is mirrored' mirrored

# Single frames. A pose is a list of JOINT.AXIS=DEGREES on the walker, whose arms are stretched out sidewards at rest.
pose() {
    name=$1
    shift
    awk -v list="$*" 'BEGIN { n = split(list, part, " ")
            for (i = 1; i <= n; i++) { split(part[i], w, "="); angle[w[1]] = w[2] } }
        $1 == "ROOT" || $1 == "JOINT" { joint = $2 }
        $1 == "CHANNELS" { for (i = 3; i <= NF; i++) what[++columns] = joint "." substr($i, 1, 1) substr($i, 2, 1) }
        /^Frames:/ { $0 = "Frames: 1" }
        { print }
        /^Frame Time/ { for (i = 1; i <= columns; i++) {
                key = what[i]
                if (key ~ /r$/) printf "%s ", angle[substr(key, 1, length(key) - 1)] + 0
                else printf "%s ", key == "Hips.Yp" ? 90 : 0
            } print ""; exit }' walk.bvh >"$name.bvh"
}
columns() { # columns FILE NAME...: their sums
    file=$1
    shift
    awk -F, -v names="$*" '/^#/ { next } !at { n = split(names, name, " ")
            for (i = 1; i <= NF; i++) for (k = 1; k <= n; k++) if ($i == name[k]) use[i] = 1; at = 1; next }
        { for (i in use) sum += $i } END { print sum + 0 }' "$file"
}
sound() { # numbers are numbers, no edge is as long as a thigh, nothing is far from the body
    for mesh in skirt trousers tshirt; do
        awk '/nan|inf/ { print; exit 1 }
            $1 == "v" { n++; for (i = 1; i <= 3; i++) p[n, i] = $(i + 1); next }
            $1 == "f" { for (k = 2; k <= 4; k++) { split($k, a, "/"); split($(k == 4 ? 2 : k + 1), b, "/"); d = 0
                    for (i = 1; i <= 3; i++) d += (p[a[1], i] - p[b[1], i]) ^ 2
                    if (d > 0.15) { print "an edge of " sqrt(d) " m"; exit 1 } } }
            END { if (n < 100) exit 1 }' "poses/$1/$mesh.0001.obj" || { echo "in $1/$mesh"; return 1; }
    done
}
hang='LeftArm.Z=-70 RightArm.Z=70'
both() { printf 'Left%s=%s Right%s=%s ' "$1" "$2" "$1" "$2"; } # both JOINT.AXIS DEGREES
pose tpose
pose hang "$hang"
pose arms_up LeftArm.Z=80 RightArm.Z=-80
pose arms_front LeftArm.Y=-85 RightArm.Y=85
pose arms_behind "$hang" "$(both Arm.X 30)" LeftForeArm.Y=70 RightForeArm.Y=-70
pose bow "$hang" Spine.X=50 Spine1.X=20
pose twist "$hang" Spine.Y=40 Spine1.Y=20
pose sit "$hang" "$(both UpLeg.X -90)" "$(both Leg.X 90)"
pose long_sit "$hang" "$(both UpLeg.X -95)" Spine.X=15 Hips.Yp=12
pose step "$hang" LeftUpLeg.X=-50 LeftLeg.X=40 RightUpLeg.X=20
pose squat "$hang" "$(both UpLeg.X -115)" LeftUpLeg.Z=12 RightUpLeg.Z=-12 "$(both Leg.X 130)" Spine.X=20
pose side_split "$hang" LeftUpLeg.Z=80 RightUpLeg.Z=-80
pose front_split "$hang" LeftUpLeg.X=-80 RightUpLeg.X=70
pose high_kick "$hang" LeftUpLeg.X=-120
pose heel "$hang" LeftUpLeg.X=10 LeftLeg.X=140
pose lie "$hang" Hips.X=-90 Hips.Yp=12
pose handstand LeftArm.Z=85 RightArm.Z=-85 Hips.X=180 Hips.Yp=80
pose ball "$hang" Spine.X=40 Spine1.X=30 "$(both UpLeg.X -130)" "$(both Leg.X 140)"
mkdir poses.in
mv tpose.bvh hang.bvh arms_*.bvh bow.bvh twist.bvh ./*sit.bvh step.bvh squat.bvh ./*split.bvh high_kick.bvh heel.bvh \
    lie.bvh handstand.bvh ball.bvh poses.in
dress poses.in -o poses
"$KITSUKE" inspect poses.in/*.bvh >told
is 'up is up in all of them' "$(grep '^  up' told | uniq -c | tr -s ' ')" ' 18 up y'
like 'and doubt is told' "$(sed -n '/handstand.bvh/,/^$/p' told)" 'up axis is not certain: taken for y; --up tells it'
for file in poses.in/*.bvh; do
    name=$(basename "$file" .bvh)
    ok "$name: sound meshes" sound "$name"
done
for name in tpose hang arms_up arms_front arms_behind bow twist sit long_sit step side_split lie handstand; do
    is "$name: nothing shows through" \
        "$(columns "poses/$name/stats.csv" residual_edges residual_cloth inside)" 0
done
is 'who sits, stretches or bends keeps left and right' "$("$KITSUKE" inspect poses.in/*.bvh 2>&1 | grep swapped)" ''

done_testing
