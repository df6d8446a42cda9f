#!/usr/bin/env bash
# Compares standard and quasi-specular photon mapping at equal time: figure1.sh [SECONDS, default 30] [--convergence].
# Writes docs/figures/figure1.png (with --convergence also convergence.png) and prints the table of errors.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh
cmake --preset release
cmake --build --preset release --target quasilux
# Debian's own Python: another one in the PATH would not see Debian's modules.
/usr/bin/python3 scripts/figure1.py "$@"
