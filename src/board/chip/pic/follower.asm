; The firmware `follower` for a PIC16F877A. docs/follower.md says what it does; firmware/follower.hpp is the same in C++,
; and has the names that are used here. There are two boards. One has a crystal of 20 MHz. The other, with
; -D first_board=1, is the first control board to the letter: 4 MHz, its keypad, its button, its LEDs and its customs.
;
; One loop, no interrupt. Each turn samples the clock lines once, so what counts is the longest turn: it decides how long
; a level of a line must last to be seen. All that can wait is done in turns without a step, a piece every millisecond.
; Cycles (0.2 us, on the first board 1 us) are in the margin where they add up to the longest turns. They are measured by
; tests/follower.
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
; Assemble with -D two_on=1, -D wave=1 or -D half_step=1.

        list    p=16f877a, r=dec
        include "p16f877a.inc"
        ; A watchdog that bites after 0.14 s, and a reset where the supply sags: either way all outputs float.
    ifdef first_board
#define CRYSTAL _XT_OSC
    else
#define CRYSTAL _HS_OSC
    endif
        __config CRYSTAL & _WDT_ON & _PWRTE_ON & _BOREN_ON & _LVP_OFF & _CPD_OFF & _CP_OFF & _DEBUG_OFF

; ---- The motors' outputs -----------------------------------------------------------------------------------------------

#define X_OUTPUTS 1 << 4, 1 << 5, 1 << 6, 1 << 7
#define Y_OUTPUTS 1 << 7, 1 << 4, 1 << 5, 1 << 6
#define Z_OUTPUTS 1 << 2, 1 << 3, 1 << 0, 1 << 1
X_ALL   equ     0xf0                    ; of port D
Y_ALL   equ     0xf0                    ; of port C
Z_ALL   equ     0x0f                    ; of port C

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

; The table of one motor, in the bits of its port. Windings come round in the order F1 F2 F3 F4.
table   macro   f1, f2, f3, f4
    ifdef two_on
        retlw   f1 | f2
        retlw   f2 | f3
        retlw   f3 | f4
        retlw   f4 | f1
    endif
    ifdef wave
        retlw   f1
        retlw   f2
        retlw   f3
        retlw   f4
    endif
    ifdef half_step
        retlw   f1 | f2
        retlw   f2
        retlw   f2 | f3
        retlw   f3
        retlw   f3 | f4
        retlw   f4
        retlw   f4 | f1
        retlw   f1
    endif
        endm

    ifdef half_step
PLACE_MASK equ  7
    else
PLACE_MASK equ  3
    endif

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
risen                                   ; bits 0 to 2: the axes that step
follow                                  ; 7 in automatic mode, else 0: the clock lines that count
manual                                  ; bit 0: manual mode. On the first board neither mode is on before a mode key
place_x                                 ; masked with PLACE_MASK, the index into the motor's table
place_y
place_z
pattern
port_c                                  ; what ports C and D were given. Never read back from the pins: a loaded pin
port_d                                  ; may read low though it is driven high
relay_line                              ; bit 0: the last sample of RE0
piece                                   ; of a look
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
trusted                                 ; bit 0: a mode key was pressed since the reset, so somebody knows the position
        endc

; ---- Tables: within the first 256 words, since PCLATH stays 0 ----------------------------------------------------------

        org     0
        goto    start

x_windings
        addwf   PCL,f
        table   X_OUTPUTS
y_windings
        addwf   PCL,f
        table   Y_OUTPUTS
z_windings
        addwf   PCL,f
        table   Z_OUTPUTS

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

; ---- The loop ----------------------------------------------------------------------------------------------------------

loop    clrwdt                          ; 1
        movf    lines,w                 ; 1
        movwf   before                  ; 1
        movf    PORTA,w                 ; 1   the sample
        movwf   lines                   ; 1
        comf    before,w                ; 1
        andwf   lines,w                 ; 1   low before, high now
        andwf   follow,w                ; 1
        btfsc   STATUS,Z                ; 2
        goto    no_step

; A step of one axis: 20 cycles, or 3 where there is none. The other motor's bits of the port stay as they are.
; The longest turn has three of them: 10 + 1 + 3 * 20 + 2 = 73.
axis    macro   bit, place, windings, shadow, port, all
        local   none
        btfss   risen,bit
        goto    none
        incf    place,f
        movlw   -2
        btfsc   before,bit + 3
        addwf   place,f
        movf    place,w
        andlw   PLACE_MASK
        call    windings
        movwf   pattern
        movf    shadow,w
        andlw   0xff ^ all
        iorwf   pattern,w
        movwf   shadow
        movwf   port
none
        endm

step    movwf   risen                   ; 1
        axis    0, place_x, x_windings, port_d, PORTD, X_ALL
        axis    1, place_y, y_windings, port_c, PORTC, Y_ALL
        axis    2, place_z, z_windings, port_c, PORTC, Z_ALL
        goto    loop                    ; 2

no_step movf    PORTE,w                 ; 1
        xorwf   relay_line,w            ; 1
        andlw   1                       ; 1
        btfss   STATUS,Z                ; 2
        goto    relay_changed
        btfss   PIR1,TMR2IF             ; 2   a millisecond has passed
        goto    loop
        bcf     PIR1,TMR2IF             ; 1
        movf    piece,w                 ; 1
        incf    piece,f                 ; 1
        addwf   PCL,f                   ; 2
        goto    column_0                ; 2
        goto    column_1
        goto    column_2
        goto    look_at_keys
        goto    look_at_the_rest
    if $ > 0x100
        error   "a table crosses the first 256 words"
    endif

; ---- The relay ---------------------------------------------------------------------------------------------------------

; Only an edge of its line switches it on: a tool does not start because a reset or manual mode is over.
relay_changed
        xorwf   relay_line,f
        btfss   follow,0
        goto    loop
        btfsc   relay_line,0
        goto    relay_on
relay_off
        bcf     port_d,RELAY
        movf    port_d,w
        movwf   PORTD
        clrf    PORTE
        goto    loop
relay_on
        bsf     port_d,RELAY
        movf    port_d,w
        movwf   PORTD
        movlw   RELAY_INDICATOR
        movwf   PORTE
        goto    loop

; ---- A look at the keypad ----------------------------------------------------------------------------------------------

; Reads the rows of the column that has been low for a millisecond or longer, and draws the next one; the others float.
column_0
        movlw   4 * 0
        movwf   column
        movlw   B_INPUTS ^ (1 << COLUMN_1)
        goto    read_rows
column_1
        movlw   4 * 1
        movwf   column
        movlw   B_INPUTS ^ (1 << COLUMN_2)
        goto    read_rows
column_2
        movlw   4 * 2                   ; 1
        movwf   column                  ; 1
        movlw   B_INPUTS ^ (1 << COLUMN_0) ; 1
read_rows
        movwf   next_drawn              ; 1
        comf    PORTB,w                 ; 1
        andlw   ROWS                    ; 1
        movwf   rows                    ; 1
        movf    next_drawn,w            ; 1
        bsf     STATUS,RP0              ; 1
        movwf   TRISB                   ; 1
        bcf     STATUS,RP0              ; 1
        movf    rows,f                  ; 1
        btfsc   STATUS,Z                ; 2
        goto    loop
        decf    rows,w                  ; 1
        andwf   rows,w                  ; 1
        btfss   STATUS,Z                ; 2
        goto    several
        movf    found,w                 ; 1
        xorlw   NONE                    ; 1
        btfss   STATUS,Z                ; 2
        goto    several
        movf    column,w                ; 1
        btfsc   rows,ROW_1              ; 2
        addlw   1
        btfsc   rows,ROW_2              ; 2
        addlw   2
        btfsc   rows,ROW_3              ; 1
        addlw   3                       ; 1
        movwf   found                   ; 1
        goto    loop                    ; 2
several movlw   SEVERAL
        movwf   found
        goto    loop

look_at_keys
        movf    found,w
        andlw   0x0f
        movwf   now
        movlw   NONE
        movwf   found
        movf    now,w
        xorwf   key_seen,w
        btfsc   STATUS,Z
        goto    key_same
        movf    now,w
        movwf   key_seen
        movlw   LOOKS_TO_SETTLE
        movwf   key_left
        goto    loop
key_same
        movf    key_left,f
        btfss   STATUS,Z
        decfsz  key_left,f
        goto    held                    ; nothing new, or not yet for long enough
        movf    key_seen,w
        xorwf   key,w
        btfsc   STATUS,Z
        goto    held
        xorwf   key,f
        movf    key,w
        xorlw   KEY_HASH
        btfsc   STATUS,Z
        goto    to_manual
        movf    key,w
        xorlw   KEY_STAR
        btfsc   STATUS,Z
        goto    to_automatic
        btfss   manual,0
        goto    loop
        movlw   LOOKS_TO_REPEAT
        goto    jog
held    btfss   manual,0
        goto    loop
        movf    key_seen,w              ; being let go, it does not repeat
        xorwf   key,w
        btfss   STATUS,Z
        goto    loop
        decfsz  wait,f
        goto    loop
        movlw   LOOKS_A_STEP
jog     movwf   wait
        movf    key,w
        call    jog_of
        movwf   before
        andlw   7
        goto    step                    ; the same steps as the lines make

; A mode key also says: I know where the machine stands.
to_manual
        clrf    follow
        bsf     manual,0
        bsf     trusted,0
        clrf    looks
        goto    loop
to_automatic
        movlw   7
        movwf   follow
        clrf    manual
        bsf     trusted,0
        clrf    looks
        btfss   relay_line,0
        goto    relay_off
        goto    loop

; ---- The tool button and the mode's indicator --------------------------------------------------------------------------

look_at_the_rest
        clrf    piece
        comf    BUTTON_PORT,w
        andlw   1 << BUTTON
        movwf   now
        xorwf   button_seen,w
        btfsc   STATUS,Z
        goto    button_same
        movf    now,w
        movwf   button_seen
        movlw   LOOKS_TO_SETTLE
        movwf   button_left
        goto    show_mode
button_same
        movf    button_left,f
        btfss   STATUS,Z
        decfsz  button_left,f
        goto    show_mode
        movf    button_seen,w
        xorwf   button,w
        btfsc   STATUS,Z
        goto    show_mode
        xorwf   button,f
        btfsc   button,BUTTON           ; pushed, not let go
        btfss   manual,0
        goto    show_mode
        btfsc   port_d,RELAY
        goto    relay_off
        goto    relay_on

    ifdef first_board
; LEDs 1 to 3 are lit when their pins are low: before the first mode key, and in automatic mode. LED 0, lit when high, is
; lit in automatic mode only. In manual mode LED 1 is lit while 5 raises Z.
show_mode
        movlw   LED_0
        btfss   follow,0
        clrw
        movwf   PORTB
        movlw   0
        btfsc   manual,0
        movlw   LED_1 | LED_2 | LED_3
        movwf   now
        movf    key,w
        xorlw   KEY_5
        movlw   0xff
        btfsc   STATUS,Z
        movlw   0xff ^ LED_1
        andwf   now,f
        movf    port_d,w
        andlw   0xff ^ (LED_1 | LED_2 | LED_3)
        iorwf   now,w
        movwf   port_d
        movwf   PORTD
        goto    loop
    else
; Until a mode key was pressed it blinks, 0.32 s on and 0.32 s off.
show_mode
        btfss   trusted,0
        incf    looks,f
        movf    port_d,w
        andlw   0xff ^ (AUTOMATIC | MANUAL)
        movwf   port_d
        movlw   AUTOMATIC
        btfss   follow,0
        movlw   MANUAL
        btfss   looks,6
        iorwf   port_d,f
        movf    port_d,w
        movwf   PORTD
        goto    loop
    endif

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
        goto    show_mode

        end
