#!/usr/bin/env bash
# scripts/site.sh [--check|--test] [FOLDER]: builds the site into FOLDER/VERSION (build/site/1.0), a site of files that needs no
# server of its own.
#
#   --check   then checks all links, and that no page loads anything from another host
#   --test    the same, and then opens the pages in Chromium
#
# The site is the manual, by mkdocs-material, and the pages that need no server: each html file of page/ except index.html.
# The other versions in FOLDER stay, so that links to them stay valid; latest/ leads to the newest. Where something is
# missing, it says what and ends with 77, "skipped".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

check=
folder=build/site
for word in "$@"; do
  case "$word" in
    --check | --test) check=$word ;;
    -*)
      sed -n '2,11s/^# \{0,1\}//p' scripts/site.sh
      exit 2
      ;;
    *) folder=$word ;;
  esac
done
lacking() {
  echo "The site is not built: $1." >&2
  exit 77
}
command -v mkdocs >/dev/null || lacking "there is no mkdocs (apt-get install mkdocs-material python3-markdown-it)"
scripts/page.sh >/dev/null  # fetches what the pages need, and builds the modules
[[ -e page/node_modules/.passo-lock ]] || lacking "its pages could not be built"
# The module of "Check a program" is for the site alone.
[[ ! -e build/release/build.ninja ]] || cmake --build build/release --target check >/dev/null || lacking "check.wasm could not be built"
[[ -e ${PASSO_LAB_WASM:-build/release/src/study/lab/lab.wasm} ]] || lacking "the module of the Lab is missing (cmake --build build/release --target lab)"

version=$(sed -n 's/^project(passo VERSION \([0-9]*\.[0-9]*\).*/\1/p' CMakeLists.txt)
# All is made beside the site, and put there when it is whole.
mkdir -p "$folder"
folder=$(realpath "$folder")
work=$(mktemp -d "$folder/.work.XXXXXX")
trap 'rm -rf "$work"' EXIT
pages=$work/pages
mkdir "$pages"
for html in page/*.html; do
  name=$(basename "$html" .html)
  [[ $name == index ]] && continue
  (cd page && PASSO_SITE_PAGE=$name PASSO_SITE_OUT=$pages npx vite build --config vite.site.config.ts --logLevel warn)
done
PASSO_SITE_PAGES=$pages mkdocs build --quiet --strict --config-file site/mkdocs.yml --site-dir "$work/site"
# Without the address of the site these two have none to give.
rm -f "$work"/site/404.html "$work"/site/sitemap.xml*
cp -r "$pages"/. "$work/site/"
rm -rf "${folder:?}/$version"
mv "$work/site" "$folder/$version"
rm -rf "$work"
site/versions.py "$folder"
echo "The site is in ${folder#"$PWD/"}: python3 -m http.server -d ${folder#"$PWD/"} 8000, then http://127.0.0.1:8000"

[[ -n $check ]] && site/check_links.py "$folder"
if [[ $check == --test ]]; then
  [[ -x ${PASSO_CHROMIUM:-/usr/bin/chromium} ]] || lacking "there is no Chromium to open it"
  PASSO_SITE=$folder npm run --silent --prefix page stories -- site.test
fi
