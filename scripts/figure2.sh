#!/usr/bin/env bash
# Compares ways to split a turbid plate's phase function at equal time: figure2.sh [SECONDS, default 60].
# Writes docs/figures/figure2.png and the table docs/notes/figure2.md, and prints the table.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh
cmake --preset release
cmake --build --preset release --target quasilux
# Debian's own Python: another one in the PATH would not see Debian's modules.
/usr/bin/python3 scripts/figure2.py "$@"
