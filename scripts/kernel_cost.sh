#!/usr/bin/env bash
# What compiling only the scene's features saves: kernel_cost.sh [SCENE, default scenes/cornell_phong.xml] [PASSES, 30].
# Renders with the scene's kernels and with generic ones (everything compiled, media too), in turns; prints code size and
# private memory by kernel and seconds by pass. On PoCL the code is what lies in its cache of compiled kernels.
set -euo pipefail
cd "$(dirname "$0")/.."
scene=${1:-scenes/cornell_phong.xml}
passes=${2:-30}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for kind in scene generic; do # once to compile, into a cache of its own
    POCL_CACHE_DIR=$work/cache_$kind build/release/quasilux render "$scene" --kernels $kind --passes 1 --quiet \
        --output "$work/image.exr" --stats "$work/cold_$kind.json"
done
for seed in 1 2 3; do # in turns, so that other load meets both
    for kind in scene generic; do
        POCL_CACHE_DIR=$work/cache_$kind build/release/quasilux render "$scene" --kernels $kind --passes "$passes" \
            --seed $seed --quiet --output "$work/image.exr" --stats "$work/${kind}_$seed.json"
    done
done

python3 - "$work" "$passes" <<'PYTHON'
import json, pathlib, sys
work, passes = pathlib.Path(sys.argv[1]), int(sys.argv[2])
def code(kind, kernel):
    return max((file.stat().st_size for file in work.glob(f"cache_{kind}/**/{kernel}.so")), default=0)
print(f"{'kernel':18}{'code, KiB':>22}{'private, bytes':>22}{'ms a pass':>22}\n"
      f"{'':18}" + f"{'scene':>11}{'generic':>11}" * 3)
total = {"scene": 0.0, "generic": 0.0}
runs = {kind: [json.load(open(work / f"{kind}_{seed}.json"))["kernels"] for seed in (1, 2, 3)] for kind in total}
for kernel in runs["scene"][0]:
    row = f"{kernel:18}"
    row += "".join(f"{code(kind, kernel) / 1024:11.1f}" for kind in total)
    row += "".join(f"{runs[kind][0][kernel]['privateBytes']:11d}" for kind in total)
    for kind in total:
        milliseconds = min(run[kernel]["seconds"] for run in runs[kind]) / passes * 1e3
        total[kind] += milliseconds
        row += f"{milliseconds:11.2f}"
    print(row)
print(f"{'sum':62}" + "".join(f"{total[kind]:11.2f}" for kind in total) + f"   ratio {total['generic'] / total['scene']:.2f}")
cold = {kind: json.load(open(work / f"cold_{kind}.json"))["phases"] for kind in total}
print("cold start to the end of the first pass, s: " +
      ", ".join(f"{kind} {cold[kind]['compile'] + cold[kind]['firstPass']:.2f}" for kind in total))
PYTHON
