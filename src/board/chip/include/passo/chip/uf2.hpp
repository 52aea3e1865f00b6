// Uf2: a program for the RP2040 in the file format of its boot loader. The boot loader appears as a drive; a UF2 file
// copied there is written to the flash.
//
// A UF2 file consists of blocks of 512 bytes. Each writes 256 bytes to an address; the boot loader ignores blocks of
// other families. Source: github.com/microsoft/uf2, README; RP2040 datasheet, 2.8.4.2 (UF2) and 2.8.1.3.1 (checksum).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

inline constexpr std::uint32_t rp2040_flash = 0x10000000;
inline constexpr std::uint32_t rp2040_family = 0xe48bff56;
inline constexpr std::size_t uf2_block_size = 512;
inline constexpr std::size_t uf2_payload = 256;
inline constexpr std::size_t boot2_size = 256;

// Returns the checksum that the RP2040's ROM computes over the first 252 bytes of the flash and compares with the next
// four bytes.
std::uint32_t boot2_checksum(std::span<const std::uint8_t> boot2);

// Returns the flash contents of the program's ELF file, from rp2040_flash on, with gaps filled with 0xff and the boot
// code's checksum in place. The error is a sentence without a file name.
Result<std::vector<std::uint8_t>, std::string> flash_of_elf(std::span<const std::uint8_t> elf);

std::vector<std::uint8_t> uf2_of_flash(std::span<const std::uint8_t> flash);

// Returns the flash contents of a UF2 file, for programs that check or run it.
Result<std::vector<std::uint8_t>, std::string> flash_of_uf2(std::span<const std::uint8_t> uf2);

}  // namespace passo
