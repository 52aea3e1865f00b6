#!/usr/bin/env bash
# scripts/package.sh [--all]: makes the Debian packages passo and passo-emulators from build/release and build/page, and
# writes them with SHA256SUMS into build/packages.
#
#   --all   also those for Debian 12 and 13 on amd64 and for Debian 12 on arm64, each in a folder of its own, and with podman
#           the container; each compilation takes 10 to 15 minutes of one processor (scripts/package_elsewhere.sh)
#
# It compiles only what is missing in build/release. It needs debhelper; with lintian it checks the packages, too, unless
# PASSO_NO_LINTIAN is set. scripts/package_elsewhere.sh sets PASSO_BUILD, PASSO_PACKAGES and PASSO_ARCHITECTURE.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1-}" in
  "" | --all) ;;
  *)
    sed -n '2,9s/^# \{0,1\}//p' "$0"
    exit 2
    ;;
esac
build=$PWD/${PASSO_BUILD:-build/release}
packages=${PASSO_PACKAGES:-build/packages}
architecture=${PASSO_ARCHITECTURE:-$(dpkg --print-architecture)}
for program in dh dpkg-buildpackage; do
  command -v "$program" >/dev/null || {
    echo "scripts/package.sh: $program is not installed: apt-get install debhelper dpkg-dev" >&2
    exit 1
  }
done
[[ -f $build/CMakeCache.txt && -f build/page/index.html ]] || {
  echo "scripts/package.sh: there is no $build or no build/page: scripts/start.sh builds both" >&2
  exit 1
}
of_cmake=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
of_changelog=$(dpkg-parsechangelog --file debian/changelog --show-field Version)
if [[ ${of_changelog/\~/-} != "$of_cmake"* ]]; then
  echo "scripts/package.sh: debian/changelog says $of_changelog, CMakeLists.txt $of_cmake" >&2
  exit 1
fi
cmake --build "$build" --target everything_installed >/dev/null

# dpkg-buildpackage writes beside the folder in which it runs. It needs no sources: `cmake --install` has all files.
mkdir -p "$packages"
folder=$(mktemp -d "$packages/work.XXXXXX")
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/passo"
cp -r debian "$folder/passo/"
# Packages for a later release have a later version: an upgrade of the system upgrades them.
of_system=$(. /etc/os-release && echo "${ID-}${VERSION_ID-}")
if [[ $of_system != debian12 ]]; then sed -i "1s/)/+${of_system/debian/deb})/" "$folder/passo/debian/changelog"; fi
(
  cd "$folder/passo"
  # With the compiler of the build folder, whatever packages it came from: -d.
  PASSO_BUILD_FOLDER=$build DEB_BUILD_OPTIONS=noautodbgsym dpkg-buildpackage -b -us -uc -d -a "$architecture" >../log 2>&1
) || {
  tail -n 30 "$folder/log" >&2
  exit 1
}
if grep --recursive --files-with-matches --fixed-strings "$PWD" "$folder"/passo/debian/*/usr >&2; then
  echo "scripts/package.sh: these files name the folder in which they were built, $PWD" >&2
  exit 1
fi
if [[ -z ${PASSO_NO_LINTIAN-} ]] && command -v lintian >/dev/null; then
  # Errors and warnings end it. What it says else is in lintian.txt.
  lintian -EviI --fail-on error,warning --allow-root "$folder"/*.changes >"$folder/lintian" || {
    grep -E '^[EW]:' "$folder/lintian" >&2
    exit 1
  }
  cp "$folder/lintian" "$packages/lintian.txt"
fi
rm -f "$packages"/*.deb "$packages"/*.tar.gz
mv "$folder"/*.deb "$packages/"
if [[ ${1-} == --all ]]; then
  for target in bookworm-amd64 trixie-amd64 bookworm-arm64; do
    [[ $target != "$(. /etc/os-release && echo "${VERSION_CODENAME-}")-$architecture" ]] || continue
    scripts/package_elsewhere.sh "${target%-*}" "${target#*-}"
  done
  if command -v podman >/dev/null; then
    scripts/container_test.sh --save "$packages/passo_${of_changelog}_container_$architecture.tar.gz"
  else
    echo "scripts/package.sh: podman is not installed: the container is not made" >&2
  fi
fi
(cd "$packages" && shopt -s nullglob && sha256sum -- *.deb {bookworm,trixie}-*/*.deb *.tar.gz >SHA256SUMS)
ls -l "$packages"/*.deb
