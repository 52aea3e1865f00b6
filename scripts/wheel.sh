#!/usr/bin/env bash
# scripts/wheel.sh [FOLDER]: makes a wheel of the Python package passo, with libpasso inside, from build/release. Default of
# FOLDER: build/packages. It needs Debian's python3-build, python3-setuptools and python3-wheel, and no network.
#
# PASSO_BUILD_FOLDER: another build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
python=/usr/bin/python3  # Debian's, to which the module belongs
build=${PASSO_BUILD_FOLDER-build/release}
to=${1-build/packages}

made=("$build"/python/passo/_core*.so)
[[ -f ${made[0]} ]] || {
  echo "scripts/wheel.sh: there is no Python module in $build: cmake --build $build --target passo_python" >&2
  exit 1
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r src/interfaces/library/python/passo src/interfaces/library/python/setup.py src/interfaces/library/python/pyproject.toml "$folder/"
cmake --install "$build" --prefix "$folder/installed" --component python >/dev/null
cmake --install "$build" --prefix "$folder/installed" --component library >/dev/null
cp "$folder"/installed/lib/python3/dist-packages/passo/_core*.so "$folder"/installed/lib*/libpasso.so.1 "$folder/passo/"
rm -r "$folder/installed"
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
mkdir -p "$to"
PASSO_VERSION=$version "$python" -m build --no-isolation --wheel --outdir "$to" "$folder"
