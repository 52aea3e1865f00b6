// The USB descriptors of the board: a serial port (CDC ACM), which every operating system supports without an extra
// driver. Sources: USB 2.0, chapter 9; CDC 1.10, 5.2 and PSTN 1.20, 5.3.
#pragma once

#include <stdint.h>

namespace passo::chip {

// Endpoints: the standard requires the first one for notifications, of which this board sends none. The second carries
// the bytes.
inline constexpr uint32_t usb_notices = 1;
inline constexpr uint32_t usb_data = 2;
inline constexpr uint32_t usb_packet = 64;
inline constexpr uint8_t usb_in = 0x80;

// The vendor number belongs to pid.codes; the product number is the one reserved there for tests.
inline constexpr uint8_t usb_device[] = {
    18,         1,        // a device
    0x00,       0x02,     // USB 2.0
    2,          0,    0,  // communications
    usb_packet,           // packet size of endpoint 0
    0x09,       0x12,     // vendor 1209
    0x01,       0x00,     // product 0001
    0x00,       0x01,     // version 1.00
    1,          2,    0,  // strings: the maker, the product, no serial number
    1,                    // configuration
};

inline constexpr uint8_t usb_configuration[] = {
    9,    2,          67,
    0,    2,          1,
    0,    0x80,       50,  // 67 bytes, 2 interfaces; powered by the bus with up to 100 mA
    9,    4,          0,
    0,    1,          2,
    2,    0,          0,  // interface 0: control, abstract control model
    5,    0x24,       0,
    0x10, 0x01,  // CDC 1.10
    5,    0x24,       1,
    0,    1,  // no call management
    4,    0x24,       2,
    2,  // supports line coding and line state
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
