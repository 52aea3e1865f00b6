#!/usr/bin/env bash
# scripts/corpora.sh FOLDER...: reads every drawing (SVG, DXF), body (STL) and picture (PNG, TIFF) below the folders, as
# passo cam profile --side on and passo cam relief do. Each is read, or refused with a reason: an error with a code. It
# prints how many of each kind, the reasons, and what was neither; then the exit code is 1.
#
# Corpora that others have made, with what fetches them:
#   apt-get download librsvg2-tests librecad-data; dpkg -x librsvg2-tests*.deb rsvg; dpkg -x librecad-data*.deb librecad
#   npm pack stl-models; tar -xzf stl-models-*.tgz      (some of its models are broken on purpose)
set -euo pipefail
passo=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../build/release/passo
if (($# == 0)) || [[ $1 == -* ]]; then
  sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 2
fi
if [[ ! -x $passo ]]; then
  echo "scripts/corpora.sh: $passo is not there; scripts/start.sh builds it" >&2
  exit 1
fi
for folder in "$@"; do
  [[ -e $folder ]] || { echo "scripts/corpora.sh: there is no $folder" >&2; exit 2; }
done

new=$(mktemp -d)
trap 'rm -rf "$new"' EXIT
seconds=60  # for a file
declare -A read=() refused=() neither=()
shopt -s nocasematch
while IFS= read -r -d '' file; do
  kind=${file##*.}
  kind=${kind^^}
  case $kind in
    SVG | DXF) command=(cam profile --side on "$file") ;;
    STL) command=(cam relief "$file" --pitch 1) ;;
    PNG | TIF | TIFF) command=(cam relief "$file" --pitch 1) ;;
  esac
  code=0
  timeout "$seconds" "$passo" "${command[@]}" -o "$new/program.ngc" >/dev/null 2>"$new/errors" || code=$?
  if ((code == 0)); then
    read[$kind]=$((${read[$kind]-0} + 1))
  elif ((code == 2)) && grep -qE 'error: .*\[[a-z0-9.-]+\]$' "$new/errors"; then
    refused[$kind]=$((${refused[$kind]-0} + 1))
    grep -m 1 -oE '\[[a-z0-9.-]+\]$' "$new/errors" >>"$new/reasons.$kind"
  else
    neither[$kind]=$((${neither[$kind]-0} + 1))
    echo "neither read nor refused with a reason (exit code $code): $file" >&2
    head -n 3 "$new/errors" >&2
  fi
done < <(find "$@" -type f \( -iname '*.svg' -o -iname '*.dxf' -o -iname '*.stl' -o -iname '*.png' -o -iname '*.tif' \
  -o -iname '*.tiff' -o -iname '*.jpg' -o -iname '*.jpeg' -o -iname '*.3mf' \) -print0 | sort -z)

for kind in SVG DXF STL 3MF PNG JPG JPEG TIF TIFF; do
  all=$((${read[$kind]-0} + ${refused[$kind]-0} + ${neither[$kind]-0}))
  ((all > 0)) || continue
  echo "$kind: $all files, ${read[$kind]-0} read, ${refused[$kind]-0} refused with a reason, ${neither[$kind]-0} neither"
  [[ ! -e $new/reasons.$kind ]] || sort "$new/reasons.$kind" | uniq -c | sort -rn
done
((${#neither[@]} == 0))
