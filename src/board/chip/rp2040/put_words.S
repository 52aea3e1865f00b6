// passo_put_words(job): two words for each event, as fast as this processor can: 23 cycles. The order of the fields is
// WordJob's in pico_player.hpp. The first word is the event's ticks since the one before, plus `offset`, plus the pins
// that rise; the second is `fall`.
.syntax unified
.cpu cortex-m0plus
.thumb

.section .text.passo_put_words, "ax", %progbits
.global passo_put_words
.thumb_func
passo_put_words:
  push {r4-r7, lr}
  mov r4, r8
  mov r5, r9
  mov r6, r10
  mov r7, r11
  push {r0, r4-r7}
  ldm r0!, {r1-r5}
  mov r8, r1        // change
  mov r9, r2        // offset
  mov r10, r3       // fall
  mov r11, r4       // end of the carries
  mov r1, r5        // where the words go
  ldm r0!, {r2, r3, r6, r7}  // fraction, interval, table, flips
  ldr r0, [r0]      // carries
1: ldrb r4, [r0]    // 2
  adds r0, #1       // 1
  eors r4, r7       // 1
  lsls r4, r4, #2   // 1
  ldr r4, [r6, r4]  // 2  the pins that rise
  uxth r5, r3       // 1
  adds r2, r2, r5   // 1
  lsrs r5, r3, #16  // 1
  adds r4, r4, r5   // 1
  lsrs r5, r2, #16  // 1
  adds r4, r4, r5   // 1
  uxth r2, r2       // 1
  add r3, r8        // 1
  add r4, r9        // 1
  mov r5, r10       // 1
  stm r1!, {r4, r5} // 3
  cmp r0, r11       // 1
  bne 1b            // 2
  pop {r0, r4-r7}
  str r2, [r0, #20]
  str r3, [r0, #24]
  mov r8, r4
  mov r9, r5
  mov r10, r6
  mov r11, r7
  pop {r4-r7, pc}
