#!/usr/bin/env bash
# Builds quasilux and renders the modified Cornell box: demo.sh [SECONDS, default 30]. Results go to out/.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-30}

bash scripts/setup.sh --program
cmake --preset release
cmake --build --preset release --target quasilux
mkdir -p out
build/release/quasilux render scenes/cornell_phong.xml --time "$seconds" \
    --output out/cornell_phong.exr --png out/cornell_phong.png --stats out/cornell_phong.json
echo
echo "Picture:    $PWD/out/cornell_phong.png"
echo "Image:      $PWD/out/cornell_phong.exr (all layers)"
echo "Statistics: $PWD/out/cornell_phong.json"
