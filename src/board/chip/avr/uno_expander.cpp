// The expander, which makes the Uno's events of a segment: by themselves, with a wait before some of them, or with any
// number of waits. Cycles are in the margin; docs/boards.md has their sums.
#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"

namespace passo::chip {

extern "C" {

// Registers: r7:r6 r9:r8 r11:r10 accumulators, r13:r12 r15:r14 r17:r16 increments, r21…r18 time, r25…r22 interval, r29
// r28 r1 r0 change, X the entry, r30 the bits to toggle, r31 the flips. GPIOR2 has the number of events left.
asm(R"(
  .macro passo_motor low, high, low_increment, high_increment
      add \low, \low_increment      ; 1
      adc \high, \high_increment    ; 1
      rol r30                       ; 1   a carry is a step
  .endm
  .macro passo_motors
      ldi r30, 0                    ; 1
      passo_motor r10, r11, r16, r17  ; 9
      passo_motor r8, r9, r14, r15
      passo_motor r6, r7, r12, r13
      lsl r30                       ; 2   to where their pins are
      lsl r30
  .endm
  .macro passo_event
      add r18, r22                  ; 4   time += interval
      adc r19, r23
      adc r20, r24
      adc r21, r25
      st X+, r20                    ; 2
      add r22, r0                   ; 3   interval += change; both have 24 bits here
      adc r23, r1
      adc r24, r28
      passo_motors                  ; 12
      eor r30, r31                  ; 1
      st X+, r30                    ; 2
      ldi r27, 0x01                 ; 1   the ring is a page
  .endm
)");

// What all three begin with: it keeps the caller's registers and loads the segment. `rcall passo_begin` comes back by
// Z, because the stack has changed.
[[gnu::naked, gnu::used]] void begin_expanding() asm("passo_begin");
void begin_expanding() {
  asm volatile(R"(
      pop r31
      pop r30
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
      lds r26, expansion + 25
      lds r27, expansion + 26
      ijmp
  )");
}

// Saves received bytes: the interrupt does not come any more.
[[gnu::naked, gnu::used]] void read_line_in_its_place() asm("passo_read_line");
void read_line_in_its_place() {
  asm volatile(R"(
      push r24
      push r30
      push r31
  1:
  )" PASSO_TAKE_BYTE R"(
  2:  pop r31
      pop r30
      pop r24
      ret
  )" ::[ucsra] "n"(Ucsr0a::where),
               [udr] "n"(Udr0::where), [received] "n"(received_address));
}

// And what they end with: it keeps the segment, and returns r30 to the caller.
[[gnu::naked, gnu::used]] void end_expanding() asm("passo_end");
void end_expanding() {
  asm volatile(R"(
      sbic %[eecr], %[halted]
      rcall passo_read_line
      sts expansion, r6
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
      mov r24, r30
      ret
  )" ::[eecr] "n"(io(Eecr::where)),
               [halted] "n"(halted_bit));
}

[[gnu::naked]] void expand(uint8_t /*events: in r24*/) {
  asm volatile(R"(
      out %[left], r24
      rcall passo_begin
      lds r0, expansion + 20
      lds r1, expansion + 21
      lds r28, expansion + 22
      lds r31, expansion + 24

      ori r31, %[flags]
  1:  passo_event
      andi r31, 0xff - %[flags]     ; it was the first one
      in r30, %[left]               ; single ones until four at a time are left
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
      sbis %[eecr], %[halted]       ; 1
      rjmp 3b                       ; 2
      rcall passo_read_line
      rjmp 3b

  5:  rjmp passo_end
  )" ::[left] "n"(io(Gpior2::where)),
               [eecr] "n"(io(Eecr::where)), [halted] "n"(halted_bit), [flags] "n"(pins.flag_special | pins.flag_stop));
}

// All intervals are under 512 ticks: at most one wait comes before an event.
[[gnu::naked]] uint8_t expand_with_waits(uint8_t /*events: in r24*/) {
  asm volatile(R"(
      .macro passo_next             ; time += interval
      mov r30, r20                  ; 1
      add r18, r22                  ; 4
      adc r19, r23
      adc r20, r24
      adc r21, r25
      .endm
      .macro passo_one_wait flagged
      sbrs r24, 7                   ; 2   after 128 ticks, or after 256: the same low byte again
      subi r30, 128
      st X+, r30                    ; 2
      ldi r30, \flagged             ; 1
      st X+, r30                    ; 2
      ldi r27, 0x01                 ; 1
      .endm
      .macro passo_other_event
      st X+, r20                    ; 2
      add r22, r0                   ; 4   interval += change
      adc r23, r1
      adc r24, r28
      adc r25, r29
      passo_motors                  ; 12
      eor r30, r31                  ; 1
      st X+, r30                    ; 2
      ldi r27, 0x01                 ; 1
      .endm

      out %[left], r24
      rcall passo_begin
      lds r0, expansion + 20
      lds r1, expansion + 21
      lds r28, expansion + 22
      lds r29, expansion + 23
      lds r31, expansion + 24

      passo_next
      sbrs r25, 0
      rjmp 1f
      passo_one_wait %[first_waits]
      rjmp 3f
  1:  ori r31, %[flags]
      rjmp 3f

  2:  passo_next
      sbrs r25, 0                   ; 2
      rjmp 3f
      passo_one_wait %[wait]
  3:  passo_other_event
      andi r31, 0xff - %[flags]     ; 1   it was the first one
      in r30, %[left]               ; 1
      dec r30                       ; 1
      out %[left], r30              ; 1
      breq 5f                       ; 1
      sbis %[eecr], %[halted]       ; 1
      rjmp 2b                       ; 2   47 in all with a wait
      rcall passo_read_line
      rjmp 2b

  5:  mov r30, r26
      rjmp passo_end
  )" ::[left] "n"(io(Gpior2::where)),
               [eecr] "n"(io(Eecr::where)), [halted] "n"(halted_bit), [flags] "n"(pins.flag_special | pins.flag_stop),
               [wait] "n"(pins.flag_stop), [first_waits] "n"(first_waits | pins.flag_special | pins.flag_stop));
}

// Here r0 has the byte of a wait, r28 the low byte of the last entry's time, r29 what the first entry has beside its
// toggles, and r31:r30 the ticks to the event, less 129, while it is waited for.
[[gnu::naked]] uint8_t expand_slowly(uint8_t /*entries: in r24*/) {
  asm volatile(R"(
      .macro passo_wait
      st X+, r28
      mov r1, r0
      or r1, r29
      st X+, r1
      ldi r27, 0x01
      clr r29
      in r1, %[left]
      dec r1
      out %[left], r1
      .endm

      out %[left], r24
      rcall passo_begin
      ldi r29, %[wait]
      mov r0, r29
      ldi r29, %[first_waits]
      lds r28, expansion + 32
      lds r30, expansion + 30
      lds r31, expansion + 31
      tst r31
      breq 1f
      lds r31, expansion + 29       ; amid a wait
      rjmp 4f

  1:  mov r28, r20
      mov r30, r21
      add r18, r22                  ; time += interval
      adc r19, r23
      adc r20, r24
      adc r21, r25
      mov r31, r21
      mov r1, r20
      sub r1, r28
      sbc r31, r30
      mov r30, r1
      subi r30, 129
      sbci r31, 0
      brcc 4f
      sbrc r30, 7                   ; 65,536 ticks look like none
      rjmp 6f                       ; 128 at most

  4:  sbic %[eecr], %[halted]
      rcall passo_read_line
      tst r31
      breq 5f
      dec r31
      passo_wait                    ; 256 ticks: the same low byte again
      brne 4b
      rjmp 8f
  5:  sbrs r30, 7
      rjmp 6f
      subi r30, 128                 ; the last two share what is left
      subi r28, 128
      passo_wait
      breq 8f

  6:  st X+, r20
      lds r1, expansion + 20        ; interval += change
      add r22, r1
      lds r1, expansion + 21
      adc r23, r1
      lds r1, expansion + 22
      adc r24, r1
      lds r1, expansion + 23
      adc r25, r1
      passo_motors
      lds r31, expansion + 24
      eor r30, r31
      andi r29, %[flags]
      or r30, r29
      st X+, r30
      ldi r27, 0x01
      clr r29
      in r1, %[left]
      dec r1
      out %[left], r1
      lds r31, expansion + 28
      dec r31
      sts expansion + 28, r31
      breq 7f
      and r1, r1
      breq 7f
      rjmp 1b

  7:  sts expansion + 31, r29
      rjmp 9f
  8:  sts expansion + 29, r31
      sts expansion + 30, r30
      sts expansion + 32, r28
      ldi r29, 1
      sts expansion + 31, r29
  9:  in r30, %[left]
      rjmp passo_end
  )" ::[left] "n"(io(Gpior2::where)),
               [eecr] "n"(io(Eecr::where)), [halted] "n"(halted_bit), [flags] "n"(pins.flag_special | pins.flag_stop),
               [wait] "n"(pins.flag_stop), [first_waits] "n"(first_waits | pins.flag_special | pins.flag_stop));
}
static_assert(sizeof(Expansion) == 33 && ring_address == 0x100 && ring_entries * sizeof(EventEntry) == 0x100);
static_assert(pins.motor[0].step.bit == 2 && pins.motor[1].step.bit == 3 && pins.motor[2].step.bit == 4,
              "the expander shifts the carries to these pins");
}

}  // namespace passo::chip
