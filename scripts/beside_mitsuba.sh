#!/usr/bin/env bash
# The turbid plate by quasilux and by Mitsuba 3's volumetric path tracer, side by side in equal time:
# beside_mitsuba.sh [SECONDS, default 60]. Mitsuba comes from PyPI, below build/. Prints a table.
set -euo pipefail
cd "$(dirname "$0")/.."

source scripts/mitsuba.sh
"$folder/bin/python3" scripts/beside_mitsuba.py "$@"
