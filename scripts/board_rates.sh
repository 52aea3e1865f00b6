#!/usr/bin/env bash
# scripts/board_rates.sh [--pulses | TICKS...]: plays long random segment streams on the emulated boards at one event rate
# after the other, compares every edge with the host's model, and writes the table into docs/boards.md, between its marks.
# Then the table of the highest rates for each length of step pulses; with --pulses, that one only.
#
# With TICKS, these intervals only, and the table is just printed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/release
cmake --build "$build" --parallel "$(nproc)" --target board_rates >/dev/null
if (($# > 0)) && [[ $1 != --pulses ]]; then
  "$build/tests/emulator/board_rates" "$@"
  exit
fi
tables=$(mktemp -d)
trap 'rm -rf "$tables"' EXIT
"$build/tests/emulator/board_rates" --pulses >"$tables/pulses"
[[ ${1-} == --pulses ]] || "$build/tests/emulator/board_rates" >"$tables/rates"
scripts/put_tables.sh docs/boards.md "$tables"
cat "$tables"/*
