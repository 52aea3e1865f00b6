#!/usr/bin/env bash
# check_program.sh ELF OBJDUMP RAM_START RAM FLASH LAST: is the firmware for the chip what it promises to be? Told by its machine code.
#
#   registers   r2 to rLAST are the interrupt's. Elsewhere they are only read for the main loop (`movw X, r2`, `mov X, r2`) or
#               set while the interrupt is off (`movw r2, X`, `mov r2, X`, `mov r5, X`); a compiler that had taken them would save them first (`push r2`). LAST may be `none`
#   library     nothing that divides or computes in floating point
#   memory      variables, what lies before them, and 184 bytes of stack fit into RAM (168 is the deepest way through the calls; board_test.cpp looks); a quarter of the flash is left
set -euo pipefail
elf=$1 objdump=$2 ram_start=$3 ram=$4 flash=$5 last=$6

code=$("$objdump" -d "$elf")
[[ $last = none ]] || awk -v last="$last" '
  /^[0-9a-f]+ <.*>:$/ { name = $2 }
  $0 ~ "[ \t,]r[2-" last "]([^0-9]|$)" && name !~ /step_interrupt/ {
    line = $0
    sub(/^[^\t]*\t[^\t]*\t/, "", line)
    sub(/[ \t]*;.*/, "", line)
    if (line ~ /^movw\tr(1[0-9]|2[0-9]|30), r2$/ || line ~ /^movw\tr2, r/ || line ~ /^mov\tr[25], r/ || line ~ /^mov\tr(1[0-9]|2[0-9]|30), r2$/) next
    if (name ~ /ctors|dtors|progmem/) next
    print "check_program: " name " uses a register of the interrupt: " line
    bad = 1
  }
  END { exit bad }' <<<"$code"

if grep -E '<__(u?div|u?mod|add[sd]f|sub[sd]f|mul[sd]f|div[sd]f|fix|float)[a-z0-9]*>:' <<<"$code"; then
  echo "check_program: division or floating point was linked in"
  exit 1
fi
text=$(( $("$objdump" -h "$elf" | awk '$2 == ".text" { print "0x" $3 }') ))
data=$(( $("$objdump" -h "$elf" | awk '$2 == ".data" { print "0x" $3 }') ))
bss=$(( $("$objdump" -h "$elf" | awk '$2 == ".bss" { print "0x" $3 }') ))
data_at=$(( $("$objdump" -h "$elf" | awk '$2 == ".data" { print "0x" $4 }') - 0x800000 ))
used=$((data_at - ram_start + data + bss))
echo "flash: $((text + data)) of $flash bytes. RAM: $used of $ram bytes ($((data_at - ram_start)) of them the rings), $((ram - used)) left for the stack"
((text + data <= flash * 3 / 4)) || { echo "check_program: too little flash is left"; exit 1; }
((ram - used >= 184)) || { echo "check_program: too little stack is left"; exit 1; }
