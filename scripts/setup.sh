#!/usr/bin/env bash
# Installs what quasilux needs on Debian 12, all of it from Debian's packages, and the further ones named: setup.sh [--program | --python] [--mpi] [PACKAGE...].
# --program: only what it takes to build and run it; without it also what tests and reports need, which is twice as much.
# --python: what it takes to build the program and, by `pip install .`, the Python package.
# --mpi: also Open MPI, which tests have anyway, and build/mpi is set up for a release build with it: cmake --build --preset mpi.
# Needs root or sudo; does nothing where everything is there already.
set -euo pipefail
cd "$(dirname "$0")/.."

mpi=()
python=()
onlyProgram=0
while [[ ${1:-} == --* ]]; do
    case $1 in
        --program) onlyProgram=1 ;;
        --python) onlyProgram=1; python=(python3-dev python3-venv python3-numpy) ;;
        --mpi) mpi=(libopenmpi-dev openmpi-bin) ;;
        *) echo "setup: unknown option $1, expected --program, --python or --mpi" >&2; exit 2 ;;
    esac
    shift
done

compiler=(g++ cmake ninja-build pkg-config)
opencl=(pocl-opencl-icd ocl-icd-opencl-dev opencl-headers opencl-clhpp-headers)
libraries=(libembree-dev libopenimageio-dev libglm-dev libcli11-dev libpugixml-dev libtinygltf-dev nlohmann-json3-dev libfmt-dev
    libxxhash-dev zlib1g-dev libcpp-httplib-dev fonts-dejavu-core)
tests=(libgtest-dev libgmock-dev clang clang-format clang-tidy openimageio-tools oclgrind chromium python3-websocket
    python3-dev python3-venv pybind11-dev mypy assimp-testmodels libopenmpi-dev openmpi-bin)
reports=(python3 python3-numpy python3-openimageio python3-matplotlib)
packages=("${compiler[@]}" "${opencl[@]}" "${libraries[@]}")
((onlyProgram)) || packages+=("${tests[@]}" "${reports[@]}")
packages+=("${python[@]}" "${mpi[@]}" "$@")

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || missing+=("$package")
done

configure() {
    ((${#mpi[@]} == 0)) || cmake --preset mpi
}

if ((${#missing[@]} == 0)); then
    echo "setup: all ${#packages[@]} packages are installed"
    configure
    exit 0
fi

asRoot=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        echo "setup: missing ${missing[*]}; run this as root, or install sudo" >&2
        exit 1
    fi
    asRoot=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${asRoot[@]}" apt-get update
"${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
configure
