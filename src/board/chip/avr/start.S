// What happens before main(). In the place of avr-gcc's own start-up file, because of the vectors: the step timer's
// interrupt stands where its vector would be (uno_events.cpp), which saves the jump. Between the parts below the linker
// puts what copies and clears variables and calls constructors, out of libgcc.

.section .init0, "ax", @progbits
.global passo_reset
passo_reset:
  cli

.section .init2, "ax", @progbits
  clr r1
  out 0x3f, r1
  ldi r28, lo8(__stack)
  ldi r29, hi8(__stack)
  out 0x3e, r29
  out 0x3d, r28

.section .init9, "ax", @progbits
  call main
  rjmp passo_reset
