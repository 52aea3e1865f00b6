#!/usr/bin/env bash
# scripts/start.sh: from a fresh clone to a first job. Installs what is missing, builds the program, engraves an example
# on a virtual machine, and names the picture and the report that it wrote. Then it builds the rest: the web interface,
# the firmware and the emulated boards.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build() {
  cmake --build build/release --target "$@" --parallel "$(nproc)"
}

scripts/install.sh --build

# A build that has been set up with tests keeps them.
tests_off=(-DPASSO_BUILD_TESTS=OFF -DPASSO_BUILD_BENCHMARKS=OFF)
[[ -f build/release/CMakeCache.txt ]] && tests_off=()
cmake --preset release "${tests_off[@]}"
build passo

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
echo "Ready after $((SECONDS / 60)) min $((SECONDS % 60)) s. Now the web interface, the firmware and the emulated boards:"
echo

build emulated_boards
scripts/page.sh

echo
echo "In a browser, at http://127.0.0.1:7080: build/release/passo serve"
echo "The same on an emulated Uno: build/release/passo run --yes examples/engrave.ngc -m examples/machines/uno.toml --board sim:uno"
