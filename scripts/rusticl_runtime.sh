#!/usr/bin/env bash
# Puts Mesa's rusticl on llvmpipe, a strict OpenCL driver whose compiler works as those of GPUs do, below build/ and prints the environment
# in which it is the only OpenCL device:
#     eval "$(bash scripts/rusticl_runtime.sh)"
# Debian's package is unpacked, not installed: installed, it would be a device of every program.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$PWD/build/rusticl
libraries=$folder/root/usr/lib/x86_64-linux-gnu
library=$libraries/libRusticlOpenCL.so.1.0.0

if [[ ! -e $library ]]; then
    mkdir -p "$folder"
    run=()
    ((EUID == 0)) || run=(sudo)
    "${run[@]}" apt-get install -y --no-install-recommends libclc-15 libllvmspirvlib15 libclang-cpp15 >&2
    (cd "$folder" && apt-get download mesa-opencl-icd >&2 && dpkg -x mesa-opencl-icd_*.deb root)
fi
[[ -e $library ]] || { echo "rusticl_runtime: Debian's mesa-opencl-icd holds no $library" >&2; exit 1; }

mkdir -p "$folder/vendors"
echo "$library" >"$folder/vendors/rusticl.icd"
echo "export OCL_ICD_VENDORS='$folder/vendors'"
echo "export LD_LIBRARY_PATH='$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}'"
echo "export RUSTICL_ENABLE=llvmpipe"
