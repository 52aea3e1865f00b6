#!/usr/bin/env bash
# scripts/package_needs.sh FILE.deb...: the packages that these ask for and recommend as libraries, a line for each.
set -euo pipefail
{
  for file in "$@"; do dpkg-deb --field "$file" Depends; done | tr ',' '\n' | sed 's/(.*//; s/|.*//; s/ //g' | grep -vxE 'passo|libpasso1'
  echo libmosquitto1
} | sort -u
