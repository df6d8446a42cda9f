#!/usr/bin/env bash
# Everyday scenes by quasilux and by Mitsuba 3's path tracer, in turns, each twice for the same time:
# real_scenes.sh [--variant cuda_ad_rgb] [SECONDS, default 30] [SCENE...], of scenes/real/ or of scripts/everyday_scenes.py. Mitsuba comes
# from PyPI, below build/. Prints a table; of all scenes of either it draws docs/figures/real_scenes.png or everyday_scenes.png.
set -euo pipefail
cd "$(dirname "$0")/.."

source scripts/mitsuba.sh
"$folder/bin/python3" scripts/real_scenes.py "$@"
