; The firmware `follower` for a PIC16F877A. docs/follower.md says what it does; firmware/follower.hpp is the same in C++,
; and has the names that are used here. There are two boards. One has a crystal of 20 MHz. The other, with
; -D first_board=1, is the first control board to the letter: 4 MHz, its keypad, its button, its LEDs and its customs.
;
; One loop, no interrupt. Each turn samples the clock lines once, so what counts is the longest turn: it decides how long
; a level of a line must last to be seen. So a turn with a step makes the steps and nothing else, and all that can wait is
; cut into pieces, one for each turn without a step. Cycles (0.2 us, on the first board 1 us) are in the margin, counted
; from the sample of the turn. tests/follower measures them: at most 25, 38, 47 where one, two, three motors step, 35 in a
; turn without a step.
;
;   RA0 RA1 RA2   clock X, Y, Z           RD4 RD5 RD6 RD7   F1 F2 F3 F4 of X
;   RA3 RA4 RA5   direction, 1 is down    RC7 RC4 RC5 RC6   F1 F2 F3 F4 of Y
;   RE0           the relay's line        RC2 RC3 RC0 RC1   F1 F2 F3 F4 of Z
;   RD0           the relay               MCLR              the emergency button
;   RE2           its indicator
;
;   20 MHz                                                  the first board
;   RB4 RB5 RB6 RB7   rows 123, 456, 789, *0#               RB2 RB3 RB4 RB6
;   RB0 RB1 RB2       columns 147*, 2580, 369#              RB1 RB7 RB5
;   RB3               the tool button, to ground            RE1
;   RD1 RD2           automatic, manual: lit when high      RD1 RD2 RD3 lit when low, RB0 lit when high: show_mode
;
; Assemble with -D two_on=1, -D wave=1 or -D half_step=1. The first board has two more options: with -D copied=1 the relay
; closes while its line is high, with -D as_listed=1 while it is low, and LEDs and button are as in the board's listing.
; With neither, only a rising edge of the line closes the relay.

        list    p=16f877a, r=dec
        include "p16f877a.inc"
        ; A watchdog that bites after 0.14 s, and a reset where the supply sags: either way all outputs float.
    ifdef first_board
#define CRYSTAL _XT_OSC
    else
#define CRYSTAL _HS_OSC
    endif
        __config CRYSTAL & _WDT_ON & _PWRTE_ON & _BOREN_ON & _LVP_OFF & _CPD_OFF & _CP_OFF & _DEBUG_OFF

    ifdef copied
#define relay_by_level
    endif
    ifdef as_listed
#define relay_by_level
    endif

; ---- The motors' outputs -----------------------------------------------------------------------------------------------

#define X_OUTPUTS 1 << 4, 1 << 5, 1 << 6, 1 << 7
#define Y_OUTPUTS 1 << 7, 1 << 4, 1 << 5, 1 << 6
#define Z_OUTPUTS 1 << 2, 1 << 3, 1 << 0, 1 << 1

RELAY           equ 0                   ; bit of port D
RELAY_INDICATOR equ 1 << 2              ; of port E
    ifdef first_board
LED_1           equ 1 << 1              ; masks of port D
LED_2           equ 1 << 2
LED_3           equ 1 << 3
LED_0           equ 1 << 0              ; of port B
    else
AUTOMATIC       equ 1 << 1              ; masks of port D
MANUAL          equ 1 << 2
    endif

; A motor's table, in the bits of its port, is in memory, where reading it takes 2 cycles instead of 6. Windings come round
; in the order F1 F2 F3 F4. A place is the address of a line of the table, and the bit GUARD of each address is 0.
    ifdef half_step
PLACES  equ     8
GUARD   equ     3
    else
PLACES  equ     4
GUARD   equ     2
    endif
X_TABLE equ     0x40
Y_TABLE equ     0x50
Z_TABLE equ     0x60

line    macro   address, windings
        movlw   windings
        movwf   address
        endm

table   macro   begin, f1, f2, f3, f4
    ifdef two_on
        line    begin, f1 | f2
        line    begin + 1, f2 | f3
        line    begin + 2, f3 | f4
        line    begin + 3, f4 | f1
    endif
    ifdef wave
        line    begin, f1
        line    begin + 1, f2
        line    begin + 2, f3
        line    begin + 3, f4
    endif
    ifdef half_step
        line    begin, f1 | f2
        line    begin + 1, f2
        line    begin + 2, f2 | f3
        line    begin + 3, f3
        line    begin + 4, f3 | f4
        line    begin + 5, f4
        line    begin + 6, f4 | f1
        line    begin + 7, f1
    endif
        endm

; ---- The keypad --------------------------------------------------------------------------------------------------------

    ifdef first_board
ROW_0   equ     2                       ; bits of port B
ROW_1   equ     3
ROW_2   equ     4
ROW_3   equ     6
COLUMN_0 equ    1
COLUMN_1 equ    7
COLUMN_2 equ    5
B_INPUTS equ    0xff ^ LED_0            ; the rest of port B, while no column is drawn low
#define BUTTON_PORT PORTE
BUTTON  equ     1
    else
ROW_0   equ     4
ROW_1   equ     5
ROW_2   equ     6
ROW_3   equ     7
COLUMN_0 equ    0
COLUMN_1 equ    1
COLUMN_2 equ    2
B_INPUTS equ    0xff
#define BUTTON_PORT PORTB
BUTTON  equ     3
    endif
ROWS    equ     1 << ROW_0 | 1 << ROW_1 | 1 << ROW_2 | 1 << ROW_3

; A key is 4 * column + row.
KEY_STAR equ    3
KEY_5   equ     5
KEY_HASH equ    11
NONE    equ     12
SEVERAL equ     0x80 | NONE             ; counts as none once its upper half is cut off

; In looks of 5 ms each: three columns, the keys, the rest.
LOOKS_TO_SETTLE equ 4                   ; 20 ms
    ifdef first_board
LOOKS_TO_REPEAT equ 4                   ; a held key steps at once, 50 steps a second
LOOKS_A_STEP    equ 4
    else
LOOKS_TO_REPEAT equ 80                  ; 400 ms from a key's first step to its second
LOOKS_A_STEP    equ 2                   ; 100 steps a second: motors start at that without a ramp
    endif

; ---- Memory ------------------------------------------------------------------------------------------------------------

        cblock  0x20
lines                                   ; the last sample of port A
before                                  ; the one before it: its bits 3 to 5 are the directions of the steps to make
follow                                  ; 7 in automatic mode, else 0: the clock lines that count
manual                                  ; bit 0: manual mode. On the first board neither mode is on before a mode key
place_x                                 ; addresses in the motors' tables
place_y
place_z
windings_x                              ; what the ports were given. Never read back from the pins: a loaded pin may read
windings_y                              ; low though it is driven high. A motor that has not stepped yet has no current
windings_z
rest_of_d                               ; relay and LEDs
relay_line                              ; bit 0: the last sample of RE0
next                                    ; the piece for the next turn without a step
due                                     ; the piece that begins with the next millisecond
column                                  ; 4 * the column that is read
next_drawn                              ; for TRISB: the column to draw low next
rows
found                                   ; by this look: a key, NONE or SEVERAL
now
key_seen                                ; by the last look
key                                     ; that counts
key_left                                ; looks until key_seen counts
button_seen                             ; the same for the button, in its bit
button
button_left
wait                                    ; looks until a held key acts again
looks                                   ; its bit 6 is the blinking of the mode's indicator
trusted                                 ; bit 0: a mode key was pressed since the reset, so somebody knows the position.
        endc                            ; As listed also bit 1: manual mode was on; bit 2: the button not since it began

; ---- The loop: it, the begin of each piece and the table of keys are in the first 256 words, since PCLATH stays 0 -------

        org     0
        goto    start

loop    clrwdt
        movf    lines,w
        movwf   before
        movf    PORTA,w                 ;  1  the sample
        movwf   lines                   ;  2
        comf    before,w                ;  3
        andwf   lines,w                 ;  4  low before, high now
        andwf   follow,w                ;  5  the axes that step
step    addwf   PCL,f                   ;  7
        goto    no_step                 ;  9
        goto    step_x
        goto    step_y
        goto    step_xy
        goto    step_z
        goto    step_xz
        goto    step_yz
        goto    step_xyz

; What a key moves: bits 0 to 2 the axes, bits 3 to 5 those of them whose windings go backwards, which is down. On the
; first board 5 raises Z with the windings going backwards, and 0 lowers it.
    ifdef first_board
KEY_5_MOVES equ b'100100'
KEY_0_MOVES equ b'000100'
    else
KEY_5_MOVES equ b'000100'
KEY_0_MOVES equ b'100100'
    endif
jog_of  addwf   PCL,f
        retlw   b'001011'               ; 1: X down, Y up
        retlw   b'001001'               ; 4: X down
        retlw   b'011011'               ; 7: X and Y down
        retlw   0                       ; *
        retlw   b'000010'               ; 2: Y up
        retlw   KEY_5_MOVES             ; 5: Z up
        retlw   b'010010'               ; 8: Y down
        retlw   KEY_0_MOVES             ; 0: Z down
        retlw   b'000011'               ; 3: X and Y up
        retlw   b'000001'               ; 6: X up
        retlw   b'010011'               ; 9: X up, Y down
        retlw   0                       ; #
        retlw   0                       ; none

; A turn without a step does one piece of the rest. A piece begins at cycle 12, and leaves in `next` what comes after it.
no_step movf    next,w                  ; 10
        movwf   PCL                     ; 12

then    macro   piece                   ; 4 cycles, and 3 of the next turn until its sample
        movlw   piece
        movwf   next
        goto    loop
        endm

; Most turns: the relay's line, and has the next millisecond begun?
rest    movf    PORTE,w                 ; 13
        xorwf   relay_line,w            ; 14
        andlw   1                       ; 15
        btfss   STATUS,Z                ; 16
        goto    relay_changed           ; 18
        btfss   PIR1,TMR2IF
        goto    loop
        bcf     PIR1,TMR2IF
        movf    due,w
        movwf   next
        goto    loop

; ---- A look at the keypad: three columns, the keys, the rest, each begun by a millisecond ------------------------------

; Reads the rows of the column that has been low for a millisecond or longer, and draws the next one; the others float.
column_0
        movlw   column_1
        movwf   due
        movlw   4 * 0
        movwf   column
        movlw   B_INPUTS ^ (1 << COLUMN_1)
        goto    read_rows
column_1
        movlw   column_2
        movwf   due
        movlw   4 * 1
        movwf   column
        movlw   B_INPUTS ^ (1 << COLUMN_2)
        goto    read_rows
column_2
        movlw   look_at_keys
        movwf   due
        movlw   4 * 2
        movwf   column
        movlw   B_INPUTS ^ (1 << COLUMN_0)
read_rows
        movwf   next_drawn
        comf    PORTB,w
        andlw   ROWS
        movwf   rows
        then    draw_column
draw_column
        movf    next_drawn,w
        bsf     STATUS,RP0
        movwf   TRISB
        bcf     STATUS,RP0
        movlw   rest
        movwf   next
        movf    rows,f
        btfsc   STATUS,Z
        goto    loop
        then    one_row
one_row decf    rows,w
        andwf   rows,w
        btfss   STATUS,Z
        goto    several
        movf    found,w
        xorlw   NONE
        btfss   STATUS,Z
        goto    several
        then    find_key
several movlw   SEVERAL
        goto    keep_found
find_key
        movf    column,w
        btfsc   rows,ROW_1
        addlw   1
        btfsc   rows,ROW_2
        addlw   2
        btfsc   rows,ROW_3
        addlw   3
keep_found
        movwf   found
        then    rest

look_at_keys
        movlw   look_at_button
        movwf   due
        movf    found,w
        andlw   0x0f
        movwf   now
        movlw   NONE
        movwf   found
        then    compare_key
compare_key
        movf    now,w
        xorwf   key_seen,w
        btfsc   STATUS,Z
        goto    same_key
        movf    now,w
        movwf   key_seen
        movlw   LOOKS_TO_SETTLE
        movwf   key_left
        then    rest
same_key
        movf    key_left,f
        btfss   STATUS,Z
        decfsz  key_left,f
        goto    nothing_new             ; or not yet for long enough
        then    key_settled
key_settled
        movf    key_seen,w
        xorwf   key,w
        btfsc   STATUS,Z
        goto    nothing_new
        xorwf   key,f
        then    new_key
new_key movf    key,w
        xorlw   KEY_HASH
        btfsc   STATUS,Z
        goto    to_manual
        xorlw   KEY_HASH ^ KEY_STAR
        btfsc   STATUS,Z
        goto    to_automatic
        btfss   manual,0
        goto    no_more
        movlw   LOOKS_TO_REPEAT
        movwf   wait
        then    jog
nothing_new
        then    held
held    btfss   manual,0
        goto    no_more
        movf    key_seen,w              ; being let go, it does not repeat
        xorwf   key,w
        btfss   STATUS,Z
        goto    no_more
        decfsz  wait,f
        goto    no_more
        movlw   LOOKS_A_STEP
        movwf   wait
        then    jog
jog     movlw   rest
        movwf   next
        movf    key,w
        call    jog_of
        movwf   before
        andlw   7
        goto    step                    ; the same steps as the lines make
no_more then    rest

to_automatic
        then    follow_lines
follow_lines
        movlw   rest
        movwf   next
        movlw   7
        movwf   follow
        clrf    manual
        clrf    looks
        bsf     trusted,0
    ifdef relay_by_level
        goto    relay_obeys
    else
        btfsc   relay_line,0
        btfss   rest_of_d,RELAY
        goto    relay_off
        goto    relay_on
    endif

; ---- The tool button and the mode's indicator --------------------------------------------------------------------------

look_at_button
        movlw   column_0
        movwf   due
        comf    BUTTON_PORT,w
        andlw   1 << BUTTON
        movwf   now
        then    compare_button
compare_button
        movf    now,w
        xorwf   button_seen,w
        btfsc   STATUS,Z
        goto    same_button
        movf    now,w
        movwf   button_seen
        movlw   LOOKS_TO_SETTLE
        movwf   button_left
        then    show_mode
same_button
        movf    button_left,f
        btfss   STATUS,Z
        decfsz  button_left,f
        goto    no_push
        then    button_settled
no_push then    show_mode
button_settled
        movlw   show_mode
        movwf   next
        movf    button_seen,w
        xorwf   button,w
        btfsc   STATUS,Z
        goto    loop
        xorwf   button,f
        btfsc   button,BUTTON           ; pushed, not let go
        btfss   manual,0
        goto    loop
    ifdef as_listed                     ; the listing goes by the LED, which manual mode begins with
        btfsc   trusted,2
        goto    first_push
    endif
        btfsc   rest_of_d,RELAY
        goto    relay_off
        goto    relay_on
    ifdef as_listed
first_push
        bcf     trusted,2
        goto    relay_off
    endif

    ifdef first_board
; LEDs 1 to 3 are lit when their pins are low: before the first mode key, and in automatic mode. LED 0, lit when high, is
; lit in automatic mode only. In manual mode LED 1 is lit while 5 raises Z. As listed, LED 0 is always low, and LEDs 1 to 3
; stay dark after manual mode.
show_mode
    ifdef as_listed
        movlw   0
        btfsc   trusted,1
    else
        movlw   LED_0
        btfss   follow,0
        clrw
        movwf   PORTB
        movlw   0
        btfsc   manual,0
    endif
        movlw   LED_1 | LED_2 | LED_3
        movwf   now
        then    show_key_5
LAST_PIECE equ  $
show_key_5
        movf    key,w
        xorlw   KEY_5
        btfsc   STATUS,Z
        btfss   manual,0
        goto    show_leds
        movlw   0xff ^ LED_1
        andwf   now,f
show_leds
        movf    rest_of_d,w
        andlw   1 << RELAY
        iorwf   now,w
    else
; Until a mode key was pressed it blinks, 0.32 s on and 0.32 s off.
LAST_PIECE equ  $
show_mode
        btfss   trusted,0
        incf    looks,f
        movf    rest_of_d,w
        andlw   1 << RELAY
        movwf   now
        movlw   AUTOMATIC
        btfss   follow,0
        movlw   MANUAL
        btfss   looks,6
        iorwf   now,f
        movf    now,w
    endif
        movwf   rest_of_d
        iorwf   windings_x,w
        movwf   PORTD
        then    rest
    if LAST_PIECE > 0xff
        error   "a piece begins after the first 256 words"
    endif

; ---- The relay ---------------------------------------------------------------------------------------------------------

; Only an edge of its line switches it on: a tool does not start because a reset or manual mode is over. Unless the board
; was asked to go by the level. Four more cycles to the next sample: 35.
relay_changed
        xorwf   relay_line,f            ; 19
        btfss   follow,0                ; 21
        goto    loop
relay_obeys
    ifdef as_listed
        btfsc   relay_line,0
    else
        btfss   relay_line,0            ; 23
    endif
        goto    relay_off
relay_on
        bsf     rest_of_d,RELAY         ; 24
        movf    windings_x,w            ; 25
        iorwf   rest_of_d,w             ; 26
        movwf   PORTD                   ; 27
        movlw   RELAY_INDICATOR         ; 28
        movwf   PORTE                   ; 29
        goto    loop                    ; 31
relay_off
        bcf     rest_of_d,RELAY
        movf    windings_x,w
        iorwf   rest_of_d,w
        movwf   PORTD
        clrf    PORTE
        goto    loop

; ---- A mode key --------------------------------------------------------------------------------------------------------

; It also says: I know where the machine stands.
to_manual
        clrf    follow
        clrf    looks
        bsf     trusted,0
    ifdef first_board                   ; the relay's LED is lit until the button is pushed, whatever the relay does
        movlw   RELAY_INDICATOR
        btfss   manual,0
        movwf   PORTE
    endif
    ifdef as_listed
        bsf     trusted,1
        btfss   manual,0
        bsf     trusted,2
    endif
        bsf     manual,0
        then    rest

; ---- Steps -------------------------------------------------------------------------------------------------------------

; The next place of one motor, and in W its windings: 8 cycles. Backwards, too, it adds: no borrow leaves the table.
advance macro   place, axis
        movlw   1
        btfsc   before,axis + 3
        movlw   PLACES - 1
        addwf   place,f
        bcf     place,GUARD
        movf    place,w
        movwf   FSR
        movf    INDF,w
        endm

; X has a port with the relay and the LEDs: 11 cycles. Y and Z share one: 11 cycles for one of them, 20 for both.
; From the sample of this turn to that of the next: 9 + these + 2 + 3, and 2 for the way from Y or Z to X.
move_x  macro
        advance place_x, 0
        movwf   windings_x
        iorwf   rest_of_d,w
        movwf   PORTD
        endm
move_y  macro
        advance place_y, 1
        movwf   windings_y
        iorwf   windings_z,w
        movwf   PORTC
        endm
move_z  macro
        advance place_z, 2
        movwf   windings_z
        iorwf   windings_y,w
        movwf   PORTC
        endm
move_yz macro
        advance place_y, 1
        movwf   windings_y
        move_z
        endm

step_x  move_x
        goto    loop
step_y  move_y
        goto    loop
step_z  move_z
        goto    loop
step_xy move_y
        goto    step_x
step_xz move_z
        goto    step_x
step_yz move_yz
        goto    loop
step_xyz
        move_yz
        goto    step_x

; ---- After a reset: all off, and nobody knows the position -------------------------------------------------------------

start   clrf    STATUS
        clrf    PCLATH
        clrf    INTCON
        clrf    PORTB                   ; latches before directions: no output is high for a moment
        clrf    PORTC
        clrf    PORTD
        clrf    PORTE
        bsf     STATUS,RP0
        movlw   0x06
        movwf   ADCON1                  ; ports A and E are digital
        movlw   b'00001011'             ; pull-ups on port B; the watchdog's 18 ms times 8
        movwf   OPTION_REG
        movlw   0xff
        movwf   TRISA
        movlw   B_INPUTS ^ (1 << COLUMN_0)
        movwf   TRISB
        clrf    TRISC
        clrf    TRISD
        movlw   b'00000011'
        movwf   TRISE
        movlw   249
        movwf   PR2
        bcf     STATUS,RP0
    ifdef first_board
        movlw   b'00000101'             ; 1 MHz / 4 / 250: a millisecond
    else
        movlw   b'00100101'             ; 5 MHz / 4 / 250 / 5: a millisecond
    endif
        movwf   T2CON

        movlw   lines                   ; no variable keeps what it had before
        movwf   FSR
clear   clrf    INDF
        incf    FSR,f
        movf    FSR,w
        xorlw   trusted + 1
        btfss   STATUS,Z
        goto    clear
        movlw   X_TABLE
        movwf   place_x
        movlw   Y_TABLE
        movwf   place_y
        movlw   Z_TABLE
        movwf   place_z
        table   X_TABLE, X_OUTPUTS
        table   Y_TABLE, Y_OUTPUTS
        table   Z_TABLE, Z_OUTPUTS
    ifndef first_board                  ; the first board waits for a mode key
        movlw   7
        movwf   follow
    endif
        movlw   NONE
        movwf   found
        movwf   key_seen
        movwf   key
        movf    PORTA,w                 ; what is high already is no edge
        movwf   lines
        movf    PORTE,w
        movwf   relay_line
        movlw   column_0
        movwf   due
        then    show_mode

        end
