#!/usr/bin/env bash
# From Blender to lux: builds a furnished room by Blender's Python API, exports it as glTF, renders it, and holds the illuminance on the floor
# of the same lamps without the room against a closed form of their watts: blender_demo.sh [SECONDS, default 30]. Results go to out/.
# Needs Debian's Blender, which it installs (500 MB).
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-30}

bash scripts/setup.sh --program blender python3-numpy
[[ -x build/release/quasilux ]] || { cmake --preset release && cmake --build --preset release --target quasilux; }
mkdir -p out
export PYTHONDONTWRITEBYTECODE=1
for kind in bare ""; do
    file=out/blender_${kind:-room}.glb
    # shellcheck disable=SC2086 # an empty kind is none
    blender --background --python scripts/blender_room.py -- "$file" $kind >out/blender.log 2>&1
    [[ -s $file ]] || { echo "blender_demo: no $file; see out/blender.log" >&2; exit 1; }
done
build/release/quasilux render out/blender_bare.glb --time "$seconds" --grid out/blender_bare.csv
/usr/bin/python3 scripts/blender_lux.py out/blender_bare.csv
build/release/quasilux render out/blender_room.glb --time "$seconds" -o out/blender_room.exr --png out/blender_room.png
build/release/quasilux render out/blender_room.glb --time "$seconds" --grid out/blender_room.csv
echo
echo "Picture: $PWD/out/blender_room.png"
echo "Table:   $PWD/out/blender_room.csv (lux on the floor)"
