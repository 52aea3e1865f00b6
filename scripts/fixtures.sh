#!/usr/bin/env bash
# scripts/fixtures.sh: fetches circuit boards of other layout programs, which tests read: npm's @tracespace/fixtures,
# 0.9 MB, MIT. They lie in build/fixtures, no part of the repository; without them those tests are skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

name=@tracespace/fixtures@4.2.7
sum=3ecf54bd4f415137dbf2acf6a71d6ae4652fa9e1672d6260155e0cc94aedd67d
folder=build/fixtures
[[ -f $folder/.$sum ]] && exit 0

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
npm pack --silent --pack-destination "$scratch" "$name" >/dev/null
archive=$(echo "$scratch"/*.tgz)
if [[ $(sha256sum "$archive" | cut -d' ' -f1) != "$sum" ]]; then
  echo "scripts/fixtures.sh: $name is not what it was: its sum is $(sha256sum "$archive" | cut -d' ' -f1)" >&2
  exit 1
fi
rm -rf "$folder"
mkdir -p "$folder"
tar -xzf "$archive" -C "$folder" --strip-components=1
touch "$folder/.$sum"
echo "$folder: $(find "$folder" -type f | wc -l) files of $name"
