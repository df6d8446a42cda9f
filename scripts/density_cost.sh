#!/usr/bin/env bash
# What the area correction at borders costs and gains: density_cost.sh [PASSES, default 60].
# Renders the modified Cornell box with the program as it is and with one built from a copy whose kernels are never
# given borders; prints device time by kernel and the errors of both (docs/method/density.md).
set -euo pipefail
cd "$(dirname "$0")/.."
passes=${1:-60}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build() { # NAME
    cmake -S "$work/source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release >"$work/log"
    cmake --build "$work/build" --target quasilux >>"$work/log" || { cat "$work/log"; exit 1; }
    cp "$work/build/quasilux" "$work/$1"
}

mkdir "$work/source"
cp -r CMakeLists.txt cmake host kernels tests "$work/source"
build with
sed -i '/"HAS_BORDERS"/d' "$work/source/host/prepare/features.cpp"
if grep -q HAS_BORDERS "$work/source/host/prepare/features.cpp"; then
    echo "host/prepare/features.cpp names HAS_BORDERS in another way than this script knows" >&2
    exit 1
fi
build without

echo "load before: $(cut -d' ' -f1-3 /proc/loadavg)"
for seed in 1 2; do # in turns, so that other load meets both
    for variant in with without; do
        "$work/$variant" render scenes/cornell_phong.xml --passes "$passes" --seed "$seed" --quiet \
            --output "$work/$variant$seed.exr" --stats "$work/$variant$seed.json"
    done
done
for variant in with without; do
    echo "$variant borders, seconds in traceCameraPaths and tracePhotons:"
    python3 -c 'import json, sys
for path in sys.argv[1:]:
    kernels = json.load(open(path))["kernels"]
    camera, photons = (kernels[name]["seconds"] for name in ("traceCameraPaths", "tracePhotons"))
    print(f"  {camera:.2f} {photons:.2f} ratio {camera / photons:.3f}")' "$work/$variant"{1,2}.json
    /usr/bin/python3 scripts/relmse.py "$work/$variant"1.exr
done
