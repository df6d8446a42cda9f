#!/usr/bin/env bash
# Sourced by scripts that compare with Mitsuba 3: builds quasilux and puts Mitsuba, from PyPI, below build/; $folder/bin/python3 then
# has both.
# Dr.Jit's kernels need LLVM 17 or later: older ones end with "Cannot select: fminimum".
bash scripts/setup.sh libllvm19
DRJIT_LIBLLVM_PATH=$(PATH=$PATH:/sbin:/usr/sbin ldconfig -p | sed -nE 's/.*libLLVM\.so\.19.* => (.*)/\1/p' | head -n 1)
export DRJIT_LIBLLVM_PATH
cmake --preset release
cmake --build --preset release --target quasilux

folder=$PWD/build/mitsuba
if [[ ! -x $folder/bin/pip ]]; then # a folder without it was left half made
    # Debian's own Python, whose modules read the images.
    /usr/bin/python3 -m venv --system-site-packages "$folder" || {
        echo "mitsuba: /usr/bin/python3 -m venv failed; on Debian install python3-venv" >&2
        exit 1
    }
fi
"$folder/bin/pip" install --quiet --disable-pip-version-check mitsuba
