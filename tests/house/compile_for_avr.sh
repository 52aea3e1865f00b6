#!/usr/bin/env bash
# compile_for_avr.sh CLANG [-Iinclude...] SOURCE...: do the sources compile for an AVR, with nothing but the compiler's
# own headers? Exit code 77, "skipped", where there is no such compiler.
set -euo pipefail

clang=$1
shift
flags=(--target=avr -mmcu=atmega328p -std=c++20 -ffreestanding -fno-exceptions -fno-rtti -fsyntax-only
  -Wall -Wextra -Werror -Wno-avr-rtlib-linking-quirks)

knows_avr() {
  headers="$("$clang" -print-resource-dir)/include" &&
    echo '#include <stdint.h>' | "$clang" "${flags[@]}" -nostdinc -isystem "$headers" -x c++ -
}
if ! knows_avr 2>/dev/null; then
  echo "skipped: no clang++ that knows the AVR"
  exit 77
fi

includes=()
sources=()
for argument in "$@"; do
  case $argument in
    -I*) includes+=("$argument") ;;
    *) sources+=("$argument") ;;
  esac
done
for source in "${sources[@]}"; do
  "$clang" "${flags[@]}" -nostdinc -isystem "$headers" "${includes[@]}" "$source"
done
echo "${#sources[@]} portable files compile for the AVR"
