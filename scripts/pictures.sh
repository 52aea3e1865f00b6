#!/usr/bin/env bash
# scripts/pictures.sh: draws every picture of the documents anew, by the commands that stand beside them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --build build/release --target passo
grep -rhoE '^build/release/passo .*(--picture|-p) docs/pictures/[a-z0-9-]+\.(svg|png).*$' docs --include='*.md' | sort -u |
  while read -r command; do
    echo "+ $command"
    # The words of the commands have no quotes that need a shell.
    read -ra words <<<"$command"
    "${words[@]}" >/dev/null
  done
