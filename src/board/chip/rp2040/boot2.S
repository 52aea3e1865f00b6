// The second stage of booting: the first 256 bytes of the flash. The RP2040's ROM copies them to RAM and runs them
// there if their checksum is right; passo's UF2 writer adds it. Source: RP2040 datasheet, 2.8.1.3.1 and 4.10.
//
// It makes the flash readable at its address, by the command that every flash chip knows (03h, one data line, 24
// address bits). That is slow, and it does not matter: the program runs from RAM. Then it starts the program by its
// vector table.
.syntax unified
.cpu cortex-m0plus
.thumb

.section .boot2, "ax", %progbits
boot2:
  ldr r3, =0x18000000             // the serial interface, SSI
  movs r0, #0
  str r0, [r3, #0x08]             // SSIENR: off, so that it may be set up
  movs r0, #4
  str r0, [r3, #0x14]             // BAUDR: a quarter of the system clock
  ldr r0, =(31 << 16) | (3 << 8)  // CTRLR0: 32 data bits; a command and an address, then data
  str r0, [r3, #0x00]
  ldr r0, =(3 << 24) | (2 << 8) | (6 << 2)  // SPI_CTRLR0: command 03h of 8 bits, 24 address bits
  ldr r1, =0xf4
  str r0, [r3, r1]
  movs r0, #0
  str r0, [r3, #0x04]             // CTRLR1: one datum at a time
  movs r0, #1
  str r0, [r3, #0x08]

  ldr r0, =0x10000100             // the vector table
  ldr r1, =0xe000ed08             // VTOR
  str r0, [r1]
  ldr r1, [r0]
  msr msp, r1
  ldr r1, [r0, #4]
  bx r1
.pool
