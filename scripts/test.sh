#!/usr/bin/env bash
# Everything that must hold before a change is taken: warnings are errors, layout of the sources, static analysis, tests
# under sanitizers, all tests. Ends with a line "N passed, N failed"; the exit code is 0 if none failed.
set -euo pipefail
cd "$(dirname "$0")/.."

# Tests that need no OpenCL device: they run under the sanitizers too.
hostTests=(loader_test bsdf_loader_test scene_errors_test document_errors_test mesh_errors_test shapes_test borders_test
    border_cuts_test output_test png_test medium_loader_test media_placement_test medium_split_test compare_test
    origin_test)

logs=build/logs
passed=0
failed=0
failures=()

phase() { echo "== $1 (after $SECONDS s)"; }

# check NAME COMMAND...: one check that passes or fails as a whole.
check() {
    phase "$1"
    if "${@:2}"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        failures+=("$1")
    fi
}

# runTests PRESET [OPTION...]: runs CTest and counts its tests; a run that ends without a summary counts as one failure.
runTests() {
    local log=$logs/ctest_$1.log summary
    ctest --preset "$1" "${@:2}" 2>&1 | tee "$log" || true
    summary=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$/\1 \2/p' "$log")
    if [[ -z $summary ]]; then
        failed=$((failed + 1))
        failures+=("tests of preset $1: no summary")
        return
    fi
    failed=$((failed + ${summary% *}))
    mapfile -t -O "${#failures[@]}" failures < <(sed -nE 's/^[[:space:]]+[0-9]+ - (.*)$/\1/p' "$log")
    passed=$((passed + ${summary#* } - ${summary% *}))
}

formatIsRight() {
    find host tests kernels -name '*.cpp' -o -name '*.h' -o -name '*.clh' -o -name '*.cl' |
        sort | xargs clang-format --dry-run -Werror
}

# Sources by the dozen, as preset ci joins them (CMAKE_UNITY_BUILD): most of the time goes into the headers of libraries. By the name of
# UnifiedSource clang's analyzer knows that the sources which such a file includes are no headers. Headers of host/ are checked
# with them (.clang-tidy). GCC's own flags are unknown to clang.
analysisIsClean() {
    local log=$logs/clang-tidy.log commands=build/ci/analysis source
    mkdir -p "$commands"
    sed 's,/Unity/unity_,/Unity/UnifiedSource_,g' build/ci/compile_commands.json >"$commands/compile_commands.json"
    while read -r source; do cp "$source" "${source/unity_/UnifiedSource_}"; done < <(find build/ci/CMakeFiles -name 'unity_*.cxx')
    sed -nE 's,^ *"file": "(.*/(Unity|host)/.*)".*,\1,p' "$commands/compile_commands.json" | sort |
        xargs --max-procs="$(nproc)" --max-args=1 clang-tidy -p "$commands" --quiet --extra-arg=-Wno-unknown-warning-option \
            >"$log" 2>&1 || { grep -v 'warnings\? generated' "$log"; return 1; }
}

bash scripts/setup.sh
mkdir -p "$logs"

phase "build"
cmake --preset ci
cmake --build --preset ci
check "layout of the sources (clang-format)" formatIsRight
check "static analysis (clang-tidy)" analysisIsClean

phase "kernels under Oclgrind"
check "memory and data races of the kernels (Oclgrind)" bash scripts/oclgrind.sh build/ci/quasilux

phase "tests without a device, under the address and undefined-behaviour sanitizers"
cmake --preset asan
cmake --build --preset asan --target "${hostTests[@]}"
# Libraries loaded by OpenImageIO keep memory until the program ends.
ASAN_OPTIONS=detect_leaks=0 runTests asan --tests-regex "^($(IFS='|'; echo "${hostTests[*]}"))\$"

phase "all tests"
runTests ci

((failed == 0)) || printf '== FAILED: %s\n' "${failures[@]}"
echo "$passed passed, $failed failed"
((failed == 0))
