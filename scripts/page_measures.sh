#!/usr/bin/env bash
# scripts/page_measures.sh [MOVES]: what the page of `passo serve` costs, by the real browser and the real daemon: the idle
# page's processor, how late a position is shown, and how soon a program of MOVES moves (1,000,000) is shown, with the
# browser's memory. Run it on a quiet computer: Chromium draws by the processor here.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [[ ${1-} == -* ]]; then
  sed -n '2,4s/^# \{0,1\}//p' scripts/page_measures.sh
  exit 2
fi
scripts/page.sh
cd page
npx --no-install vite-node stories/measures.ts "$@"
