// The two pieces that decide how fast the Uno steps: the interrupt that plays an event, and the expander that makes
// one. Cycles are in the margin; docs/boards.md has their sums.
#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"

namespace passo::chip {
namespace {

constexpr uint8_t toggle_port = 0x09;  // PIND
// A pulse takes 19 cycles without padding.
constexpr uint8_t padding = about.step_pulse - pulse_without_padding;
constexpr uint8_t io(uint16_t address) {
  return static_cast<uint8_t>(address - io_base);
}

}  // namespace

extern "C" {

// No instruction of the plain way changes a flag, so only Z must be saved.
[[gnu::naked, gnu::used, gnu::section(".vectors")]] void step_interrupt() {
  asm volatile(
      R"(
      .rept 11                      ; the vectors before it
      jmp passo_reset
      .endr
                                    ; 4   to come here
      sbic %[pcifr], 0              ; 2   a machine's switch has moved: look before any step is made
      rjmp 5f
      sbic %[pcifr], 1              ; 2
      rjmp 5f
  1:  out %[port], r5               ; 1   the edge
      out %[gpior0], r30            ; 1
      out %[gpior1], r31            ; 1
      movw r30, r2                  ; 1
      ld r4, Z+                     ; 2
      sts %[ocrah], r4              ; 2
      ld r4, Z+                     ; 2
      sts %[ocral], r4              ; 2
      ld r4, Z+                     ; 2
      ld r3, Z+                     ; 2   the page of the next entry
      mov r2, r30                   ; 1
      in r30, %[gpior0]             ; 1
      in r31, %[gpior1]             ; 1
      .rept %[padding]
      nop
      .endr
      out %[port], r5               ; 1   the end of the pulse, 19 cycles after its start
      mov r5, r4                    ; 1
      sbrc r5, %[special]           ; 2
      rjmp 2f
  9:  lds r4, %[ucsra]              ; 2   a byte off the line does not wait for the main loop
      sbrc r4, 7                    ; 2
      rjmp 8f
      reti                          ; 4

  8:  out %[gpior0], r30            ; 17 in all
      out %[gpior1], r31
      lds r30, received_head
      ldi r31, hi8(%[received])
      lds r4, %[udr]
      st Z+, r4
      sts received_head, r30
      in r30, %[gpior0]
      in r31, %[gpior1]
      reti

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
  3:  ldi r31, hi8(%[turns])        ; outputs: 54 cycles after the event's edge they are switched
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
      rjmp 9b

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
      ldi r24, 0                    ; the first change counts
      sts armed, r24
      sts captured_entry, r2
      sts captured_entry + 1, r3
  6:  pop r25
      pop r24
      out %[sreg], r24
      pop r24
      rjmp 1b
  8:  ldi r24, 0
      sts %[timsk], r24
      sts running, r24
      sts line_is_watched, r24
      ldi r24, 1
      sts halted, r24
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
      [sreg] "n"(io(Sreg::where)), [ocrah] "n"(Ocr1ah::where), [ocral] "n"(Ocr1al::where), [timsk] "n"(Timsk1::where),
      [pinb] "n"(0x03), [pinc] "n"(0x06), [quiet_b] "n"(io(Ocr0a::where)), [quiet_c] "n"(io(Ocr0b::where)),
      [special] "n"(1), [padding] "n"(padding), [stop] "n"(0),
      [plain] "n"(0xff & ~(pins.flag_special | pins.flag_stop)), [turns] "n"(turns_address),
      [turns_mask] "n"(turns_mask), [turning] "n"(turning_bits), [action] "n"(action_bits), [safe] "n"(safe_action),
      [port_b] "n"(0x05), [port_c] "n"(0x08), [duty] "n"(Ocr2a::where), [control] "n"(Tccr2a::where),
      [ucsra] "n"(Ucsr0a::where), [udr] "n"(Udr0::where), [received] "n"(received_address));
}
static_assert(pins.flag_special == 1 << 1 && pins.flag_stop == 1 << 0 && pins.step_ports[0] == 'D');

// Registers: r7:r6 r9:r8 r11:r10 accumulators, r13:r12 r15:r14 r17:r16 increments, r21…r18 time, r25…r22 interval, r29
// r28 r1 r0 change, X the entry, r30 the bits to toggle, r31 the flips. GPIOR2 has the number of events left.
asm(R"(
  .macro passo_motor low, high, low_increment, high_increment
      add \low, \low_increment      ; 1
      adc \high, \high_increment    ; 1
      rol r30                       ; 1   a carry is a step
  .endm
  .macro passo_event
      add r18, r22                  ; 4   time += interval
      adc r19, r23
      adc r20, r24
      adc r21, r25
      st X+, r21                    ; 4
      st X+, r20
      add r22, r0                   ; 4   interval += change
      adc r23, r1
      adc r24, r28
      adc r25, r29
      ldi r30, 0                    ; 1
      passo_motor r10, r11, r16, r17  ; 9
      passo_motor r8, r9, r14, r15
      passo_motor r6, r7, r12, r13
      lsl r30                       ; 2   to where their pins are
      lsl r30
      eor r30, r31                  ; 1
      st X+, r30                    ; 2
      adiw r26, 1                   ; 2
  .endm
)");

[[gnu::naked]] void expand(uint8_t /*events: in r24*/) {
  asm volatile(R"(
      push r6
      push r7
      push r8
      push r9
      push r10
      push r11
      push r12
      push r13
      push r14
      push r15
      push r16
      push r17
      push r28
      push r29
      out %[left], r24
      lds r6, expansion + 0
      lds r7, expansion + 1
      lds r8, expansion + 2
      lds r9, expansion + 3
      lds r10, expansion + 4
      lds r11, expansion + 5
      lds r12, expansion + 6
      lds r13, expansion + 7
      lds r14, expansion + 8
      lds r15, expansion + 9
      lds r16, expansion + 10
      lds r17, expansion + 11
      lds r18, expansion + 12
      lds r19, expansion + 13
      lds r20, expansion + 14
      lds r21, expansion + 15
      lds r22, expansion + 16
      lds r23, expansion + 17
      lds r24, expansion + 18
      lds r25, expansion + 19
      lds r0, expansion + 20
      lds r1, expansion + 21
      lds r28, expansion + 22
      lds r29, expansion + 23
      lds r31, expansion + 24
      lds r26, expansion + 25
      lds r27, expansion + 26

      ori r31, %[flags]             ; the first one
      passo_event
      andi r31, 0xff - %[flags]
      rjmp 2f
  1:  passo_event
  2:  in r30, %[left]               ; single ones until four at a time are left
      dec r30
      out %[left], r30
      brne 4f
      rjmp 5f
  4:  andi r30, 3
      brne 1b

  3:  passo_event
      passo_event
      passo_event
      passo_event
      in r30, %[left]               ; 1
      subi r30, 4                   ; 1
      out %[left], r30              ; 1
      breq 5f                       ; 1
      rjmp 3b                       ; 2

  5:  sts expansion, r6
      sts expansion + 1, r7
      sts expansion + 2, r8
      sts expansion + 3, r9
      sts expansion + 4, r10
      sts expansion + 5, r11
      sts expansion + 12, r18
      sts expansion + 13, r19
      sts expansion + 14, r20
      sts expansion + 15, r21
      sts expansion + 16, r22
      sts expansion + 17, r23
      sts expansion + 18, r24
      sts expansion + 19, r25
      sts expansion + 25, r26
      sts expansion + 26, r27
      clr r1
      pop r29
      pop r28
      pop r17
      pop r16
      pop r15
      pop r14
      pop r13
      pop r12
      pop r11
      pop r10
      pop r9
      pop r8
      pop r7
      pop r6
      ret
  )" ::[left] "n"(io(Gpior2::where)),
               [flags] "n"(pins.flag_special | pins.flag_stop));
}
static_assert(pins.motor[0].step.bit == 2 && pins.motor[1].step.bit == 3 && pins.motor[2].step.bit == 4,
              "the expander shifts the carries to these pins");
static_assert((received_address & 0xff) == 0, "the receiving ring's index is the low byte of its addresses");
}

}  // namespace passo::chip
