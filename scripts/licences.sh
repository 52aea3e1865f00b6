#!/usr/bin/env bash
# scripts/licences.sh [PROGRAM...]: the licences of all that is linked: a line for each Debian package whose library a
# program loads at its start or later, or whose headers are compiled into it. Without PROGRAM: all that scripts/test.sh
# builds for users.
#
# The licence is the one that the package states in /usr/share/doc/PACKAGE/copyright for its files at large ("Files: *").
# Where the statement has no such part, it is every licence that is named there, those of tests and build files too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

boost=$(dpkg-query -W -f '${Package}\n' 'libboost*-dev' 2>/dev/null | grep -E '^libboost[0-9.]+-dev$' | tail -n 1)
compiled_in=(libcli11-dev nlohmann-json3-dev "${boost:-libboost-dev}")  # headers only
# By what needs them, not at the start: docs/decisions/0128
loaded_late=(libmosquitto.so.1 libcairo.so.2 libfreetype.so.6 libharfbuzz.so.0 libsqlite3.so.0)
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
libraries_of() {  # PROGRAM or library: those that it loads at its start, and theirs
  ldd "$1" | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p'
}
late_libraries_of() {  # PROGRAM: those that it opens later, and theirs
  local name library
  for name in "${loaded_late[@]}"; do
    grep -qaF "$name" "$1" || continue
    library=$(/sbin/ldconfig -p | awk -v name="$name" '$1 == name { print $NF; exit }')
    [[ -z $library ]] || { echo "$library"; libraries_of "$library"; }
  done
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
  mapfile -t packages < <({ libraries_of "$program"; late_libraries_of "$program"; } | sort -u |
    while read -r library; do package_of "$library"; done | sort -u)
  list "${packages[@]}"
done
echo "compiled in, as headers:"
list "${compiled_in[@]}"
