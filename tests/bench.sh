#!/bin/sh
# Where the time of a frame goes: dresses the shipped walk in each garment some times, without
# writing meshes, and prints for each stage the mean over the frames of the fastest time that a
# frame took in any of the runs. Counters, which are exact, stand before seconds, which are not.
#   bench.sh [RUNS]
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
KITSUKE=${KITSUKE:-$root/build/kitsuke}
runs=${1:-10}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sed -n 's/^model name[^:]*: */# /p' /proc/cpuinfo 2>/dev/null | head -n 1
echo "# $("$KITSUKE" --version), fastest of $runs runs, milliseconds a frame"
echo 'garment,frames,mean_nodes,mean_pairs_tested,pose_ms,global_ms,test_ms,push_ms,mesh_ms,total_ms,worst_ms'
for garment in "$root"/garments/*.garment; do
    for run in $(seq "$runs"); do
        "$KITSUKE" dress "$root/motions/paper-walk.bvh" --garment "$garment" --format none --quiet --output "$work/$run"
    done
    awk -F, -v garment="$(basename "$garment" .garment)" '
        /^#/ { next }
        $1 == "frame" { for (i = 1; i <= NF; i++) column[$i] = i; next }
        {
            f = $1
            if (!(f in nodes)) { frames++; nodes[f] = $column["nodes"]; pairs[f] = $column["pairs_tested"] }
            split("pose_s global_s test_s push_s mesh_s", stage, " ")
            for (k = 1; k <= 5; k++) {
                s = 1000 * $column[stage[k]]
                if (!((f, k) in best) || s < best[f, k]) best[f, k] = s
            }
        }
        END {
            for (f in nodes) {
                n += nodes[f]; p += pairs[f]; total = 0
                for (k = 1; k <= 5; k++) { sum[k] += best[f, k]; total += best[f, k] }
                all += total
                if (total > worst) worst = total
            }
            printf "%s,%d,%.1f,%.0f", garment, frames, n / frames, p / frames
            for (k = 1; k <= 5; k++) printf ",%.3f", sum[k] / frames
            printf ",%.3f,%.3f\n", all / frames, worst
        }' "$work"/*/paper-walk/stats.csv
    rm -rf "${work:?}"/*
done
