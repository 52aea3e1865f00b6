#!/usr/bin/env bash
# scripts/put_tables.sh DOCUMENT FOLDER: puts each file NAME of FOLDER into the document, between its marks <!-- NAME -->
# and <!-- end of NAME -->, in the place of what is there. For the scripts that measure tables.
set -euo pipefail
if (($# != 2)) || [[ $1 == -* ]]; then
  sed -n '2,3s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 2
fi

new=$(mktemp)
trap 'rm -f "$new"' EXIT
awk -v folder="$2" '
  /^<!-- end of .* -->$/ { skipping = 0 }
  !skipping { print }
  /^<!-- [a-z0-9-]+ -->$/ {
    file = folder "/" $2
    for (found = getline line < file; found > 0; found = getline line < file) {
      skipping = 1
      print line
    }
    close(file)
  }' "$1" >"$new"
cat "$new" >"$1"
