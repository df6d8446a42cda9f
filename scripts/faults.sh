#!/usr/bin/env bash
# Makes each call of OpenCL, of a file and of operator new fail in turn, in a small render (tests/faults_test.cpp):
#   faults.sh [CALLS]    so many calls of each function, spread evenly, or `all` (hours); 50 if not said
set -euo pipefail
cd "$(dirname "$0")/.."
[[ -f build/release/build.ninja ]] || cmake --preset release
cmake --build --preset release --target faults_test
QUASILUX_FAULTS=${1:-50} build/release/tests/faults_test
