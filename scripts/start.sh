#!/usr/bin/env bash
# scripts/start.sh: from a fresh clone to a first job. Installs what is missing, builds Passo with its emulated boards,
# engraves an example on a virtual machine, and names the picture and the report that it wrote.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install.sh --build

# A build that has been set up with tests keeps them.
tests_off=(-DPASSO_BUILD_TESTS=OFF -DPASSO_BUILD_BENCHMARKS=OFF)
[[ -f build/release/CMakeCache.txt ]] && tests_off=()
cmake --preset release "${tests_off[@]}"
cmake --build build/release --target passo emulated_boards --parallel "$(nproc)"
scripts/page.sh

mkdir -p out
first_job=(build/release/passo run --yes examples/engrave.ngc
  --machine examples/machines/pantograph.toml
  --picture out/engrave.png
  --report out/report.json)
echo "+ ${first_job[*]}"
"${first_job[@]}"

echo
echo "Picture: $PWD/out/engrave.png"
echo "Report:  $PWD/out/report.json"
echo "In a browser, at http://127.0.0.1:7080: build/release/passo serve"
echo "The same on an emulated Uno: build/release/passo run --yes examples/engrave.ngc -m examples/machines/uno.toml --board sim:uno"
