#!/usr/bin/env bash
# Runs the tests that need an OpenCL device on another runtime alone and prints a table: runtime_tests.sh intel|rusticl [REGEX of tests].
# Without REGEX: the tests of single kernels (tests/kernels), which no renderer is needed for.
set -euo pipefail
cd "$(dirname "$0")/.."

runtime=${1:?intel or rusticl}
case $runtime in
    intel) environment=$(bash scripts/intel_runtime.sh); eval "$environment"; find build/intel-opencl/vendors -name '*.icd' ! -name intel.icd -delete ;;
    rusticl) environment=$(bash scripts/rusticl_runtime.sh); eval "$environment" ;;
    *) echo "runtime_tests: '$runtime' is no runtime, expected intel or rusticl" >&2; exit 2 ;;
esac
build/release/quasilux devices

mapfile -t tests < <(
    if [[ -n ${2:-} ]]; then ctest --test-dir build/release -N -R "$2" | sed -nE 's/^ +Test +#[0-9]+: //p'
    else grep -l 'testProgram(' tests/*.cpp | sed -E 's,tests/(.*)\.cpp,\1,'; fi)
limit=${LIMIT:-120} # seconds of a test
echo "| test | passed | failed | |"
echo "|---|---|---|---|"
for test in "${tests[@]}"; do
    log=build/logs/${runtime}_$test.log
    mkdir -p build/logs
    code=0
    timeout "$limit" "build/release/tests/$test" >"$log" 2>&1 || code=$?
    passed=$(grep -ac '^\[       OK' "$log" || true) failed=$(grep -ac '^\[  FAILED  \].*ms)' "$log" || true)
    case $code in
        0 | 1) why="" ;;
        124) why="not done after $limit s" ;;
        139) why="the driver crashes" ;;
        *) why="ends with code $code" ;;
    esac
    echo "| \`$test\` | $passed | $failed | $why |"
done
