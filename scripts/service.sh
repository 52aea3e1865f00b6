#!/bin/sh
# Checks the unit for systemd, examples/passo.service: how much of the computer a daemon that goes wrong could reach, as
# systemd judges it, and that it still reaches serial ports, the network and its folder.
# Exit code 77: systemd-analyze is not there, or is too old to judge a file.
set -eu
cd "$(dirname "$0")/.."
unit=examples/passo.service
most=29 # tenths: under 3.0

for line in 'DeviceAllow=char-ttyUSB rw' 'DeviceAllow=char-ttyACM rw' 'StateDirectory=passo' 'SupplementaryGroups=dialout' \
  'RestrictAddressFamilies=AF_INET AF_INET6 AF_UNIX'; do
  grep -qxF "$line" "$unit" || {
    echo "$unit has no line $line" >&2
    exit 1
  }
done
command -v systemd-analyze >/dev/null || {
  echo "systemd-analyze is not there." >&2
  exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$unit" "$folder/passo.service"
systemd-analyze --help | grep -q -- --offline || {
  echo "This systemd-analyze judges no file." >&2
  exit 77
}
systemd-analyze security --no-pager --offline=true --threshold="$most" "$folder/passo.service" >"$folder/said" 2>&1 || {
  cat "$folder/said" >&2
  exit 1
}
tail -n 1 "$folder/said"
