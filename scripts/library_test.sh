#!/usr/bin/env bash
# scripts/library_test.sh [--packages FOLDER]: installs libpasso and the Python package from build/release into a temporary
# folder, builds and runs the examples against them, checks the types of the Python package, and makes and loads a wheel.
#
#   --packages FOLDER   unpacks the Debian packages in FOLDER instead, and builds and runs the examples only
#
# PASSO_BUILD_FOLDER: another build. Exit code 77, "skipped": the build has no libpasso.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
python=/usr/bin/python3  # Debian's, to which the module belongs
build=${PASSO_BUILD_FOLDER-build/release}

fail() {
  echo "scripts/library_test.sh: $1" >&2
  exit 1
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if [[ ${1-} == --packages && $# == 2 ]]; then
  for package in libpasso1 libpasso-dev python3-passo; do
    dpkg-deb --extract "$2/$package"_*.deb "$folder/installed"
  done
  prefix=$folder/installed/usr
elif (($# == 0)); then
  [[ -f $build/libpasso.so.1 ]] || {
    echo "There is no libpasso in $build." >&2
    exit 77
  }
  prefix=$folder/installed
  for component in library development python; do
    cmake --install "$build" --prefix "$prefix" --component "$component" >/dev/null
  done
else
  sed -n '2,7s/^# \{0,1\}//p' "$0"
  exit 2
fi
machine=$PWD/examples/machines/pantograph.toml
program=$PWD/examples/engrave.ngc

# --- only the interface is visible, and no path of the build
names=$(nm --dynamic --defined-only --demangle "$prefix"/lib*/libpasso.so.1 | cut -c 20- |
  grep -vE '^(passo::v1::|PASSO_1)' || true)
[[ -z $names ]] || fail "libpasso shows names that are not of its interface: ${names:0:500}"
# Debug information names it.
if grep --quiet '^CMAKE_BUILD_TYPE:.*=Release' "$build/CMakeCache.txt"; then
  ! grep --quiet --recursive --binary --fixed-strings "$PWD" "$prefix" || fail "an installed file names the folder of the build"
fi

# --- the examples, as C++17 and as a user compiles them
CXXFLAGS="-std=c++17 -Wall -Wextra -Wpedantic -Werror" cmake -S examples/library -B "$folder/examples" \
  -D CMAKE_PREFIX_PATH="$prefix" >"$folder/log" 2>&1 && cmake --build "$folder/examples" --parallel >>"$folder/log" 2>&1 ||
  { cat "$folder/log" >&2 && fail "the examples cannot be built"; }
"$folder/examples/plan_path" >"$folder/planned"
grep --quiet --line-regexp --extended-regexp '[0-9.]+ s, 16[0-9.]+ mm' "$folder/planned" || fail "plan_path prints $(cat "$folder/planned")"
"$folder/examples/read_gcode" "$program" >"$folder/read"
grep --quiet '^[0-9]*: line to ' "$folder/read" || fail "read_gcode finds no line"
"$folder/examples/check_program" "$program" "$machine" >"$folder/checked"
grep --quiet '^X: ' "$folder/checked" || fail "check_program prints no extents"
code=0
"$folder/examples/check_program" "$machine" "$machine" 2>"$folder/refused" || code=$?
[[ $code == 2 && -s $folder/refused ]] || fail "check_program accepts a machine file as a program"

# --- Python
[[ -d $prefix/lib/python3/dist-packages/passo ]] || exit 0
export PYTHONPATH=$prefix/lib/python3/dist-packages LD_LIBRARY_PATH=$prefix/lib PYTHONDONTWRITEBYTECODE=1
"$python" examples/python/plan_path.py >"$folder/planned.py"
grep --quiet ' steps; the first of X at ' "$folder/planned.py" || fail "plan_path.py prints $(cat "$folder/planned.py")"
"$python" examples/python/check_and_draw.py "$program" "$machine" "$folder" >"$folder/checked.py"
[[ $(head -c 4 "$folder/toolpath.png") == $'\x89PNG' && $(head -c 4 "$folder/stock.png") == $'\x89PNG' ]] || fail "there are no pictures"
(($# == 0)) || exit 0
"$python" src/interfaces/library/python/tests/package_test.py "$program" "$machine"
if "$python" -c 'import mypy' 2>/dev/null; then
  MYPYPATH=$PYTHONPATH "$python" -m mypy --strict --cache-dir "$folder/mypy" --package passo >"$folder/types" &&
    MYPYPATH=$PYTHONPATH "$python" -m mypy --strict --cache-dir "$folder/mypy" examples/python/*.py >"$folder/types" ||
    { cat "$folder/types" >&2 && fail "types are wrong"; }
fi
if "$python" -c 'import build' 2>/dev/null; then
  unset PYTHONPATH LD_LIBRARY_PATH
  PASSO_BUILD_FOLDER=$build scripts/wheel.sh "$folder/wheel" >/dev/null
  "$python" -m zipfile -e "$folder"/wheel/passo-*.whl "$folder/unpacked"
  PYTHONPATH=$folder/unpacked "$python" -c 'import passo; print(passo.__version__)' >"$folder/version"
fi
