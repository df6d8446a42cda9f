#!/usr/bin/env bash
# Feeds a reader with random files by libFuzzer, under the address and undefined-behaviour sanitizers:
#   fuzz.sh TARGET [SECONDS]    one reader (xml, obj, ply, …: the folders of tests/fuzz/seeds), 60 s if not said
#   fuzz.sh all [SECONDS]       each of them, 10 s each if not said
# What it learns stays in build/fuzz/corpus, findings in build/fuzz/findings; the exit code is 0 if there are none. A finding that is
# mended becomes a seed: fuzz_seeds_test reads them all.
set -euo pipefail
cd "$(dirname "$0")/.."

mapfile -t known < <(ls tests/fuzz/seeds)
if [[ $# -lt 1 || $# -gt 2 || ( $1 != all && ! -d tests/fuzz/seeds/$1 ) ]]; then
    echo "fuzz.sh: expected a target and seconds; targets: all ${known[*]}" >&2
    exit 2
fi
if [[ $1 == all ]]; then
    targets=("${known[@]}")
    seconds=${2:-10}
else
    targets=("$1")
    seconds=${2:-60}
fi

[[ -f build/fuzz/build.ninja ]] || cmake --preset fuzz
cmake --build --preset fuzz --target fuzz_all

# In memory, where there is such a folder: each input is written as a file.
[[ -d /dev/shm && -w /dev/shm ]] && base=/dev/shm || base=${TMPDIR:-/tmp}
folder=$(mktemp -d "$base/quasilux-fuzz-XXXXXX")
trap 'rm -rf "$folder"' EXIT
failed=0
for target in "${targets[@]}"; do
    mkdir -p "build/fuzz/corpus/$target" build/fuzz/findings build/logs
    log=build/logs/fuzz_$target.log
    # Libraries keep memory until the program ends. One allocation may fail: that is an exception.
    if ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1 TMPDIR=$folder \
        "build/fuzz/tests/fuzz/fuzz_$target" "build/fuzz/corpus/$target" "tests/fuzz/seeds/$target" \
        -max_total_time="$seconds" -max_len=8192 -timeout=20 -rss_limit_mb=4096 -malloc_limit_mb=4096 \
        -artifact_prefix="build/fuzz/findings/$target-" -print_final_stats=1 >"$log" 2>&1; then
        printf '%-11s %s executions, nothing found\n' "$target" \
            "$(sed -nE 's/^stat::number_of_executed_units: *//p' "$log")"
    else
        printf '%-11s FOUND: %s (%s)\n' "$target" \
            "$(grep -m1 -E 'ERROR: |runtime error: |terminate called|what\(\)' "$log" || echo 'see the log')" "$log"
        failed=1
    fi
done
exit $failed
