#!/usr/bin/env bash
# Installs the Python package as its users do, by pip into an environment of its own below build/, and runs its tests there, with the program that
# came along. Takes minutes, as all is compiled anew. CI tests the same package from the build folder (tests/CMakeLists.txt).
set -euo pipefail
cd "$(dirname "$0")/.."
bash scripts/setup.sh python3-venv

environment=build/python_environment
rm -rf "$environment"
/usr/bin/python3 -m venv --system-site-packages "$environment"
CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)} "$environment/bin/pip" install .
"$environment/bin/quasilux" --version
for kind in render scene load_dict guide; do
    "$environment/bin/python" "tests/python/${kind}_test.py" "$environment/bin/quasilux" "$PWD"
done
