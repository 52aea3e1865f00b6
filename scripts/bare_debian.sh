#!/usr/bin/env bash
# scripts/bare_debian.sh RELEASE ARCHITECTURE FOLDER [PACKAGE...]: unpacks a bare Debian, with these packages, into FOLDER.
# debootstrap makes it once, in build/packages/RELEASE-ARCHITECTURE.tar. Exit code 77: that is not possible here.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

release=$1 arch=$2 root=$3
packages=("${@:4}")
base=build/packages/$release-$arch.tar
log=build/packages/$release-$arch.log
skip() {
  echo "$1 See $log" >&2
  exit 77
}
if [[ -f $base && $(cat "$base.needed" 2>/dev/null) == "${packages[*]}" ]]; then
  tar --extract --file "$base" --directory "$root"
  exit
fi
mkdir -p build/packages
if [[ $arch != "$(dpkg --print-architecture)" ]] && ! grep -qs enabled "/proc/sys/fs/binfmt_misc/qemu-$(case "$arch" in arm64) echo aarch64 ;; amd64) echo x86_64 ;; esac)"; then
  skip "The kernel does not start programs for $arch: install qemu-user-static and binfmt-support."
fi
debootstrap --variant=minbase --arch="$arch" "$release" "$root" http://deb.debian.org/debian >"$log" 2>&1 ||
  skip "debootstrap fails; is there a network?"
chroot "$root" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet --no-install-recommends "${packages[@]}" >>"$log" 2>&1 ||
  skip "These packages cannot be fetched: ${packages[*]}."
chroot "$root" apt-get clean
tar --create --one-file-system --file "$base.unfinished" --directory "$root" .
mv "$base.unfinished" "$base"
echo "${packages[*]}" >"$base.needed"
