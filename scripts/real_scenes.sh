#!/usr/bin/env bash
# Everyday scenes by quasilux and by Mitsuba 3's path tracer, in turns, each twice for the same time:
# real_scenes.sh [SECONDS, default 30] [SCENE...]. Mitsuba comes from PyPI, below build/. Prints a table; pictures go to docs/figures/real/.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh
cmake --preset release
cmake --build --preset release --target quasilux

folder=$PWD/build/mitsuba
if [[ ! -x $folder/bin/pip ]]; then # a folder without it was left half made
    # Debian's own Python, whose modules read the images.
    /usr/bin/python3 -m venv --system-site-packages "$folder" || {
        echo "real_scenes: /usr/bin/python3 -m venv failed; on Debian install python3-venv" >&2
        exit 1
    }
fi
"$folder/bin/pip" install --quiet --disable-pip-version-check mitsuba
"$folder/bin/python3" scripts/real_scenes.py "$@"
