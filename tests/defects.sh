#!/bin/sh
# Odd habits of motion files that show only when a figure is dressed. Each file here is the same walk,
# written as some exporter would; what comes out must be the walk. (Counts, numbers, line ends,
# names, end sites, roots and bounds: tests/unit_bvh.c. A T-pose in front: tests/dress.sh.)
. "$(dirname "$0")/lib.sh"

skirt=$root/garments/skirt.garment
"$KITSUKE" walk --frames-per-step 8 --steps 3 -o walk.bvh || exit 1
dress() { "$KITSUKE" dress -q --no-times --body-detail 8 --detail 2 --topology fixed -g "$skirt" "$@"; }
dress walk.bvh -o plain

# rewrite PROGRAM <walk.bvh: an awk program sees joint j (from 1) with name[j], o[j, 1..3], channels c[j, 1..nc[j]] and,
# in each frame, values v[j, 1..nc[j]]. It may change them in head() and row(), and depth[j] and order stay.
rewrite() {
    awk "$1"'
    BEGIN { CONVFMT = "%.10g" }
    function head_line(j, i) {
        printf "%s %s\n{\n", j == 1 ? "ROOT" : is_end[j] ? "End" : "JOINT", is_end[j] ? "Site" : name[j]
        printf "OFFSET %s %s %s\n", o[j, 1], o[j, 2], o[j, 3]
        if (is_end[j]) return
        printf "CHANNELS %d", nc[j]
        for (i = 1; i <= nc[j]; i++) printf " %s", c[j, i]
        printf "\n"
    }
    $1 == "HIERARCHY" { next }
    $1 == "ROOT" || $1 == "JOINT" { name[++n] = $2; depth[n] = level; next }
    $1 == "End" { is_end[++n] = 1; depth[n] = level; nc[n] = 0; next }
    $1 == "{" { level++; next }
    $1 == "}" { level--; next }
    $1 == "OFFSET" { for (i = 1; i <= 3; i++) o[n, i] = $(i + 1); next }
    $1 == "CHANNELS" { nc[n] = $2; for (i = 1; i <= $2; i++) c[n, i] = $(i + 2); next }
    $1 == "MOTION" {
        for (j = 1; j <= n; j++) given[j] = nc[j]
        head()
        print "HIERARCHY"
        for (j = 1; j <= n; j++) {
            for (k = j == 1 ? 0 : depth[j - 1] + 1; k > depth[j]; k--) print "}"
            head_line(j)
        }
        for (k = depth[n] + 1; k > 0; k--) print "}"
    }
    /^(MOTION|Frame)/ { print; next }
    NF {
        frame++
        for (j = 1; j <= n; j++) for (i = 1; i <= given[j]; i++) v[j, i] = $(++at)
        at = 0
        row()
        for (j = 1; j <= n; j++) for (i = 1; i <= nc[j]; i++) printf "%s ", v[j, i]
        printf "\n"
    }' walk.bvh
}
near() { # near METRES FOLDER [FOLDER]: every vertex is where the same of the second folder (the plain walk) is
    for file in "$2"/*.obj; do
        paste -d ' ' "$file" "${3:-plain/walk}/${file##*/}" | awk -v most="$1" '$1 == "v" {
            for (i = 2; i <= 4; i++) { d = $i - $(i + NF / 2); if (d > most || -d > most) bad++ } n++ }
            END { if (bad || n < 20) { print bad + 0 " numbers of " 3 * n " are off"; exit 1 } }' || return 1
    done
}
is_walk() { # is_walk METRES PROGRAM: rewritten so it is the same walk
    rewrite "$2" >x.bvh
    rm -rf x.d
    dress x.bvh -o x.d && near "$1" x.d/x
}
nothing='function head() {} function row() {}'
ok 'written anew' is_walk 0 "$nothing"

# 18. The knees bend round one axis only, so the order of their channels can change.
ok '18: another rotation order in each joint' is_walk 2e-6 '
    function swap(a, j, t) { t = a[j, 1]; a[j, 1] = a[j, 3]; a[j, 3] = t }
    function head(j) { for (j = 2; j <= n; j++) if (name[j] ~ /^(Left|Right)Leg$/) swap(c, j) }
    function row(j) { for (j = 2; j <= n; j++) if (name[j] ~ /^(Left|Right)Leg$/) swap(v, j) }'

# 19, 20, 22. Six channels for every joint: positions that repeat the OFFSET, that add to it, or that
# stand for it.
six='function head(j, i) { for (j = 2; j <= n; j++) if (!is_end[j]) {
        for (i = nc[j]; i > 0; i--) c[j, i + 3] = c[j, i]
        for (i = 1; i <= 3; i++) { c[j, i] = substr("XYZ", i, 1) "position"; old[j, i] = o[j, i] }
        nc[j] += 3; change(j) } }
    function row(j, i) { for (j = 2; j <= n; j++) if (nc[j] > given[j]) {
        for (i = given[j]; i > 0; i--) v[j, i + 3] = v[j, i]
        for (i = 1; i <= 3; i++) v[j, i] = value(j, i) } }'
ok '19, 20: positions of every joint replace the OFFSET' is_walk 2e-6 "$six"'
    function change(j) {} function value(j, i) { return old[j, i] }'
ok '19, 20: or add to it' is_walk 2e-6 "$six"'
    function change(j) {} function value(j, i) { return 0 }'
ok '22: OFFSETs are zero, all geometry is in the positions' is_walk 5e-6 "$six"'
    function change(j) { o[j, 1] = o[j, 2] = o[j, 3] = 0 } function value(j, i) { return old[j, i] }'

# 23. A joint of zero length in front of every thigh, as the CMU skeletons have them.
rewrite "$nothing" | awk '
    /JOINT (Left|Right)UpLeg/ { print "JOINT " substr($2, 1, length($2) - 5) "HipJoint\n{\nOFFSET 0 0 0\nCHANNELS 0"
        inside = 1 }
    { print } inside && /^{/ { level++ } inside && /^}/ { if (--level == 0) { print "}"; inside = 0 } }' >x.bvh
zero() { rm -rf x.d; dress x.bvh -o x.d && near 0.02 x.d/x; }
ok '23: bones of zero length' zero

# 26. A root that teleports; 31. a knee that flips for one frame.
rewrite 'function head() {} function row() { if (frame >= 12) v[1, 1] += 500 }' >x.bvh
"$KITSUKE" dress x.bvh -g "$skirt" -o jump --no-times 2>err
like '26: a teleport is told' "$(cat err)" 'jumps by up to .* at frame 12'
restarted() { awk -F, '/^#/ { next } !at { for (i = 1; i <= NF; i++) if ($i == "restarted") at = i; next }
    $at == 1 { printf "%s ", $1 }' "$1"; }
is 'and cloth starts afresh there, and only there' "$(restarted jump/x/stats.csv)" '1 12 '
rewrite 'function head() {}
    function row(j) { for (j = 2; j <= n; j++) if (name[j] == "LeftLeg" && frame == 12) v[j, 1] += 170 }' >x.bvh
"$KITSUKE" dress x.bvh -g "$skirt" -o flip --no-times --fps 60 2>err
like '31: a limb that flips is told' "$(cat err)" '(flips|jumps) by up to .* at frames 12 to 13'
count() { find "$1" -name 'skirt.*.obj' | wc -l | tr -d ' '; }
is 'all frames are dressed' "$(count flip)" "$(count plain)"

# 28. Z up: everything is turned round X.
ok '28: Z up' is_walk 2e-6 '
    function turn(a, j, y) { y = a[j, 2]; a[j, 2] = -a[j, 3]; a[j, 3] = y }
    function head(j, i) { for (j = 1; j <= n; j++) { turn(o, j)
        for (i = 1; i <= nc[j]; i++) {
            sign[j, i] = c[j, i] ~ /^Z/ ? -1 : 1
            if (c[j, i] ~ /^Y/) sub(/^Y/, "Z", c[j, i]); else sub(/^Z/, "Y", c[j, i]) } } }
    function row(j, i) { for (j = 1; j <= n; j++) for (i = 1; i <= nc[j]; i++) v[j, i] *= sign[j, i] }'

# 29. Lengths in other units; the walk is in centimetres.
for unit in 'm 0.01' 'in 0.393700787402' 'dm 0.1' 'mm 10'; do
    ok "29: in ${unit% *}" is_walk 2e-5 '
    function head(j, i) { for (j = 1; j <= n; j++) for (i = 1; i <= 3; i++) o[j, i] *= '"${unit#* }"' }
    function row(j, i) { for (j = 1; j <= n; j++) for (i = 1; i <= nc[j]; i++)
        if (c[j, i] ~ /position/) v[j, i] = sprintf("%.9f", v[j, i] * '"${unit#* }"') }'
done

# 30. Angles that go on beyond 180, and jump by a whole turn: the same pose, also between frames.
rewrite 'function head() {} function row(j, i) { for (j = 1; j <= n; j++) for (i = 1; i <= nc[j]; i++)
    if (c[j, i] ~ /rotation/ && (frame + i) % 2) v[j, i] += frame % 3 ? 360 : -360 }' >x.bvh
turns() { rm -rf x.d; dress x.bvh -o x.d && near 2e-6 x.d/x; }
ok '30: whole turns more or less' turns
cp x.bvh y.bvh
cp walk.bvh z.bvh
dress y.bvh z.bvh -o between --rate 77 --no-body
ok '30: also in frames between frames' near 2e-6 between/y between/z

# 32. One frame is a still pose.
awk '/^Frames:/ { $0 = "Frames: 1" } { print } /^Frame Time/ { last = NR + 1 } NR == last { exit }' walk.bvh >x.bvh
still() { rm -rf x.d; dress x.bvh -o x.d && near 2e-6 x.d/x; }
ok '32: a single frame' still

# 24. Rest poses that are none: real files.
for name in rokoko_jesse_dance dfki_custom_skeleton_walk bandai1_bow_normal_001_NC makehuman_sit01; do
    file=$KITSUKE_MOTIONS/$name.bvh
    [ -f "$file" ] || { skip "24: $name" 'no folder of real motions'; continue; }
    ok "24: $name" dress "$file" -o real --frames 1:2
    like '24: a human size' "$("$KITSUKE" inspect "$file" | sed -n 's/^  height *//p')" '^(1\.[3-9]|2\.0)'
done
done_testing
