// The two pieces that decide how fast the Mega steps: the interrupt that plays an event, and the expander that makes
// events. Like uno_events.cpp and uno_expander.cpp, but for four step ports. Cycles are in the margin; docs/boards.md
// has their sums.
#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"

namespace passo::chip {
namespace {

constexpr uint8_t toggle_f = 0x0f;  // the numbers of PINF, PINA, PINC for `out`
constexpr uint8_t toggle_a = 0x00;
constexpr uint8_t toggle_c = 0x06;
constexpr uint16_t toggle_l = 0x109;
constexpr uint8_t page(uint16_t address) {
  return static_cast<uint8_t>(address >> 8);
}

}  // namespace

extern "C" {

// No instruction of the plain way changes a flag, so only Z must be saved. All ports' bytes are loaded before the first
// is written. So the edges of one event come within four cycles, always in the same order.
[[gnu::naked, gnu::used, gnu::section(".vectors")]] void step_interrupt() {
  asm volatile(
      R"(
      .rept 17                      ; the vectors before it
      jmp passo_reset
      .endr
                                    ; 5   to come here
      out %[gpior0], r30            ; 1
      out %[gpior1], r31            ; 1
      in r30, %[pcifr]              ; 1   a machine's switch has moved: look before any step is made
      in r31, %[eifr]               ; 1
      cpse r30, r31                 ; 2   both are 0
      rjmp 5f
  .Lpasso_edge:
      mov r30, r2                   ; 1
      ldi r31, %[page_l]            ; 3
      ld r4, Z
      ldi r31, %[page_a]            ; 3
      ld r3, Z
      ldi r31, %[page_c]            ; 3   and on to the next entry
      ld r6, Z+
      sts %[port_l], r4             ; 2   the edges
      out %[port_f], r5             ; 1
      out %[port_a], r3             ; 1
      out %[port_c], r6             ; 1
      mov r2, r30                   ; 1
      ldi r31, %[page_high]         ; 5
      ld r31, Z
      sts %[ocrah], r31
      ldi r31, %[page_low]          ; 5
      ld r31, Z
      sts %[ocral], r31
      sbic %[eecr], %[padding]      ; 2
      rjmp 6f
  1:  sts %[port_l], r4             ; 2   the end of the pulse, 18 cycles after its start or more
      out %[port_f], r5             ; 1
      out %[port_a], r3             ; 1
      out %[port_c], r6             ; 1
      ldi r31, %[page_f]            ; 3
      ld r5, Z
      in r30, %[gpior0]             ; 1
      in r31, %[gpior1]             ; 1
      sbrc r5, %[special]           ; 2
      rjmp 2f
  3:  lds r3, %[ucsra]              ; 2   a byte off the line does not wait for the main loop
      sbrc r3, 7                    ; 2
      rjmp 8f
      reti                          ; 5   59 in all

  6:  in r31, %[sreg]               ; 9 more, and 3 for each further turn
      in r30, %[eedr]
  9:  dec r30
      brne 9b
      out %[sreg], r31
      mov r30, r2
      rjmp 1b

  8:  out %[gpior0], r30            ; 20 in all, and 12 for a second byte
      out %[gpior1], r31
      lds r30, received_head
  9:  ldi r31, hi8(%[received])
      lds r3, %[udr]
      st Z+, r3
      lds r3, %[ucsra]
      sbrc r3, 7
      rjmp 9b
      sts received_head, r30
      in r30, %[gpior0]
      in r31, %[gpior1]
      reti

      ; the entry just fetched is no plain event. Z is free again: what it held is still in the spare registers
  2:  in r3, %[sreg]
      sbrc r5, %[stop]
      rjmp 4f
      mov r30, r5                   ; pins of directions, long before the event that needs them
      andi r30, %[plain]
      mov r5, r30
      lds r30, turns_tail
      ldi r31, hi8(%[turns])
      ld r4, Z+
      ld r6, Z+
      sts %[port_l], r6
      ld r6, Z+
      out %[port_a], r6
      ld r6, Z+
      out %[port_c], r6
      andi r30, lo8(%[turns] + %[turns_mask])
      sts turns_tail, r30
      mov r30, r4
      andi r30, %[turning]
      out %[port_f], r30
      eor r30, r4
      breq 7f
  .Lpasso_act:
      ldi r31, hi8(%[turns])        ; outputs
      ld r4, Z+
      sts %[port_h], r4
      ld r4, Z+
      out %[port_b], r4
      ld r4, Z+
      sts %[duty], r4
      ld r4, Z
      sts %[control], r4
  7:  out %[sreg], r3
      in r30, %[gpior0]
      in r31, %[gpior1]
      rjmp 3b

      ; behind the last event
  4:  ldi r30, 0
      sts %[timsk], r30
      sts running, r30
      sts line_is_watched, r30
      lds r30, action_at_end
      and r30, r30
      breq 7b
      rjmp .Lpasso_act

      ; a switch: flags first, pins then, so that no change is missed
  5:  push r24
      in r24, %[sreg]
      push r24
      push r25
      ldi r24, 0xff
      out %[pcifr], r24
      out %[eifr], r24
      in r24, %[pind]
      lds r25, quiet_d
      eor r24, r25
      lds r25, stops_d
      and r24, r25
      brne 8f
      in r24, %[pine]
      lds r25, quiet_e
      eor r24, r25
      lds r25, stops_e
      and r24, r25
      brne 8f
      lds r24, %[pinj]
      lds r25, quiet_j
      eor r24, r25
      lds r25, stops_j
      and r24, r25
      brne 8f
      in r24, %[pinb]
      lds r25, quiet_b
      eor r24, r25
      lds r25, stops_b
      and r24, r25
      brne 8f
  .Lpasso_watch:
      lds r25, armed
      and r25, r25
      breq 6f
      lds r30, watch_port
      lds r31, watch_port + 1
      ld r24, Z
      lds r25, watch_quiet
      eor r24, r25
      lds r25, watch_pins
      and r24, r25
      breq 6f
      sts watch_pins, r24           ; the first change counts, and these pins made it
      ldi r24, 0
      sts armed, r24
      sts captured_entry, r2
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
      sts %[timsk], r24
      sts running, r24
      sts line_is_watched, r24
      pop r25
      pop r24
      mov r3, r24
      pop r24
      ldi r30, %[safe]
      rjmp .Lpasso_act
  )" ::[port_f] "n"(toggle_f),
      [port_a] "n"(toggle_a), [port_c] "n"(toggle_c), [port_l] "n"(toggle_l), [pcifr] "n"(io(Pcifr::where)),
      [eifr] "n"(io(Eifr::where)), [gpior0] "n"(io(Gpior0::where)), [gpior1] "n"(io(Gpior1::where)),
      [sreg] "n"(io(Sreg::where)), [ocrah] "n"(Ocr1ah::where), [ocral] "n"(Ocr1al::where), [timsk] "n"(Timsk1::where),
      [filter] "n"(Ocr2b::where), [pinb] "n"(0x03), [pind] "n"(0x09), [pine] "n"(0x0c), [pinj] "n"(0x103),
      [special] "n"(4), [stop] "n"(3), [padding] "n"(padding_bit), [eecr] "n"(io(Eecr::where)),
      [eedr] "n"(io(Eedr::where)), [plain] "n"(0xff & ~(pins.flag_special | pins.flag_stop)),
      [turns] "n"(turns_address), [turns_mask] "n"(turns_mask), [turning] "n"(turning_bits), [safe] "n"(safe_action),
      [port_h] "n"(0x102), [port_b] "n"(0x05), [duty] "n"(Ocr4cl::where), [control] "n"(Tccr4a::where),
      [ucsra] "n"(Ucsr0a::where), [udr] "n"(Udr0::where), [received] "n"(received_address),
      [page_high] "n"(page(times_high_address)), [page_low] "n"(page(times_low_address)),
      [page_f] "n"(page(first_toggles_address)), [page_l] "n"(page(first_toggles_address + 0x100)),
      [page_a] "n"(page(first_toggles_address + 0x200)), [page_c] "n"(page(first_toggles_address + 0x300)));
}
static_assert(pins.flag_special == 1 << 4 && pins.flag_stop == 1 << 3);
static_assert(pins.step_ports[0] == 'F' && pins.step_ports[1] == 'L' && pins.step_ports[2] == 'A' &&
              pins.step_ports[3] == 'C');

// The registers cannot hold all that six motors need. So events are made in passes, one for the times and one for each
// step port, each along its own page of the ring.
//
// In a pass X is the next byte, r30 the flips, and r28 how many are left of r29.
asm(R"(
  .macro passo_all event            ; single ones until four at a time are left
      rjmp 2f
  1:  \event
      dec r28
  2:  sbrc r28, 0
      rjmp 1b
      sbrc r28, 1
      rjmp 1b
      tst r28
      breq 4f
  3:  \event
      \event
      \event
      \event
      subi r28, 4                   ; 1
      brne 3b                       ; 2
  4:
  .endm
  .macro passo_time
      add r18, r22                  ; 4   time += interval
      adc r19, r23
      adc r20, r24
      adc r21, r25
      st X+, r21                    ; 4
      st Z+, r20
      add r22, r0                   ; 4   interval += change
      adc r23, r1
      adc r24, r16
      adc r25, r17
  .endm
  .macro passo_motor low, high, low_increment, high_increment, pin
      add \low, \low_increment      ; 1
      adc \high, \high_increment    ; 1
      brcc .Lpasso\@                ; 2   a carry is a step; the same either way
      eor r0, \pin
  .Lpasso\@:
  .endm
  .macro passo_two_motors
      mov r0, r30                   ; 1
      passo_motor r18, r19, r22, r23, r31
      passo_motor r20, r21, r24, r25, r16
      st X+, r0                     ; 2   11 in all
  .endm
  .macro passo_one_motor
      mov r0, r30                   ; 1
      passo_motor r18, r19, r22, r23, r31
      st X+, r0                     ; 2   7 in all
  .endm
  .macro passo_get low, high, low_increment, high_increment, motor
      lds \low, expansion + 2 * \motor
      lds \high, expansion + 2 * \motor + 1
      lds \low_increment, expansion + 12 + 2 * \motor
      lds \high_increment, expansion + 12 + 2 * \motor + 1
  .endm
  .macro passo_put low, high, motor
      sts expansion + 2 * \motor, \low
      sts expansion + 2 * \motor + 1, \high
  .endm
  .macro passo_breathe              ; at low rates nobody else looks at the line
      lds r24, 0xc0
      sbrc r24, 7
      call passo_fetch
  .endm
  .macro passo_port number, page
      lds r30, expansion + 36 + \number
      lds r26, expansion + 40
      ldi r27, \page
      mov r28, r29
  .endm
)");

[[gnu::naked]] void expand(uint8_t /*events: in r24*/) {
  asm volatile(R"(
      push r16
      push r17
      push r28
      push r29
      mov r29, r24

      lds r18, expansion + 24
      lds r19, expansion + 25
      lds r20, expansion + 26
      lds r21, expansion + 27
      lds r22, expansion + 28
      lds r23, expansion + 29
      lds r24, expansion + 30
      lds r25, expansion + 31
      lds r0, expansion + 32
      lds r1, expansion + 33
      lds r16, expansion + 34
      lds r17, expansion + 35
      passo_port 0, %[page_high]
      mov r30, r26
      ldi r31, %[page_low]
      passo_all passo_time
      sts expansion + 24, r18
      sts expansion + 25, r19
      sts expansion + 26, r20
      sts expansion + 27, r21
      sts expansion + 28, r22
      sts expansion + 29, r23
      sts expansion + 30, r24
      sts expansion + 31, r25

      passo_breathe
      passo_get r18, r19, r22, r23, 2   ; port L
      ldi r31, %[pin2]
      passo_port 1, %[page_f] + 1
      lds r24, expansion + 42
      cpi r24, 6
      brsh 5f
      rjmp 6f
  5:
      passo_get r20, r21, r24, r25, 5
      ldi r16, %[pin5]
      passo_all passo_two_motors
      passo_put r20, r21, 5
      rjmp 7f
  6:  passo_all passo_one_motor
  7:  passo_put r18, r19, 2

      passo_breathe
      lds r24, expansion + 42           ; port C
      cpi r24, 5
      brsh 5f
      rjmp 8f
  5:
      passo_get r18, r19, r22, r23, 4
      ldi r31, %[pin4]
      passo_port 3, %[page_f] + 3
      passo_all passo_one_motor
      passo_put r18, r19, 4

  8:  passo_breathe
      lds r24, expansion + 42           ; port A
      cpi r24, 4
      brsh 5f
      rjmp 9f
  5:
      passo_get r18, r19, r22, r23, 3
      ldi r31, %[pin3]
      passo_port 2, %[page_f] + 2
      passo_all passo_one_motor
      passo_put r18, r19, 3

  9:  passo_breathe
      passo_get r18, r19, r22, r23, 0   ; port F: the first event keeps its flags
      passo_get r20, r21, r24, r25, 1
      ldi r31, %[pin0]
      ldi r16, %[pin1]
      passo_port 0, %[page_f]
      ori r30, %[flags]
      passo_two_motors
      andi r30, 0xff - %[flags]
      dec r28
      passo_all passo_two_motors
      passo_put r18, r19, 0
      passo_put r20, r21, 1

      clr r1
      pop r29
      pop r28
      pop r17
      pop r16
      ret
  )" ::[flags] "n"(pins.flag_special | pins.flag_stop),
               [page_high] "n"(page(times_high_address)), [page_low] "n"(page(times_low_address)),
               [page_f] "n"(page(first_toggles_address)), [pin0] "n"(pins.motor[0].step.mask()),
               [pin1] "n"(pins.motor[1].step.mask()), [pin2] "n"(pins.motor[2].step.mask()),
               [pin3] "n"(pins.motor[3].step.mask()), [pin4] "n"(pins.motor[4].step.mask()),
               [pin5] "n"(pins.motor[5].step.mask()));
}
static_assert(pins.motor[0].step.port == 'F' && pins.motor[1].step.port == 'F' && pins.motor[2].step.port == 'L' &&
                  pins.motor[3].step.port == 'A' && pins.motor[4].step.port == 'C' && pins.motor[5].step.port == 'L',
              "the expander makes each port's byte out of these motors");
static_assert(((received_address | times_high_address | times_low_address | first_toggles_address) & 0xff) == 0,
              "an entry's number is the low byte of its addresses");
static_assert(sizeof(Expansion) == 43 && Ucsr0a::where == 0xc0);
}

}  // namespace passo::chip
