#!/usr/bin/env bash
# scripts/package_elsewhere.sh RELEASE ARCHITECTURE: makes the Debian packages for another release of Debian, or for another
# processor: bookworm or trixie, amd64 or arm64. They are written into build/packages/RELEASE-ARCHITECTURE.
#
# It compiles in a bare system of that release, which debootstrap makes in build/chroots, 2 GB each; code for arm64 is
# cross-compiled. The web interface is taken from build/page. It needs root, debootstrap, a network the first time and, for
# arm64, qemu-user-static: the program itself writes its manual pages. It compiles for 10 to 15 minutes of one processor.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

release=${1-} arch=${2-}
if [[ ! $release =~ ^(bookworm|trixie)$ || ! $arch =~ ^(amd64|arm64)$ || $# != 2 ]]; then
  sed -n '2,7s/^# \{0,1\}//p' "$0"
  exit 2
fi
fail() {
  echo "scripts/package_elsewhere.sh: $1" >&2
  exit 1
}
[[ $EUID == 0 ]] || fail "only root can enter a bare system"
command -v debootstrap >/dev/null || fail "debootstrap is not installed: apt-get install debootstrap"
[[ -f build/page/index.html ]] || fail "there is no build/page: scripts/page.sh builds it"
# Mounts of a namespace of its own disappear with it.
[[ -n ${PASSO_IN_NAMESPACE-} ]] || PASSO_IN_NAMESPACE=1 exec unshare --mount "$PWD/scripts/package_elsewhere.sh" "$@"

# --- the bare system with what the build needs, for the processor of this computer
source=$PWD
root=$PWD/build/chroots/$release-$arch
log=$root.log
native=$(dpkg --print-architecture)
cross=() profiles=pkg.passo.page compiler=()
if [[ $arch != "$native" ]]; then
  cross=(--host-architecture "$arch") profiles+=,cross  # apt adds it only where no profile is named
  compiler=("crossbuild-essential-$arch")
fi
inside() {
  chroot "$root" env --ignore-environment HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"
}
mkdir -p build/chroots
if [[ ! -d $root ]]; then
  echo "A bare $release is made in ${root#"$PWD/"}; see ${log#"$PWD/"}."
  rm -rf "$root.unfinished"
  debootstrap --variant=minbase "$release" "$root.unfinished" http://deb.debian.org/debian >"$log" 2>&1 ||
    fail "debootstrap fails; is there a network? See $log"
  mv "$root.unfinished" "$root"
fi
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mkdir -p "$root$source"
mount --bind "$source" "$root$source"
if [[ ! -f $root.needs ]] || ! cmp --silent debian/control "$root.needs"; then
  if [[ $arch != "$native" ]]; then inside dpkg --add-architecture "$arch"; fi
  {
    inside apt-get update --quiet &&
      inside apt-get build-dep --yes --quiet --no-install-recommends --build-profiles "$profiles" "${cross[@]}" "$source" &&
      inside apt-get install --yes --quiet --no-install-recommends debhelper lintian "${compiler[@]}" &&
      inside apt-get clean
  } >>"$log" 2>&1 || fail "what the build needs cannot be installed: see $log"
  cp debian/control "$root.needs"
fi

# --- build and packages, in there
options=(-DPASSO_BUILD_TESTS=OFF -DPASSO_BUILD_BENCHMARKS=OFF)
if [[ $arch != "$native" ]]; then
  processor=$(inside dpkg-architecture -a "$arch" -q DEB_HOST_GNU_CPU 2>/dev/null)
  # Outside of the bare system the kernel may start programs for other processors by itself. Where it does not, qemu does.
  cp "$(command -v "qemu-$processor-static")" "$root/usr/bin/" || fail "qemu-user-static is not installed"
  options+=(-DCMAKE_SYSTEM_NAME=Linux "-DCMAKE_SYSTEM_PROCESSOR=$processor" "-DCMAKE_CXX_COMPILER=$processor-linux-gnu-g++"
    "-DCMAKE_CROSSCOMPILING_EMULATOR=/usr/bin/qemu-$processor-static")
fi
inside cmake -S "$source" --preset release -B "$source/build/$release-$arch" "${options[@]}" >>"$log" 2>&1 ||
  fail "CMake fails: see $log"
inside cmake --build "$source/build/$release-$arch" --target everything_installed || fail "the build fails"
inside env DEB_BUILD_PROFILES="${profiles//,/ }" PASSO_BUILD="build/$release-$arch" PASSO_PACKAGES="build/packages/$release-$arch" PASSO_ARCHITECTURE="$arch" \
  ${PASSO_NO_LINTIAN:+PASSO_NO_LINTIAN=1} "$source/scripts/package.sh"
