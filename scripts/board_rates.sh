#!/usr/bin/env bash
# scripts/board_rates.sh [TICKS...]: plays long random segment streams on the emulated boards at one event rate after the
# other, compares every edge with the host's model, and writes the table into docs/boards.md, between its marks.
#
# With TICKS, these intervals only, and the table is just printed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/release
cmake --build "$build" --parallel "$(nproc)" --target board_rates >/dev/null
if (($# > 0)); then
  "$build/tests/emulator/board_rates" "$@"
  exit
fi
table=$(mktemp)
trap 'rm -f "$table" "$table.new"' EXIT
"$build/tests/emulator/board_rates" >"$table"
awk -v table="$table" '
  /^<!-- end of rates -->$/ { skipping = 0 }
  !skipping { print }
  /^<!-- rates -->$/ {
    skipping = 1
    while ((getline line < table) > 0) print line
  }' docs/boards.md >"$table.new"
cat "$table.new" >docs/boards.md
cat "$table"
