#!/usr/bin/env bash
# The small scenes of tests/scenes/compare/ by quasilux and by Mitsuba 3: compare_mitsuba.sh [SCENE...] [--equal-time SECONDS]
# [--variant cuda_ad_rgb]. Mitsuba comes from PyPI, below build/.
set -euo pipefail
cd "$(dirname "$0")/.."

source scripts/mitsuba.sh
"$folder/bin/python3" scripts/compare_mitsuba.py "$@"
