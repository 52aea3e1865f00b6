#!/usr/bin/env bash
# scripts/package.sh: makes the Debian packages passo and passo-emulators from build/release and build/page, and writes
# them with SHA256SUMS into build/packages.
#
# It compiles only what is missing in build/release. It needs debhelper; with lintian it checks the packages, too, unless
# PASSO_NO_LINTIAN is set.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if (($# > 0)); then
  sed -n '2,6s/^# \{0,1\}//p' "$0"
  exit 2
fi
for program in dh dpkg-buildpackage; do
  command -v "$program" >/dev/null || {
    echo "scripts/package.sh: $program is not installed: apt-get install debhelper dpkg-dev" >&2
    exit 1
  }
done
[[ -f build/release/CMakeCache.txt && -f build/page/index.html ]] || {
  echo "scripts/package.sh: there is no build/release or no build/page: scripts/start.sh builds both" >&2
  exit 1
}
of_cmake=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' build/release/CMakeCache.txt)
of_changelog=$(dpkg-parsechangelog --file debian/changelog --show-field Version)
if [[ ${of_changelog/\~/-} != "$of_cmake"* ]]; then
  echo "scripts/package.sh: debian/changelog says $of_changelog, CMakeLists.txt $of_cmake" >&2
  exit 1
fi
cmake --build build/release --target everything_installed >/dev/null

# dpkg-buildpackage writes beside the folder in which it runs. It needs no sources: `cmake --install` has all files.
mkdir -p build/packages
folder=$(mktemp -d build/packages/work.XXXXXX)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/passo"
cp -r debian "$folder/passo/"
build=$PWD/build/release
(
  cd "$folder/passo"
  # With the compiler of the build folder, whatever packages it came from: -d.
  PASSO_BUILD_FOLDER=$build DEB_BUILD_OPTIONS=noautodbgsym dpkg-buildpackage -b -us -uc -d >../log 2>&1
) || {
  tail -n 30 "$folder/log" >&2
  exit 1
}
if [[ -z ${PASSO_NO_LINTIAN-} ]] && command -v lintian >/dev/null; then
  # Errors and warnings end it. What it says else is in build/packages/lintian.txt.
  lintian -EviI --fail-on error,warning --allow-root "$folder"/*.changes >"$folder/lintian" || {
    grep -E '^[EW]:' "$folder/lintian" >&2
    exit 1
  }
  cp "$folder/lintian" build/packages/lintian.txt
fi
rm -f build/packages/*.deb
mv "$folder"/*.deb build/packages/
(cd build/packages && sha256sum -- *.deb >SHA256SUMS)
ls -l build/packages/*.deb
