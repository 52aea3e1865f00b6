; On the chip: instructions between marks, each with the cycles that the data sheet of the ATmega328P gives it
; (chapter "Instruction Set Summary"). timing_test.cpp compares.
;
; Writing GPIOR0 is a mark, one cycle; writing GPIOR1 tells the cycles that there should have been between the last two;
; writing GPIOR2 ends it.

#define PORTB 0x05
#define GPIOR0 0x1e
#define GPIOR1 0x2a
#define GPIOR2 0x2b

.macro begin
  out GPIOR0, r1
.endm
.macro end cycles
  out GPIOR0, r1
  ldi r16, \cycles
  out GPIOR1, r16
.endm

.lcomm cell, 8

.text
.global main
main:
  ldi r26, lo8(cell)
  ldi r27, hi8(cell)
  movw r30, r26

  ; arithmetic
  begin
  nop
  end 1
  begin
  add r24, r25
  adc r24, r25
  end 2
  begin
  movw r24, r30
  end 1
  begin
  adiw r24, 1
  end 2
  begin
  mul r24, r25
  end 2
  clr r1

  ; memory
  begin
  ld r24, X
  end 2
  begin
  ld r24, X+
  end 2
  begin
  ldd r24, Z+1
  end 2
  begin
  std Z+1, r24
  end 2
  begin
  lds r24, cell
  end 2
  begin
  sts cell, r24
  end 2
  begin
  push r24
  end 2
  begin
  pop r24
  end 2
  begin
  lpm r24, Z
  end 3

  ; ports
  begin
  in r24, GPIOR2
  end 1
  begin
  out PORTB, r24
  end 1
  begin
  sbi PORTB, 0
  end 2

  ; jumps
  begin
  rjmp 1f
1:
  end 2
  begin
  jmp 1f
1:
  end 3
  begin
  rcall subroutine
  end 3+4
  begin
  call subroutine
  end 4+4

  ; branches: the flags first
  cp r1, r1
  begin
  breq 1f
1:
  end 2
  begin
  brne 1f
1:
  end 1
  begin
  sbrs r1, 0      ; skips nothing
  nop
  end 1+1
  begin
  sbrc r1, 0      ; skips one word
  nop
  end 2
  begin
  sbrc r1, 0      ; skips two words
  lds r24, cell
  end 3

  out GPIOR2, r1
forever:
  rjmp forever

subroutine:
  ret
