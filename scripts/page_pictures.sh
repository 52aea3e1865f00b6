#!/usr/bin/env bash
# scripts/page_pictures.sh FOLDER|--docs [PAGE,PAGE…]: pictures of the page of `passo serve`, in both themes and two sizes,
# by the real browser and the real daemon with its virtual machine. page-NAME.jpg has the four pictures of a page on one
# sheet. With --docs, those of docs/pictures are made anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if (($# < 1)); then
  sed -n '2,5s/^# \{0,1\}//p' scripts/page_pictures.sh
  exit 2
fi
folder=$(realpath -m "$([[ $1 == --docs ]] && echo build/page-pictures || echo "$1")")
scripts/page.sh
cd page
npx --no-install vite-node stories/pictures.ts "$folder" "${@:2}"
if [[ $1 == --docs ]]; then
  for one in ../docs/pictures/page-*; do
    [[ ! -e $folder/${one##*/} ]] || cp "$folder/${one##*/}" "$one"
  done
fi
