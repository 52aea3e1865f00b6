// What the board tells a USB host about itself: a serial line (CDC ACM), which every system knows without a driver of
// its own. Sources: USB 2.0, chapter 9; CDC 1.10, 5.2 and PSTN 1.20, 5.3.
#pragma once

#include <stdint.h>

namespace passo::chip {

// Endpoints: the first is the standard's for notices, of which this board has none. The second carries the bytes.
inline constexpr uint32_t usb_notices = 1;
inline constexpr uint32_t usb_data = 2;
inline constexpr uint32_t usb_packet = 64;
inline constexpr uint8_t usb_in = 0x80;

// The vendor's number is pid.codes', and this product's the one that is given there for trials.
inline constexpr uint8_t usb_device[] = {
    18,         1,        // a device
    0x00,       0x02,     // USB 2.0
    2,          0,    0,  // communications
    usb_packet,           // of endpoint 0
    0x09,       0x12,     // vendor 1209
    0x01,       0x00,     // product 0001
    0x00,       0x01,     // version 1.00
    1,          2,    0,  // strings: the maker, the product, no number
    1,                    // configuration
};

inline constexpr uint8_t usb_configuration[] = {
    9,    2,          67,
    0,    2,          1,
    0,    0x80,       50,  // 67 bytes, 2 interfaces; fed by the bus with up to 100 mA
    9,    4,          0,
    0,    1,          2,
    2,    0,          0,  // interface 0: control, abstract control model
    5,    0x24,       0,
    0x10, 0x01,  // CDC 1.10
    5,    0x24,       1,
    0,    1,  // no calls
    4,    0x24,       2,
    2,  // knows line coding and line state
    5,    0x24,       6,
    0,    1,  // interface 1 is its data
    7,    5,          usb_in | usb_notices,
    3,    8,          0,
    255,  // interrupt
    9,    4,          1,
    0,    2,          10,
    0,    0,          0,  // interface 1: data
    7,    5,          usb_data,
    2,    usb_packet, 0,
    0,  // bulk, from the host
    7,    5,          usb_in | usb_data,
    2,    usb_packet, 0,
    0,  // bulk, to the host
};
static_assert(sizeof(usb_configuration) == 67);

inline constexpr uint8_t usb_languages[] = {4, 3, 0x09, 0x04};  // English
inline constexpr uint8_t usb_maker[] = {12, 3, 'P', 0, 'a', 0, 's', 0, 's', 0, 'o', 0};
inline constexpr uint8_t usb_product[] = {22, 3,   'P', 0,   'a', 0,   's', 0,   's', 0,   'o',
                                          0,  ' ', 0,   'p', 0,   'i', 0,   'c', 0,   'o', 0};
static_assert(sizeof(usb_maker) == 12 && sizeof(usb_product) == 22);

}  // namespace passo::chip
