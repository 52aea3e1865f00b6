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
tables=$(mktemp -d)
trap 'rm -rf "$tables"' EXIT
"$build/tests/emulator/board_rates" >"$tables/rates"
scripts/put_tables.sh docs/boards.md "$tables"
cat "$tables/rates"
