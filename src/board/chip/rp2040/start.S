// What happens before main(). The vectors and this code are in flash. The rest is copied to RAM and runs there, because
// reading flash takes as long as it takes, and RAM answers in one cycle.
.syntax unified
.cpu cortex-m0plus
.thumb

.section .vectors, "a", %progbits
  .word __stack
  .word passo_reset
  .rept 13
  .word passo_crash
  .endr
  .word passo_wake          // SysTick
  .rept 5
  .word passo_crash
  .endr
  .word passo_usb_moved     // 5: USBCTRL_IRQ
  .rept 5
  .word passo_crash
  .endr
  .word passo_refill_done   // 11: DMA_IRQ_0
  .word passo_crash
  .word passo_switch_moved  // 13: IO_IRQ_BANK0
  .rept 6
  .word passo_crash
  .endr
  .word passo_byte_came     // 20: UART0_IRQ
  .rept 5
  .word passo_crash
  .endr

.section .start, "ax", %progbits
.global passo_reset
.thumb_func
passo_reset:
  cpsid i
  ldr r0, =__ram_image
  ldr r1, =__ram_start
  ldr r2, =__ram_end
1: cmp r1, r2
  bhs 2f
  ldm r0!, {r3}
  stm r1!, {r3}
  b 1b
2: ldr r1, =__bss_start
  ldr r2, =__bss_end
  movs r3, #0
3: cmp r1, r2
  bhs 4f
  stm r1!, {r3}
  b 3b
4: ldr r0, =passo_main
  bx r0

// Nothing that should never happen is survived: the watchdog resets the chip.
.global passo_crash
.thumb_func
passo_crash:
  cpsid i
  b passo_crash
.pool
