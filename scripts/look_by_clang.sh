#!/usr/bin/env bash
# scripts/look_by_clang.sh: has clang look for errors and warnings in all sources that the preset sanitize, once it is
# built, has not compiled: the program and the benchmarks. No code is made. --tests: the rest of the tests too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --preset look >/dev/null
cmake --build build/look --parallel "$(nproc)" --target passo_test_headers_{ON,OFF} passo_standard_headers
tests=no
[[ ${1-} == --tests ]] && tests=yes
# An object has one name in both builds.
commands=()
while read -r object && read -r command; do
  [[ $object != *.pch ]] || continue
  [[ -e build/sanitize/$object || ($tests == no && $object =~ (_tests|_replay)\.dir/) ]] || commands+=("$command -fsyntax-only")
done < <(jq -r '.[].command | capture(" -o (?<object>\\S+) ").object, .' build/look/compile_commands.json)
echo "clang looks at ${#commands[@]} sources"
cd build/look
printf '%s\0' "${commands[@]}" | xargs -0 -r -n 1 -P "$(nproc)" bash -c
