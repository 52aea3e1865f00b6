#!/usr/bin/env bash
# scripts/test.sh [--all|--full]: builds Passo with all its tests and runs them.
#
#   --all    what CI wants, before that: the format check; what reads what others wrote, and the whole street, by clang
#            under AddressSanitizer and UndefinedBehaviorSanitizer; all else looked at by clang. Without benchmarks
#   --full   slow tests make all of their trials and not a part: an hour and more
#
# The last lines are the summary of ctest, and its exit code is the script's.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1-}" in
  "" | --all | --full) ;;
  *)
    sed -n '2,8s/^# \{0,1\}//p' scripts/test.sh
    exit 2
    ;;
esac

build() {  # PRESET [TARGET...]
  cmake --build "build/$1" --parallel "$(nproc)" ${2:+--target "${@:2}"}
}
run_tests() {  # PRESET [OPTION...]; one more at a time than there are processors, since some tests wait
  ctest --test-dir "build/$1" --parallel $(($(nproc) + 1)) --output-on-failure --no-tests=error "${@:2}"
}

scripts/install.sh
if [[ ${1-} == --all ]]; then
  scripts/format.sh --check
  cmake --preset sanitize
  build sanitize
  run_tests sanitize --label-exclude slow
  scripts/look_by_clang.sh
fi
benchmarks=ON
if [[ ${1-} == --all ]]; then benchmarks=OFF; fi
in_full=OFF
if [[ ${1-} == --full ]]; then in_full=ON; fi
cmake --preset release -DPASSO_BUILD_TESTS=ON -DPASSO_BUILD_BENCHMARKS=$benchmarks -DPASSO_TESTS_IN_FULL=$in_full
build release
run_tests release
