#!/usr/bin/env bash
# Makes the Debian package and tries it where no compiler and no source is: in a Debian 12 of its own, by debootstrap. There `quasilux doctor` must
# find a device, and a scene is rendered. debian_package.sh [FOLDER for the new Debian, kept; default: a temporary one]. As root; needs debootstrap.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh --program file dpkg-dev
cmake --preset release
cmake --build --preset release --target quasilux
rm -f build/release/quasilux_*.deb
(cd build/release && cpack -G DEB)
package=$(echo build/release/quasilux_*.deb)
dpkg-deb --info "$package"

command -v debootstrap >/dev/null || bash scripts/setup.sh --program debootstrap
debian=${1:-}
mounted=()
clean() {
    for place in "${mounted[@]}"; do umount "$place"; done
    [[ -n ${1:-} ]] || rm -rf "$debian"
}
kept=$debian
[[ -n $debian ]] || debian=$(mktemp -d)
trap 'clean "$kept"' EXIT

[[ -e $debian/etc/debian_version ]] || debootstrap --variant=minbase bookworm "$debian"
# PoCL asks the system for its cores.
for place in proc sys; do
    if mount --bind "/$place" "$debian/$place" 2>/dev/null; then mounted+=("$debian/$place"); fi
done
cp "$package" scenes/cornell_ggx.xml "$debian/tmp/"
inside() { chroot "$debian" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"; }
inside apt-get install -y "/tmp/$(basename "$package")"
inside quasilux --version
inside quasilux doctor
inside quasilux render /tmp/cornell_ggx.xml -D resolution=64 --time 3 -o /tmp/box.exr --png /tmp/box.png
inside test -s /tmp/box.exr
inside test -f /usr/share/man/man1/quasilux-render.1 -a -f /usr/share/bash-completion/completions/quasilux
echo "package: $package, installed and run in $debian"
