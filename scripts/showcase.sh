#!/usr/bin/env bash
# The scenes of scenes/showcase/: a furnished room, an object under an environment map, smoke with a caustic. Makes their meshes, textures and
# volumes in out/showcase/, renders each and writes docs/figures/showcase_*.png: showcase.sh [SECONDS, default 120] [SCENE...].
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh
cmake --preset release
cmake --build --preset release --target quasilux
seconds=${1:-120}
scenes=("${@:2}")
[[ ${#scenes[@]} -gt 0 ]] || scenes=(room studio smoke)
# Debian's own Python: another one in the PATH would not see Debian's modules.
/usr/bin/python3 scripts/showcase/assets.py out/showcase
for scene in "${scenes[@]}"; do
    build/release/quasilux render "scenes/showcase/$scene.xml" --time "$seconds" -o "out/showcase/$scene.exr" --png "docs/figures/showcase_$scene.png"
done
