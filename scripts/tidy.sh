#!/usr/bin/env bash
# scripts/tidy.sh [FILE...]: clang-tidy over the sources under src/ (not the tests), or over the given files.
set -euo pipefail
caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --preset clang >/dev/null
files=()
for file in "$@"; do files+=("$(realpath "$caller/$file")"); done
if (($# == 0)); then
  while IFS= read -r -d '' file; do files+=("$file"); done < <(
    find "$PWD/src" -name '*.cpp' -not -path '*/tests/*' -print0 | sort -z)
fi
((${#files[@]} > 0)) || exit 0
printf '%s\0' "${files[@]}" | xargs -0 -r -n 1 -P "$(nproc)" clang-tidy -p build/clang --quiet
