// The frames of Huanyang's HY drives: like Modbus RTU, but the function codes mean something else, and a reply has the
// length of its data where Modbus has an address. libmodbus can send such requests, but it would wait for a longer
// reply to function 5 (decision 0212).
//
//   request                        reply                           meaning
//   AA 05 02 HI LO                 the same                        write the frequency, 0.01 Hz
//   AA 03 01 COMMAND               AA 03 01 STATE                  run forward 0x01, run reverse 0x11, stop 0x08
//   AA 04 03 INDEX 00 00           AA 04 03 INDEX HI LO            read 1: output frequency, 0.01 Hz; 2: current, 0.1 A
//
// Each is followed by the checksum of Modbus RTU. As in Huanyang's manual, chapter RS485, and in LinuxCNC's hy_vfd
// (hy_modbus.c), grblHAL (Plugins_spindle, huanyang.c) and FluidNC (HuanyangProtocol.cpp).
//
// Invariant: a reply is accepted only if it is whole, its checksum is right, and it belongs to the request.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/spindle/vfd.hpp"

namespace passo {

inline constexpr std::size_t longest_huanyang_frame = 16;

// The checksum of Modbus RTU: its low byte is sent first.
std::uint16_t modbus_checksum(std::span<const std::uint8_t> bytes);

// The request without its checksum. `value`: 0.01 Hz, for set_speed. Empty: this drive has no such exchange.
std::vector<std::uint8_t> huanyang_request(int address, VfdTask task, std::uint16_t value);

// The length of a reply, with its checksum, of which these are the first bytes. Empty: not known yet. 0: these bytes
// begin no reply.
std::optional<std::size_t> huanyang_reply_length(std::span<const std::uint8_t> begin);

// The value in a reply: what was read, the state, or the written value. `request` is without its checksum.
Result<std::uint16_t, VfdTrouble> parse_huanyang_reply(std::span<const std::uint8_t> reply,
                                                       std::span<const std::uint8_t> request);

}  // namespace passo
