#!/usr/bin/env bash
# scripts/page.sh [--test|--stories [WORDS]]: builds the page that `passo serve` shows, into build/page.
#
#   --test      then runs the tests of the page's parts
#   --stories   then runs whole stories: Chromium against build/release/passo (or $PASSO_PROGRAM) and its virtual machine;
#               with WORDS, a regular expression, those whose names have them
#
# It fetches what page/package-lock.json names, once. It needs node 18 or later with npm. Where something is missing, it
# says what: alone it ends well, because all but the page works; with an option it ends with 77, "skipped".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../page"

case "${1-}" in
  "" | --test | --stories) ;;
  *)
    sed -n '2,9s/^# \{0,1\}//p' "../scripts/page.sh"
    exit 2
    ;;
esac
lacking() {
  echo "$1 passo serve works without the page." >&2
  [[ -n ${2-} ]] && exit 77
  exit 0
}
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  lacking "The page is not built: there is no node or no npm." "${1-}"
fi
if ! cmp --silent package-lock.json node_modules/.passo-lock; then
  echo "+ npm ci in page"
  npm ci --ignore-scripts --no-audit --no-fund --silent || lacking "The page is not built: its parts could not be fetched." "${1-}"
  cp package-lock.json node_modules/.passo-lock
fi
# Two modules are made of the program's sources, where CMake was set up and finds what it needs.
if [[ -e ../build/release/build.ninja && -n $(find ../build/release/src/study/lab -name lab.dir 2>/dev/null) ]]; then
  cmake --build ../build/release --target lab stock >/dev/null || echo "lab.wasm, stock.wasm could not be built: the page lacks lab and stock." >&2
fi
# What has not changed is not built again.
newest=$(find . ../build/release/src/study/lab/lab.wasm ../build/release/src/cam/stock/stock.wasm -path ./node_modules -prune -o -type f -newer ../build/page/index.html -print 2>/dev/null | head -1 || true)
if [[ ! -e ../build/page/index.html || -n $newest ]]; then
  npm run --silent build -- --logLevel warn
  touch ../build/page/index.html
  echo "The page is in build/page."
fi
case "${1-}" in
  --test) npm run --silent test ;;
  --stories)
    [[ -x ${PASSO_CHROMIUM:-/usr/bin/chromium} ]] || lacking "There is no Chromium: apt-get install chromium." --stories
    npm run --silent stories -- ${2:+-t "$2"}
    ;;
esac
