#!/usr/bin/env bash
# scripts/licences.sh [PROGRAM...]: the licences of all that is linked: a line for each Debian package whose library a
# program loads, or whose headers are compiled into it. Without PROGRAM: all that scripts/test.sh builds for users.
#
# The licence is the one that the package states in /usr/share/doc/PACKAGE/copyright for its files at large ("Files: *").
# Where the statement has no such part, it is every licence that is named there, those of tests and build files too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

compiled_in=(libcli11-dev nlohmann-json3-dev libboost1.74-dev)  # headers only
programs=("$@")
if (($# == 0)); then programs=(build/release/passo build/release/passo-emulate-avr); fi

package_of() {  # LIBRARY: dpkg may know the file by its name before or after /usr was merged
  local file
  file=$(readlink -f "$1")
  { dpkg -S "$file" 2>/dev/null || dpkg -S "${file#/usr}"; } | head -n 1 | cut -d: -f1
}
stated_by() {  # PACKAGE
  local file=/usr/share/doc/$1/copyright licences
  licences=$(awk -v RS= '/(^|\n)Files: *\*( *\n|$)/' "$file" | sed -n 's/^License: *//p' | sort -u | paste -sd, | sed 's/,/, /g')
  if [[ -z $licences ]]; then
    licences=$(grep -oE 'common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]|Mozilla Public License|GCC Runtime Library Exception|MIT|Permission to use, copy, modify' "$file" |
      sed 's|common-licenses/||; s/Mozilla Public License/MPL/; s/Permission to use.*/MIT or alike/' |
      sort -u | paste -sd, | sed 's/,/, /g')
  fi
  echo "${licences:-see $file}"
}
list() {  # PACKAGE...
  local package
  for package in "$@"; do
    printf '  %-24s %-28s %s\n' "$package" "$(dpkg-query -W -f '${Version}' "$package")" "$(stated_by "$package")"
  done
}

for program in "${programs[@]}"; do
  if [[ ! -x $program ]]; then
    echo "scripts/licences.sh: $program is not there; scripts/start.sh builds it" >&2
    exit 1
  fi
  echo "$program loads:"
  mapfile -t packages < <(ldd "$program" | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' |
    while read -r library; do package_of "$library"; done | sort -u)
  list "${packages[@]}"
done
echo "compiled in, as headers:"
list "${compiled_in[@]}"
