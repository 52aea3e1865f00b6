#!/usr/bin/env bash
# scripts/cncjs.sh [PASSO]: drives a virtual machine of `passo serve` by a real cncjs, headless (tests/cncjs/drive.js).
#
# PASSO is build/release/passo, if it is not given. What cncjs's server needs is fetched once, from npm, as
# tests/cncjs/package-lock.json names it; cncjs itself comes as its own package, checked by its hash, because installed
# the usual way it brings four times as much for its pages. It needs node 18 or later with npm. 77: something is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../tests/cncjs"
passo=${1:-../../build/release/passo}

version=1.11.5
hash=cfXTLjvSxWXn3eBOlFA7BvRl/p3ahj16RqK2V0RlT/T1WUFuaICIBOdDs267opUDEt+dR9aC7jmqhZD5QbJNaQ==
lacking() {
  echo "$1" >&2
  exit 77
}
command -v node npm openssl >/dev/null || lacking "cncjs does not run: there is no node, npm or openssl."
if ! cmp --silent package-lock.json node_modules/.passo-lock; then
  echo "+ npm ci in tests/cncjs"
  npm ci --ignore-scripts --no-audit --no-fund --silent || lacking "cncjs does not run: its parts could not be fetched."
  npm pack "cncjs@$version" --silent --pack-destination node_modules >/dev/null ||
    lacking "cncjs does not run: it could not be fetched."
  package=node_modules/cncjs-$version.tgz
  if [[ $(openssl dgst -sha512 -binary "$package" | base64 -w0) != "$hash" ]]; then
    echo "cncjs $version is not the package that it was." >&2
    exit 1
  fi
  mkdir node_modules/cncjs
  tar xzf "$package" -C node_modules/cncjs --strip-components=1
  rm "$package"
  cp package-lock.json node_modules/.passo-lock
fi

folder=$(mktemp -d)
daemon=
trap 'if [[ -n $daemon ]]; then kill "$daemon" && wait "$daemon" || true; fi; rm -rf "$folder"' EXIT
"$passo" serve --grbl-pty "$folder/tty" >"$folder/said" &
daemon=$!
for _ in {1..100}; do
  grep -q Ctrl-C "$folder/said" && break
  sleep 0.1
done
node drive.js "$folder/tty"
