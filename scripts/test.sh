#!/usr/bin/env bash
# scripts/test.sh [--all]: builds Passo with all its tests and runs them.
#
#   --all   what CI wants, before that: the format check, and the fast tests, built by clang, under
#           AddressSanitizer and UndefinedBehaviorSanitizer
#
# The last lines are the summary of ctest, and its exit code is the script's.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1-}" in
  "" | --all) ;;
  *)
    sed -n '2,7s/^# \{0,1\}//p' scripts/test.sh
    exit 2
    ;;
esac

build() {  # PRESET [OPTION...]
  local preset=$1
  shift
  cmake --preset "$preset" "$@"
  cmake --build "build/$preset" --parallel "$(nproc)"
}
run_tests() {  # PRESET [OPTION...]
  local preset=$1
  shift
  ctest --test-dir "build/$preset" --parallel "$(nproc)" --output-on-failure --no-tests=error "$@"
}

scripts/install.sh
if [[ ${1-} == --all ]]; then
  scripts/format.sh --check
  build sanitize -DPASSO_BUILD_BENCHMARKS=OFF
  run_tests sanitize --label-exclude slow
fi
build release -DPASSO_BUILD_TESTS=ON -DPASSO_BUILD_BENCHMARKS=ON
run_tests release
