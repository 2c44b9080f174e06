#!/bin/sh
# Where the joints are, against a reader that shares no code with the program (tests/fk.py): made-up skeletons with
# every habit that the formats allow, then all real files.
. "$(dirname "$0")/lib.sh"

command -v python3 >log || skip_all 'no python3'
fk() { python3 "$root/tests/fk.py" "$@"; }
check() { # check FILE replace|add [ASF]
    "$KITSUKE" inspect --joints "$1" --position "$2" >joints.csv || return
    # shellcheck disable=SC2086  # none or one word
    fk check "$1" ${3:-} "$2" <joints.csv
}
for seed in 1 2 3 4 5 6 7 8; do
    fk make bvh "$seed" odd
    for rule in replace add; do ok "odd skeleton $seed, positions $rule" check odd.bvh "$rule"; done
done
for seed in 1 2 3 4; do
    fk make acclaim "$seed" pair
    ok "odd Acclaim pair $seed" check pair.amc replace pair.asf
done
sed '$s/[0-9]*$/999/' joints.csv >wrong.csv
ok 'a wrong place is seen' must_fail 1 sh -c "python3 '$root/tests/fk.py' check pair.amc pair.asf <wrong.csv"

# Real files; of these three the README that lies beside them says that positions are deltas.
[ -d "$KITSUKE_MOTIONS" ] || { skip 'real motions' 'no folder with them'; done_testing; }
for file in "$KITSUKE_MOTIONS"/*.bvh; do
    case $file in */dfki_* | */makehuman_*) rule=add ;; *) rule=replace ;; esac
    ok "${file##*/}" check "$file" "$rule"
    "$KITSUKE" inspect "$file" >out 2>err
    like 'and the rule is found' "$(cat out)" "^  positions .* $rule"
done
for number in 02_03_run 11_01_kick; do
    ok "cmu_$number.amc" check "$KITSUKE_MOTIONS/cmu_$number.amc" replace \
        "$KITSUKE_MOTIONS/cmu_${number%%_*}.asf"
done
done_testing
