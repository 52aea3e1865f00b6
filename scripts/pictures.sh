#!/usr/bin/env bash
# scripts/pictures.sh: draws every picture of the documents anew, by the commands that stand beside them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --build build/release --target passo
# A command may go on in the next line after a backslash.
find docs -name '*.md' -exec sed -e ':join' -e '/\\$/{N;s/ *\\\n */ /;b join' -e '}' {} + |
  grep -oE '^build/release/passo .*(--picture|-p) docs/pictures/[a-z0-9-]+\.(svg|png).*$' | sort -u |
  while read -r command; do
    echo "+ $command"
    # The words of the commands have no quotes that need a shell.
    read -ra words <<<"$command"
    "${words[@]}" >/dev/null
  done
