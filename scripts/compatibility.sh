#!/usr/bin/env bash
# Writes docs/reference/compatibility.md: what the loader says to each plugin and parameter of Mitsuba 3.9.
set -euo pipefail
cd "$(dirname "$0")/.."

cmake --preset release
cmake --build --preset release --target compatibility_test
QUASILUX_WRITE_COMPATIBILITY=1 build/release/tests/compatibility_test --gtest_filter='*ThePage*' --gtest_brief=1
