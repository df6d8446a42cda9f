#!/usr/bin/env bash
# Runs every kernel under Oclgrind, an OpenCL device that checks each access to memory and finds data races, on images of
# 16 pixels: bash scripts/oclgrind.sh [PROGRAM]. Exit code 0 if nothing is found.
set -euo pipefail
cd "$(dirname "$0")/.."

program=$(realpath "${1:-build/release/quasilux}")
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
failures=0

# What must be found, or silence would mean nothing.
control() {
    local found
    found=$(cd tests/oclgrind && oclgrind-kernel --data-races "$1.sim" 2>&1)
    if [[ $found != *"$2"* ]]; then
        echo "oclgrind: '$2' was not found in tests/oclgrind/$1.sim"
        failures=$((failures + 1))
    fi
}

# Photons walk by eight (kernels/photon_walk.clh), which Oclgrind's device would not have of itself.
# Oclgrind 21.10 does not know a marker that LLVM leaves where it inlines (noalias.scope.decl): so nothing is inlined.
asWritten="-w -cl-opt-disable -Dinline=static -DALWAYS_INLINE=static -DWALK_ANYWHERE"

# check SCENE OPTION...: what Oclgrind finds goes to the log; the program itself must succeed too.
check() {
    local log=$folder/log
    rm -f "$log"
    if ! oclgrind --data-races --check-api --build-options "$asWritten" --log "$log" "$program" render "scenes/$1" --emission plain --passes 1 --photons 48 \
        --work-group-size 4 --quiet -o "$folder/image.exr" "${@:2}" || [[ -s $log ]]; then
        echo "oclgrind: $*"
        [[ ! -e $log ]] || head -n 40 "$log"
        failures=$((failures + 1))
    fi
}

control writes_past_its_buffer "Invalid write"
control race_for_one_word "data race"

small=(-D resolution=4)
check cornell_phong.xml "${small[@]}" --bdd 1 --direct photons --energy-balance
check cornell_ggx.xml "${small[@]}" --map camera
check furnace_textured.xml "${small[@]}" --variant alternative
check furnace_glass.xml "${small[@]}" --kernels generic
check furnace_medium.xml "${small[@]}" -D border=frosted
check slab.xml "${small[@]}" -D sigma_t=1 --map camera --quasi-specular level:0.1

((failures == 0)) && echo "oclgrind: nothing found"
((failures == 0))
