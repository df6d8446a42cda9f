#!/usr/bin/env bash
# A program that runs for long, and several at once: memory, files and objects of OpenCL of many passes, eight renders on one device, very
# many photons, a scene that does not fit:
#   load.sh [PASSES] [PROGRAM]    20000 passes if not said
# Exit code 0 if all is as docs/reference/reliability.md has it.
set -euo pipefail
cd "$(dirname "$0")/.."
passes=${1:-20000}
program=$(realpath "${2:-build/release/quasilux}")
shim=$(realpath "$(dirname "$program")/tests/libquasilux_failing_calls.so")
scenes=$PWD/scenes
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failed=0

check() { # NAME COMMAND...
    if "${@:2}"; then echo "holds: $1"; else
        echo "FAILS: $1"
        failed=$((failed + 1))
    fi
}
small=("$scenes/cornell_phong.xml" -D resolution=16 --fixed --photons 500 --quiet)

# Memory and files once all has been seen (a third of the time), and at the end.
resident() { awk '/^VmRSS/ { print $2 }' "/proc/$1/status" 2>/dev/null || true; }
"$program" render "${small[@]}" -o long.exr --passes "$passes" --checkpoint long.ckpt --every 5 &
child=$!
memory=() files=()
while kill -0 "$child" 2>/dev/null; do
    now=$(resident "$child") open=$(find "/proc/$child/fd" -mindepth 1 2>/dev/null | wc -l)
    [[ -z $now ]] || { memory+=("$now"); files+=("$open"); }
    sleep 1
done
wait "$child"
count=${#memory[@]}
begin=${memory[count / 3]} end=${memory[count - 2]}
echo "$passes passes in $count s: $begin KiB, at the end $end KiB; files open ${files[count / 3]}, ${files[count - 2]}"
check "memory is flat within 1 %" test $(((end > begin ? end - begin : begin - end) * 100)) -le "$begin"
check "files are (one more while a checkpoint is written)" test "${files[count - 2]}" -le $((files[count / 3] + 1))

# Objects that are made and not given back: as many after a hundred passes as after two thousand.
objects() {
    LD_PRELOAD=$shim QUASILUX_COUNT_CALLS=$PWD/counts "$program" render "${small[@]}" -o few.exr --passes "$1"
    awk '{ n[$1] = $2 } END { print n["clCreateBuffer"], n["clCreateKernel"],
        n["clEnqueueNDRangeKernel"] + n["clRetainEvent"] - n["clReleaseEvent"],
        n["clRetainMemObject"] + n["clCreateBuffer"] - n["clReleaseMemObject"] }' counts
}
few=$(objects 100) many=$(objects 2100)
echo "buffers, kernels, events and buffers that remain: $few after 100 passes, $many after 2100"
check "objects of OpenCL are flat" test "$few" = "$many"

# Eight at once.
"$program" render "${small[@]}" -o one.exr --passes 200
pids=()
for k in 1 2 3 4 5 6 7 8; do
    "$program" render "${small[@]}" -o "of$k.exr" --passes 200 &
    pids+=($!)
done
good=1
for pid in "${pids[@]}"; do wait "$pid" || good=0; done
for k in 1 2 3 4 5 6 7 8; do oiiotool one.exr "of$k.exr" --fail 0 --warn 0 --diff >/dev/null || good=0; done
check "eight renders at once have the bits of one" test $good -eq 1

# What does not fit says so before anything is compiled.
code=0
LD_PRELOAD=$shim QUASILUX_COUNT_CALLS=$PWD/counts "$program" render "${small[@]}" -o none.exr --passes 1 --device-memory 10000 \
    2>message || code=$?
echo "with 10 kB of memory: $(cat message)"
check "what does not fit is refused before anything is compiled" test "$code $(awk '$1 == "clBuildProgram" { print $2 }' counts)" = "2 0"

# As many photons as can be asked for in a pass on this machine.
code=0
/usr/bin/python3 -c 'import resource, subprocess, sys, time
begun = time.time()
code = subprocess.run(sys.argv[1:]).returncode
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
print(f"peak {peak} KiB, {time.time() - begun:.1f} s", file=sys.stderr)
sys.exit(code)' "$program" render "$scenes/cornell_phong.xml" -D resolution=64 --fixed --photons 100000000 --passes 1 \
    -o photons.exr --quiet 2>message || code=$?
echo "1e8 photons a pass: code $code, $(tail -n 2 message | tr '\n' ' ')"
check "1e8 photons a pass are rendered, or refused with what they need" grep -qE 'peak .* KiB|too little' message
exit $((failed > 0))
