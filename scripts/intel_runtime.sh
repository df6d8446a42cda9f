#!/usr/bin/env bash
# Installs Intel's OpenCL runtime for CPUs from PyPI below build/, as a second OpenCL device, and prints the
# environment that makes it visible beside the devices that are there already:
#     eval "$(bash scripts/intel_runtime.sh)"
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$PWD/build/intel-opencl
library=$folder/lib/libintelocl.so

if [[ ! -e $library ]]; then
    python3 -m venv "$folder" >&2 || {
        echo "intel_runtime: python3 -m venv failed; on Debian install python3-venv" >&2
        exit 1
    }
    # The first package does not name the second one, which holds Intel's mathematics libraries, among its needs.
    "$folder/bin/pip" install --quiet --disable-pip-version-check intel-opencl-rt intel-cmplr-lib-rt >&2
fi
[[ -e $library ]] || { echo "intel_runtime: the packages hold no $library; has their layout changed?" >&2; exit 1; }
# With it on the library path it would take the place of the system's loader, which knows OCL_ICD_VENDORS.
rm -f "$folder"/lib/libOpenCL.so*

vendors=$folder/vendors
others=${OCL_ICD_VENDORS:-/etc/OpenCL/vendors}
[[ $others != "$vendors" ]] || others=/etc/OpenCL/vendors
rm -rf "$vendors"
mkdir -p "$vendors"
for known in "$others"/*.icd; do
    if [[ -e $known ]]; then cp "$known" "$vendors/"; fi
done
# The file that comes with the packages names a folder that does not exist.
echo "$library" >"$vendors/intel.icd"

echo "export OCL_ICD_VENDORS='$vendors'"
case ":${LD_LIBRARY_PATH:-}:" in
    *":$folder/lib:"*) echo "export LD_LIBRARY_PATH='$LD_LIBRARY_PATH'" ;;
    *) echo "export LD_LIBRARY_PATH='$folder/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}'" ;;
esac
