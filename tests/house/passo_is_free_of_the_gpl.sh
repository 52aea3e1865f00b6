#!/usr/bin/env bash
# passo_is_free_of_the_gpl.sh PASSO: the program is linked with none of the emulators' libraries, which are under the GPL:
# neither with a shared one nor with a static one.
set -euo pipefail
program=$1
status=0
if ldd "$program" | grep -E 'simavr|gpsim'; then
  echo "$program is linked with a library under the GPL" >&2
  status=1
fi
# A static library leaves its messages.
if grep -qaE 'avr_core_watch|avr_cycle_timer|AVR_UART' "$program"; then
  echo "$program holds code of a library under the GPL" >&2
  status=1
fi
exit $status
