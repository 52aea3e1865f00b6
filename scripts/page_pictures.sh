#!/usr/bin/env bash
# scripts/page_pictures.sh FOLDER [PAGE,PAGE…]: pictures of the page of `passo serve`, in both themes and two sizes, by the
# real browser and the real daemon with its virtual machine. page-NAME.jpg has the four pictures of a page on one sheet, as
# in docs/pictures.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if (($# < 1)); then
  sed -n '2,5s/^# \{0,1\}//p' scripts/page_pictures.sh
  exit 2
fi
folder=$(realpath -m "$1")
scripts/page.sh
cd page
npx --no-install vite-node stories/pictures.ts "$folder" "${@:2}"
