#!/usr/bin/env bash
# scripts/function_order.sh: which functions of `passo` lie side by side, for src/apps/function_order.ld: those that `cam board`
# calls for boards in Gerber, then what it calls for one of KiCad. They are found by valgrind. A list that is older than the
# program does no harm: a name that is gone is passed over, and a new function lies where the linker puts it
# (docs/decisions/0131).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/release
list=src/apps/function_order.ld
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

called() {  # COMMAND...: the functions of passo that it calls, as the linker names them
  valgrind --tool=callgrind --demangle=no --callgrind-out-file="$work/calls" "$build/passo" "$@" >/dev/null 2>"$work/said" ||
    { cat "$work/said" >&2 && exit 1; }
  # A name stands once beside its number: "fn=(12) name", or "cfn=(12) name" where it is called first.
  awk -v program="$(readlink -f "$build/passo")" '
    match($0, /^c?ob=\([0-9]+\)/) { key = substr($0, index($0, "("), index($0, ")") - index($0, "(") + 1)
      if (NF > 1) object[key] = $2
      if (/^ob/) ours = object[key] == program }
    match($0, /^c?fn=\([0-9]+\)/) { key = substr($0, index($0, "("), index($0, ")") - index($0, "(") + 1)
      if (NF > 1) name[key] = $2
      if (/^fn/ && ours) calls[key] = 1 }
    END { for (key in calls) print name[key] }' "$work/calls"
}

write_list() {  # reads the names
  echo "/* Written by scripts/function_order.sh. */"
  echo "SECTIONS"
  echo "{"
  echo "  .text.ordered : {"
  sed 's/.*/    *(.text.&)/'
  echo "  }"
  echo "}"
  echo "INSERT BEFORE .text;"
}

# Without an order: valgrind names functions in the section .text only.
write_list </dev/null >"$list"
cmake --build "$build" --parallel "$(nproc)" --target passo >/dev/null
boards=src/cam/tests/boards
{
  called cam board examples/boards -o "$work/timer"
  called cam board "$boards"/shapes-*.gbr "$boards"/shapes-*.drl -o "$work/gerber"
} | LC_ALL=C sort >"$work/all"
called cam board "$boards/shapes.kicad_pcb" -o "$work/kicad" | LC_ALL=C sort >>"$work/all"
# A constructor and a destructor have several names for one place: C1 and C2, D1 and D2. What has no name is passed over,
# and what runs at the start lies side by side anyway.
sed -E "s/'[0-9]+\$//; s/([CD])[12]E/\1?E/g" "$work/all" | grep -E '^[A-Za-z_][A-Za-z0-9_.$?]*$' | grep -v '^_GLOBAL_' |
  awk '!seen[$0]++' | write_list >"$list"
cmake --build "$build" --parallel "$(nproc)" --target passo >/dev/null
