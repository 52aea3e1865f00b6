// The interrupt that plays an event on the Uno. With the expander (uno_expander.cpp) it decides how fast the Uno steps.
// Cycles are in the margin; docs/boards.md has their sums.
#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"

namespace passo::chip {
namespace {

constexpr uint8_t toggle_port = 0x09;  // PIND

}  // namespace

extern "C" {

// No instruction of the plain way changes a flag, so only Z must be saved.
[[gnu::naked, gnu::used, gnu::section(".vectors")]] void step_interrupt() {
  asm volatile(
      R"(
      .rept 14                      ; the vectors before it
      jmp passo_reset
      .endr
                                    ; 4   to come here
      sbic %[pcifr], 0              ; 2   a machine's switch has moved: look before any step is made
      rjmp 5f
      sbic %[pcifr], 1              ; 2
      rjmp 5f
  .Lpasso_edge:
      out %[port], r5               ; 1   the edge
      out %[gpior0], r30            ; 1
      out %[gpior1], r31            ; 1
      lds r4, %[ucsra]              ; 2   a byte off the line does not wait for the main loop
      sbrc r4, 7                    ; 2
      rjmp 8f
  9:  movw r30, r2                  ; 1
      ld r4, Z+                     ; 2
      out %[ocra], r4               ; 1
      ld r4, Z+                     ; 2
      mov r2, r30                   ; 1   r3 stays: the ring is a page
      sbic %[eecr], %[padding]      ; 2
      rjmp 6f
  7:  in r30, %[gpior0]             ; 1
      in r31, %[gpior1]             ; 1
      out %[port], r5               ; 1   the end of the pulse, 18 cycles after its start or more
      mov r5, r4                    ; 1
      sbrc r5, %[special]           ; 2
      rjmp 2f
      reti                          ; 4   34 in all

  6:  in r31, %[sreg]               ; 11 more, and 3 for each further turn
      mov r30, r5
      andi r30, %[plain]
      breq .Lpasso_padded           ; a wait makes no pulse
      in r30, %[eedr]
  1:  dec r30
      brne 1b
  .Lpasso_padded:
      out %[sreg], r31
      rjmp 7b

  8:  lds r30, received_head        ; 12 more
      ldi r31, hi8(%[received])
      lds r4, %[udr]
      st Z+, r4
      sts received_head, r30
      rjmp 9b

      ; the entry just fetched is no plain event. Z is free again: what it held is still in the spare registers
  2:  in r4, %[sreg]
      sbrc r5, %[stop]
      rjmp 4f
      mov r30, r5                   ; pins of directions, long before the event that needs them
      andi r30, %[plain]
      mov r5, r30
      lds r30, turns_tail
      ldi r31, hi8(%[turns])
      ld r31, Z
      inc r30
      andi r30, lo8(%[turns] + %[turns_mask])
      sts turns_tail, r30
      mov r30, r31
      andi r30, %[turning]
      out %[port], r30
      andi r31, %[action]
      breq 7f
      mov r30, r31
  3:  ldi r31, hi8(%[turns])        ; outputs: 51 cycles after the event's edge they are switched
      push r24
      ld r24, Z+
      out %[port_b], r24
      ld r24, Z+
      out %[port_c], r24
      ld r24, Z+
      sts %[duty], r24
      ld r24, Z
      sts %[control], r24
      pop r24
  7:  out %[sreg], r4
      in r30, %[gpior0]
      in r31, %[gpior1]
      reti

      ; behind the last event
  4:  ldi r30, 0
      sts %[timsk], r30
      sts running, r30
      sts line_is_watched, r30
      lds r30, action_at_end
      and r30, r30
      breq 7b
      rjmp 3b

      ; a switch: flags first, pins then, so that no change is missed
  5:  push r24
      in r24, %[sreg]
      push r24
      push r25
      ldi r24, 3
      out %[pcifr], r24
      in r24, %[pinb]
      in r25, %[quiet_b]
      eor r24, r25
      lds r25, stops_b
      and r24, r25
      brne 8f
      in r24, %[pinc]
      in r25, %[quiet_c]
      eor r24, r25
      lds r25, stops_c
      and r24, r25
      brne 8f
  .Lpasso_watch:
      lds r25, armed
      and r25, r25
      breq 6f
      out %[gpior0], r30
      out %[gpior1], r31
      lds r30, watch_port
      ldi r31, 0
      ld r24, Z
      in r30, %[gpior0]
      in r31, %[gpior1]
      lds r25, watch_quiet
      eor r24, r25
      lds r25, watch_pins
      and r24, r25
      breq 6f
      sts watch_pins, r24           ; the first change counts, and these pins made it
      ldi r24, 0
      sts armed, r24
      sts captured_entry, r2
      sts captured_entry + 1, r3
  6:  pop r25
      pop r24
      out %[sreg], r24
      pop r24
      rjmp .Lpasso_edge
  8:  ldi r24, 1
      sts halted, r24
      lds r24, %[filter]
      and r24, r24
      brne .Lpasso_watch            ; the loop finds out whether the switch stays on
      sbi %[eecr], %[halted]
      sts %[timsk], r24
      sts running, r24
      sts line_is_watched, r24
      pop r25
      pop r24
      mov r4, r24
      pop r24
      out %[gpior0], r30
      out %[gpior1], r31
      ldi r30, %[safe]
      rjmp 3b
  )" ::[port] "n"(toggle_port),
      [pcifr] "n"(io(Pcifr::where)), [gpior0] "n"(io(Gpior0::where)), [gpior1] "n"(io(Gpior1::where)),
      [sreg] "n"(io(Sreg::where)), [ocra] "n"(io(Ocr0a::where)), [timsk] "n"(Timsk0::where), [pinb] "n"(0x03),
      [pinc] "n"(0x06), [quiet_b] "n"(io(Ocr0b::where)), [filter] "n"(Ocr2b::where), [quiet_c] "n"(io(Eearl::where)),
      [special] "n"(0), [padding] "n"(padding_bit), [halted] "n"(halted_bit), [eecr] "n"(io(Eecr::where)),
      [eedr] "n"(io(Eedr::where)), [stop] "n"(1), [plain] "n"(pins.steps_on('D')), [turns] "n"(turns_address),
      [turns_mask] "n"(turns_mask), [turning] "n"(turning_bits), [action] "n"(action_bits), [safe] "n"(safe_action),
      [port_b] "n"(0x05), [port_c] "n"(0x08), [duty] "n"(Ocr2a::where), [control] "n"(Tccr2a::where),
      [ucsra] "n"(Ucsr0a::where), [udr] "n"(Udr0::where), [received] "n"(received_address));
}
static_assert(pins.flag_special == 1 << 0 && pins.flag_stop == 1 << 1 && pins.step_ports[0] == 'D');
static_assert((received_address & 0xff) == 0, "the receiving ring's index is the low byte of its addresses");
}

}  // namespace passo::chip
