#!/usr/bin/env bash
# scripts/costs.sh: measures what a pulse of each interpolator and ramp costs, on the emulated ATmega328P and on this
# machine, and writes both tables into docs/interpolation/costs.md, between their marks.
#
# The chip's figures are the same everywhere (with the same compiler), and a test holds them; this machine's are not.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if (($# > 0)); then
  sed -n '2,5s/^# \{0,1\}//p' scripts/costs.sh
  exit 2
fi

scripts/install.sh
document=docs/interpolation/costs.md
build=build/release
new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT

cmake --preset release -DPASSO_BUILD_TESTS=ON -DPASSO_BUILD_BENCHMARKS=ON >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target chip_costs interpolate_benchmark
"$build/tests/emulator/chip_costs" >"$new/chip"

# The median of five runs: other programs run beside it.
"$build/bench/interpolate_benchmark" --benchmark_format=csv --benchmark_repetitions=5 2>/dev/null >"$new/csv"
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
{
  processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
  echo "${processor:-$(uname -m)}, one core, compiled by $("$compiler" --version | head -n 1)."
  echo
  echo "| what | method | axes | bits | ns a pulse | million pulses/s |"
  echo "|---|---|---:|---:|---:|---:|"
  # name,iterations,real_time,cpu_time,time_unit,bytes_per_second,items_per_second,…; name: what/method/axes/bits
  awk -F, '/_median"/ {
    gsub(/"|_median/, "", $1)
    split($1, name, "/")
    printf "| %s | %s | %s | %s | %.2f | %.0f |\n", name[1], name[2], name[3], name[4], 1e9 / $7, $7 / 1e6
  }' "$new/csv"
} >"$new/host"

scripts/put_tables.sh "$document" "$new"
cat "$new/chip" "$new/host"
