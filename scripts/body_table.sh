#!/usr/bin/env bash
# scripts/body_table.sh [PASSO]: carves twenty models by `passo cam relief`, and prints a table: the processor time, the
# memory, and how deep each program cuts into its model at most, by exact contact with the triangles every 0.05 mm along
# each feed move. PASSO: another build of the program. `--write FOLDER` only writes the models, as STL.
#
# The models are made by bench/body_table.cpp: walls, ribs, tips, caves, scans. Needs build/release with benchmarks
# (PASSO_BUILD_BENCHMARKS=ON). The exit code is 1 if a program cuts deeper than 0.01 mm into its model.
set -euo pipefail
if [[ ${1-} == -* && ${1-} != --write ]]; then
  sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 2
fi
table=$(dirname "${BASH_SOURCE[0]}")/../build/release/bench/body_table
[[ -x $table ]] || { echo "body_table.sh: there is no $table" >&2; exit 1; }
exec "$table" "$@"
