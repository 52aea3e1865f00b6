#!/usr/bin/env bash
# scripts/page.sh [--test]: builds the page that `passo serve` shows, into build/page.
#
#   --test    also runs the tests of the page's parts
#
# It fetches what page/package-lock.json names, once. Needs node 18 or later with npm; without them it says so, and ends
# well: all but the page works.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../page"

case "${1-}" in
  "" | --test) ;;
  *)
    sed -n '2,7s/^# \{0,1\}//p' "../scripts/page.sh"
    exit 2
    ;;
esac
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "The page is not built: there is no node or no npm. passo serve works without it." >&2
  exit 0
fi
if ! cmp --silent package-lock.json node_modules/.passo-lock; then
  echo "+ npm ci in page"
  if ! npm ci --ignore-scripts --no-audit --no-fund --silent; then
    echo "The page is not built: its parts could not be fetched. passo serve works without it." >&2
    exit 0
  fi
  cp package-lock.json node_modules/.passo-lock
fi
# The lab's module is made of the program's sources, where CMake was set up and finds what it needs.
if [[ -e ../build/release/build.ninja && -n $(find ../build/release/src/lab -name lab.dir 2>/dev/null) ]]; then
  cmake --build ../build/release --target lab >/dev/null || echo "lab.wasm could not be built: the page has no lab." >&2
fi
# What has not changed is not built again.
newest=$(find . ../build/release/src/lab/lab.wasm -path ./node_modules -prune -o -type f -newer ../build/page/index.html -print 2>/dev/null | head -1 || true)
if [[ ! -e ../build/page/index.html || -n $newest ]]; then
  # A wrong type is an error; the lines of the build itself interest nobody.
  npm run --silent build -- --logLevel warn
  echo "The page is in build/page."
fi
[[ ${1-} != --test ]] || npm run --silent test
