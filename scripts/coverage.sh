#!/usr/bin/env bash
# What tests reach, by lines and branches of host/ and by functions and blocks of kernels/: coverage.sh [TEST...], by default the quick tests. In a
# build of its own, build/coverage; the report goes to stdout and build/coverage/coverage.md. Needs gcovr (Debian: gcovr) and a device that
# runs in the program's memory, such as PoCL on a CPU. What is measured: docs/notes/coverage.md.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v gcovr >/dev/null || { echo "coverage.sh: no gcovr; on Debian: apt-get install gcovr" >&2; exit 1; }
mapfile -t tests < <(if (($#)); then printf '%s\n' "$@"; else bash scripts/test.sh quick-names; fi)
folder=build/coverage/counted
mkdir -p "$folder"
/usr/bin/python3 scripts/coverage.py instrument "$folder/kernels"
cmake --preset coverage
cmake --build --preset coverage --target quasilux "${tests[@]}"
find build/coverage -name '*.gcda' -delete
ctest --preset coverage --tests-regex "^($(IFS='|'; echo "${tests[*]}"))\$" || echo "coverage.sh: some tests failed; what they reached counts all the same" >&2
gcovr --root . --filter host/ --object-directory build/coverage --exclude-throw-branches --exclude-unreachable-branches --json build/coverage/host.json build/coverage
/usr/bin/python3 scripts/coverage.py report "$folder" build/coverage/host.json | tee build/coverage/coverage.md
