#!/usr/bin/env bash
# scripts/format.sh [--check]: formats all C++ of the project with clang-format 14, or only says what is not formatted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1-}" in
  "") action=(-i) ;;
  --check) action=(--dry-run --Werror) ;;
  *)
    sed -n '2s/^# //p' scripts/format.sh
    exit 2
    ;;
esac
# Other versions format in other ways.
clang_format=$(command -v clang-format-14 || command -v clang-format || true)
if [[ -z $clang_format || $("$clang_format" --version) != *"version 14."* ]]; then
  echo "scripts/format.sh: clang-format 14, of Debian 12, is not installed: the format is not checked." >&2
  [[ ${1-} != --check ]] || exit 0
  exit 1
fi

find src tests bench -name node_modules -prune -o \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z |
  xargs -0 -r -n 50 "$clang_format" --style=file "${action[@]}"
