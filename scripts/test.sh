#!/usr/bin/env bash
# Everything that must hold before a change is taken: warnings are errors, layout of the sources, static analysis, tests
# under sanitizers, all tests. `test.sh quick`, for a change in progress, takes minutes: build (preset release; on a fresh
# checkout it installs what is missing and configures first), layout of the sources, all tests but the slow ones, three renders whose mean is known. Ends with a line "N passed, N failed"; the exit code is 0 if none failed.
set -euo pipefail
cd "$(dirname "$0")/.."

# Tests that take more than some five seconds; a new test is quick until it is listed here.
slowTests=(adaptive_radius_test alpha_texture_test area_texture_test auto_test bad_input_test beam_test bench_parts_test bench_test calibration_test camera_map_test caustics_by_paths_test
    checkpoint_command_test checkpoint_test cie171_test cie_sky_test cli_test cloud_render_test compare_command_test cornell_test daylight_test decisive_points_test density_test determinism_test device_workers_test directionalarea_test
    cylindrical_test energy_balance_test envmap_scene_test failures_test faults_test film_parts_test filter_table_test fisheye_test furnace_test gathered_photons_test generic_kernels_test grid_test guide_test habits_test hard_cases_test index_texture_test interrupt_test irradiance_test light_tree_test live_view_test
    lobe_gather_test lobe_sampling_test luminaire_render_test mask_render_test media_border_test medium_render_test memory_test micro_bench_test near_points_test packet_test pass_parts_test photon_search_test photon_walk_test
    principled_thin_test read_faults_test readme_test
    report_test rough_dielectric_render_test rough_dielectric_test shading_normals_test shared_render_test sky_test slab_test texture_render_test traversal_test ugr_table_test
    sunsky_test thin_bodies_test wrong_learning_test)

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

# Builds the site of the documents, with its links; left out where MkDocs cannot be installed, as without a network.
siteIsWhole() {
    local code=0
    bash scripts/docs.sh >$logs/site.log 2>&1 || code=$?
    ((code == 0)) && return
    tail -n 20 $logs/site.log
    ((code == 3)) && echo "site: left out"
}

# Ends the script with the number of checks and tests that failed.
summary() {
    ((failed == 0)) || printf '== FAILED: %s\n' "${failures[@]}"
    echo "$passed passed, $failed failed"
    ((failed == 0))
}

# meanIs IMAGE VALUE: is the mean of R, G and B within 1 % of the value?
meanIs() {
    oiiotool --stats "$1" | awk -v value="$2" '
        /Stats Avg:/ { for (i = 3; i <= 5; ++i) if ($i < 0.99 * value || $i > 1.01 * value) exit 1; found = 1; exit }
        END { exit !found }'
}

# rendersMean SCENE VALUE [OPTION...]: 16 passes from a fixed seed, so the same mean on every run; 10 % off must be noticed.
rendersMean() {
    local image=build/logs/quick.exr
    build/release/quasilux render "scenes/$1.xml" --fixed --passes 16 --quiet --output "$image" "${@:3}" &&
        meanIs "$image" "$2" && ! meanIs "$image" "$(awk "BEGIN { print 1.1 * $2 }")"
}

quickTests() {
    local name
    for name in tests/*_test.cpp; do
        name=$(basename "$name" .cpp)
        [[ " ${slowTests[*]} " == *" $name "* ]] || echo "$name"
    done
}

quick() {
    local targets
    mapfile -t targets < <(quickTests)
    if [[ ! -f build/release/tests/CTestTestfile.cmake ]]; then # not configured, or without the tests' packages (demo.sh)
        phase "setup"
        bash scripts/setup.sh
        cmake --preset release
    fi
    phase "build"
    cmake --build --preset release --target quasilux "${targets[@]}"
    check "layout of the sources (clang-format)" formatIsRight
    phase "quick tests"
    runTests release --tests-regex "^($(IFS='|'; echo "${targets[*]}"))\$"
    check "render: white furnace under a sky, radiance 1" rendersMean furnace_sky 1
    check "render: furnace with a split lobe, radiance 2.5" rendersMean furnace_split 2.5
    check "render: textured furnace, camera points stored, radiance 2.5" rendersMean furnace_textured 2.5 --map camera
    summary
}

mkdir -p "$logs"
case ${1:-all} in
    quick)
        quick
        exit
        ;;
    quick-names)
        quickTests
        exit
        ;;
    all) ;;
    *)
        echo "test.sh: unknown argument '$1', expected nothing, 'quick' or 'quick-names'" >&2
        exit 2
        ;;
esac
bash scripts/setup.sh

phase "build"
cmake --preset ci
cmake --build --preset ci
check "layout of the sources (clang-format)" formatIsRight
check "static analysis (clang-tidy)" /usr/bin/python3 scripts/static_analysis.py build/ci
check "types of the Python package (mypy)" /usr/bin/python3 -m mypy
check "site of the documents (MkDocs)" siteIsWhole

phase "kernels under Oclgrind"
check "memory and data races of the kernels (Oclgrind)" bash scripts/oclgrind.sh build/ci/quasilux

phase "tests without a device, under the address and undefined-behaviour sanitizers"
cmake --preset asan
cmake --build --preset asan --target host_tests
# Libraries loaded by OpenImageIO keep memory until the program ends. An allocation that is too large is to be an exception.
ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 runTests asan --label-regex '^host$'

phase "all tests"
runTests ci

summary
