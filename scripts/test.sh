#!/usr/bin/env bash
# scripts/test.sh [--all|--full]: builds Passo with all its tests and runs them. First of all it checks the format.
#
#   --all    what CI wants, before that: what reads what others wrote, and the whole street, by clang under
#            AddressSanitizer and UndefinedBehaviorSanitizer; all else looked at by clang. Without benchmarks
#   --full   slow tests make all of their trials and not a part: an hour and more. Random tests draw new cases, from
#            PASSO_SEED_OFFSET if it is set
#
# The last lines are the summary of ctest, and its exit code is the script's. Before it stands what each part took.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1-}" in
  "" | --all | --full) ;;
  *)
    sed -n '2,9s/^# \{0,1\}//p' scripts/test.sh
    exit 2
    ;;
esac

# What each part takes on two cores without a compiler cache, in minutes: a part that takes longer is named.
declare -A budget=([format]=1 [sanitize]=4 [look]=3 [build]=11)
times=()
begun=$SECONDS
ends() {  # PART: it ends now
  local took=$((SECONDS - begun))
  times+=("$(printf '%-10s %3d min %02d s%s' "$1" $((took / 60)) $((took % 60)) \
    "$([[ $took -le $((60 * budget[$1])) ]] || echo ", more than ${budget[$1]} min")")")
  begun=$SECONDS
}
build() {  # PRESET [TARGET...]
  cmake --build "build/$1" --parallel "$(nproc)" ${2:+--target "${@:2}"}
}
run_tests() {  # PRESET [OPTION...]; two more at a time than there are processors, since many tests wait
  ctest --test-dir "build/$1" --parallel $(($(nproc) + 2)) --output-on-failure --no-tests=error "${@:2}"
}

scripts/install.sh
begun=$SECONDS
scripts/format.sh --check
ends format
if [[ ${1-} == --all ]]; then
  # Without lines of the source in a stack: a fifth less to compile.
  cmake --preset sanitize -DCMAKE_CXX_FLAGS_DEBUG=-O0
  build sanitize
  ends sanitize
  # The last of these tests leave a processor idle: clang looks meanwhile.
  run_tests sanitize --label-exclude slow >build/sanitize/tests.log 2>&1 &
  sanitized=$!
  looked=0
  scripts/look_by_clang.sh || looked=$?
  passed=0
  wait "$sanitized" || passed=$?
  cat build/sanitize/tests.log
  [[ $looked$passed == 00 ]] || exit 1
  ends look
fi
benchmarks=ON
if [[ ${1-} == --all ]]; then benchmarks=OFF; fi
in_full=OFF
if [[ ${1-} == --full ]]; then
  in_full=ON
  export PASSO_SEED_OFFSET=${PASSO_SEED_OFFSET-$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')}
  printf 'The random tests draw new cases: PASSO_SEED_OFFSET=%s\n' "$PASSO_SEED_OFFSET"
fi
cmake --preset release -DPASSO_BUILD_TESTS=ON -DPASSO_BUILD_BENCHMARKS=$benchmarks -DPASSO_TESTS_IN_FULL=$in_full
build release
ends build
printf 'Time of the parts:\n'
printf '  %s\n' "${times[@]}"
run_tests release
