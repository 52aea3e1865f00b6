; The first board's own program, written anew after its description and its printed listing: an image for tests, which show
; what that program does and how fast it is. It is not for a machine; docs/follower.md has the firmware that is. The pins
; are those of src/board/chip/pic/follower.asm with -D first_board=1.
;
; What the printed listing leaves out is filled in like this: the millisecond's interrupt counts down for the wait of
; 20 ms; all manual routines are built like the printed one for Z, with one counter for both directions of a motor.
; With -D without_timer=1 there is no interrupt: the loop of the automatic mode alone, as it is printed.

        list    p=16f877a, r=dec
        include "p16f877a.inc"
        __config _XT_OSC & _WDT_OFF & _PWRTE_OFF & _BOREN_OFF & _LVP_OFF & _CPD_OFF & _CP_OFF & _DEBUG_OFF

; The order of the windings: bits of D for X, of C for Y and Z.
X1      equ     4
X2      equ     5
X3      equ     6
X4      equ     7
Y1      equ     7
Y2      equ     4
Y3      equ     5
Y4      equ     6
Z1      equ     2
Z2      equ     3
Z3      equ     0
Z4      equ     1

        cblock  0x20
saved_w
saved_status
milliseconds
old
new
wanted
place_x                                 ; of the automatic mode
place_y
place_z
by_hand_x                               ; of the manual mode: a count of its own, which is the listing's weakness
by_hand_y
by_hand_z
        endc

        org     0
        goto    start

        org     4
        movwf   saved_w
        swapf   STATUS,w
        movwf   saved_status
        bcf     INTCON,T0IF
        movf    milliseconds,f
        btfss   STATUS,Z
        decf    milliseconds,f
        swapf   saved_status,w
        movwf   STATUS
        swapf   saved_w,f
        swapf   saved_w,w
        retfie

table   macro   f1, f2, f3, f4
        addwf   PCL,f
        retlw   1 << f1 | 1 << f2
        retlw   1 << f2 | 1 << f3
        retlw   1 << f3 | 1 << f4
        retlw   1 << f4 | 1 << f1
        endm
table_x table   X1, X2, X3, X4
table_y table   Y1, Y2, Y3, Y4
table_z table   Z1, Z2, Z3, Z4

start   bsf     STATUS,RP0
        movlw   b'00000001'             ; pull-ups; 1 MHz / 4 / 256: an interrupt every 1.024 ms
        movwf   OPTION_REG
        movlw   b'01011100'             ; the rows; columns and LED are outputs
        movwf   TRISB
        clrf    TRISC
        clrf    TRISD
        movlw   7
        movwf   ADCON1
        movlw   0xff
        movwf   TRISA
        movlw   b'00000011'
        movwf   TRISE
        bcf     STATUS,RP0
        clrf    old
        clrf    new
        clrf    place_x
        clrf    place_y
        clrf    place_z
        clrf    by_hand_x
        clrf    by_hand_y
        clrf    by_hand_z
        clrf    PORTB
        clrf    PORTC
        clrf    PORTD                   ; relay open, LEDs 1 to 3 lit
    ifndef without_timer
        movlw   b'10100000'
        movwf   INTCON
    endif
        bcf     PORTE,2

column  macro   pattern
        movlw   pattern
        movwf   PORTB
        endm
LEFT    equ     b'11111100'             ; 1 4 7 *
MIDDLE  equ     b'01111110'             ; 2 5 8 0
RIGHT   equ     b'11011110'             ; 3 6 9 #

wait_for_mode
        column  RIGHT
        btfss   PORTB,6                 ; #
        call    manual
        column  LEFT
        btfss   PORTB,6                 ; *
        goto    automatic
        goto    wait_for_mode

; ---- Manual mode: a pass every 20 ms, until * --------------------------------------------------------------------------

key     macro   row, routine
        btfss   PORTB,row
        call    routine
        endm

manual  bsf     PORTE,2
pass    movlw   20
        movwf   milliseconds
still   movf    milliseconds,f
        btfss   STATUS,Z
        goto    still
        bsf     PORTD,1
        bsf     PORTD,2
        bsf     PORTD,3
        btfsc   PORTE,1                 ; the tool button draws its line low
        goto    keys
let_go  btfss   PORTE,1
        goto    let_go
        btfsc   PORTE,2                 ; the LED decides, not the relay
        goto    tool_off
        bsf     PORTE,2
        bsf     PORTD,0
        goto    keys
tool_off
        bcf     PORTE,2
        bcf     PORTD,0
keys    column  MIDDLE
        key     3, z_back               ; 5
        key     6, z_on                 ; 0
        key     2, y_on                 ; 2
        key     4, y_back               ; 8
        column  RIGHT
        key     2, x_on_y_on            ; 3
        key     3, x_on                 ; 6
        key     4, x_on_y_back          ; 9
        column  LEFT
        key     2, x_back_y_on          ; 1
        key     3, x_back               ; 4
        key     4, x_back_y_back        ; 7
        column  LEFT
        btfsc   PORTB,6                 ; *
        goto    pass
        return

x_on_y_on
        call    x_on
        goto    y_on
x_on_y_back
        call    x_on
        goto    y_back
x_back_y_on
        call    x_back
        goto    y_on
x_back_y_back
        call    x_back
        goto    y_back

; Of the four windings two are switched on and one is switched off. That is all of a step as long as the motor stands where
; the count says.
show    macro   port, on_1, on_2, off
        bcf     port,off
        bsf     port,on_1
        bsf     port,on_2
        return
        endm
turn    macro   count, port, f1, f2, f3, f4
        local   second, third, fourth
        movf    count,w
        btfss   STATUS,Z
        goto    second
        show    port, f3, f4, f1
second  decf    count,w
        btfss   STATUS,Z
        goto    third
        show    port, f2, f3, f4
third   movlw   2
        subwf   count,w
        btfss   STATUS,Z
        goto    fourth
        show    port, f1, f2, f3
fourth  show    port, f4, f1, f2
        endm
; The other way it is the other neighbour that goes dark.
turn_on macro   count, port, f1, f2, f3, f4
        local   second, third, fourth
        movf    count,w
        btfss   STATUS,Z
        goto    second
        show    port, f3, f4, f2
second  decf    count,w
        btfss   STATUS,Z
        goto    third
        show    port, f2, f3, f1
third   movlw   2
        subwf   count,w
        btfss   STATUS,Z
        goto    fourth
        show    port, f1, f2, f4
fourth  show    port, f4, f1, f3
        endm
up      macro   count
        incf    count,f
        movlw   3
        andwf   count,f
        endm
down    macro   count
        decf    count,f
        movlw   3
        andwf   count,f
        endm

z_back  bcf     PORTD,1
        up      by_hand_z
        turn    by_hand_z, PORTC, Z1, Z2, Z3, Z4
z_on    down    by_hand_z
        turn_on by_hand_z, PORTC, Z1, Z2, Z3, Z4
y_back  up      by_hand_y
        turn    by_hand_y, PORTC, Y1, Y2, Y3, Y4
y_on    down    by_hand_y
        turn_on by_hand_y, PORTC, Y1, Y2, Y3, Y4
x_back  up      by_hand_x
        turn    by_hand_x, PORTD, X1, X2, X3, X4
x_on    down    by_hand_x
        turn_on by_hand_x, PORTD, X1, X2, X3, X4

; ---- Automatic mode: ends with a reset only ----------------------------------------------------------------------------

look_at macro   axis, routine
        local   none
        btfsc   old,axis
        goto    none
        btfsc   new,axis
        call    routine
none
        endm

automatic                               ; the relay is closed while its line is low
        btfsc   PORTE,0
        bcf     PORTD,0
        btfss   PORTE,0
        bsf     PORTD,0
        btfsc   PORTE,0
        bcf     PORTE,2
        btfss   PORTE,0
        bsf     PORTE,2
        movf    PORTA,w
        movwf   new
        look_at 0, step_x
        look_at 1, step_y
        look_at 2, step_z
        movf    new,w
        movwf   old
        goto    automatic

step    macro   axis, place, windings, port, all
        btfss   old,axis + 3
        incf    place,f
        btfsc   old,axis + 3
        decf    place,f
        movf    place,w
        andlw   3
        call    windings
        movwf   wanted
        movlw   0xff ^ all
        andwf   port,w
        iorwf   wanted,w
        movwf   port
        return
        endm
step_x  step    0, place_x, table_x, PORTD, 0xf0
step_y  step    1, place_y, table_y, PORTC, 0xf0
step_z  step    2, place_z, table_z, PORTC, 0x0f

        end
