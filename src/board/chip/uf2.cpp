#include "passo/chip/uf2.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr std::uint32_t first_magic = 0x0a324655;
constexpr std::uint32_t second_magic = 0x9e5d5157;
constexpr std::uint32_t last_magic = 0x0ab16f30;
constexpr std::uint32_t family_present = 0x2000;
constexpr std::size_t payload_at = 32;
constexpr std::size_t largest_flash = 16U << 20;

std::uint32_t get(std::span<const std::uint8_t> bytes, std::size_t at, unsigned size) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < size; ++i) value |= std::uint32_t{bytes[at + i]} << 8 * i;
  return value;
}
void put(std::span<std::uint8_t> bytes, std::size_t at, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> 8 * i);
}

}  // namespace

std::uint32_t boot2_checksum(std::span<const std::uint8_t> boot2) {
  std::uint32_t sum = 0xffffffff;
  for (std::size_t i = 0; i < boot2_size - 4; ++i) {
    sum ^= std::uint32_t{boot2[i]} << 24;
    for (int bit = 0; bit < 8; ++bit) sum = sum << 1 ^ (sum >> 31 != 0 ? 0x04c11db7U : 0U);
  }
  return sum;
}

// ELF: Tool Interface Standard, Executable and Linking Format, version 1.2, 32 bits, little-endian.
Result<std::vector<std::uint8_t>, std::string> flash_of_elf(std::span<const std::uint8_t> elf) {
  constexpr std::size_t header = 52;
  constexpr std::uint32_t machine_arm = 40;
  constexpr std::uint32_t loaded = 1;
  if (elf.size() < header || get(elf, 0, 4) != 0x464c457f || elf[4] != 1 || get(elf, 18, 2) != machine_arm) {
    return Failure<std::string>{"this is not a program for an ARM processor (ELF, 32 bits)"};
  }
  const std::size_t table = get(elf, 28, 4);
  const std::size_t entry = get(elf, 42, 2);
  const std::size_t entries = get(elf, 44, 2);
  std::vector<std::uint8_t> flash;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t at = table + i * entry;
    if (entry < 32 || at + 32 > elf.size()) return Failure<std::string>{"the program's headers are truncated"};
    const std::size_t offset = get(elf, at + 4, 4);
    const std::size_t place = get(elf, at + 12, 4);
    const std::size_t size = get(elf, at + 16, 4);
    if (get(elf, at, 4) != loaded || size == 0) continue;
    if (place < rp2040_flash || place - rp2040_flash + size > largest_flash) {
      return Failure<std::string>{"a part of the program lies outside the flash"};
    }
    if (offset + size > elf.size()) return Failure<std::string>{"the program is truncated"};
    const std::size_t begin = place - rp2040_flash;
    if (flash.size() < begin + size) flash.resize(begin + size, 0xff);
    std::copy_n(elf.begin() + static_cast<std::ptrdiff_t>(offset), size,
                flash.begin() + static_cast<std::ptrdiff_t>(begin));
  }
  if (flash.size() <= boot2_size) return Failure<std::string>{"the program does not start with boot code"};
  flash.resize((flash.size() + uf2_payload - 1) / uf2_payload * uf2_payload, 0xff);
  put(flash, boot2_size - 4, boot2_checksum(flash));
  return flash;
}

std::vector<std::uint8_t> uf2_of_flash(std::span<const std::uint8_t> flash) {
  const std::size_t blocks = (flash.size() + uf2_payload - 1) / uf2_payload;
  std::vector<std::uint8_t> file(blocks * uf2_block_size, 0);
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::span block = std::span(file).subspan(i * uf2_block_size, uf2_block_size);
    const std::uint32_t head[] = {first_magic,
                                  second_magic,
                                  family_present,
                                  static_cast<std::uint32_t>(rp2040_flash + i * uf2_payload),
                                  uf2_payload,
                                  static_cast<std::uint32_t>(i),
                                  static_cast<std::uint32_t>(blocks),
                                  rp2040_family};
    for (std::size_t word = 0; word < 8; ++word) put(block, 4 * word, head[word]);
    const auto payload = flash.subspan(i * uf2_payload, std::min(uf2_payload, flash.size() - i * uf2_payload));
    std::copy(payload.begin(), payload.end(), block.begin() + payload_at);
    put(block, uf2_block_size - 4, last_magic);
  }
  return file;
}

Result<std::vector<std::uint8_t>, std::string> flash_of_uf2(std::span<const std::uint8_t> uf2) {
  if (uf2.empty() || uf2.size() % uf2_block_size != 0)
    return Failure<std::string>{"this is not a UF2 file, or it is truncated"};
  std::vector<std::uint8_t> flash;
  for (std::size_t at = 0; at < uf2.size(); at += uf2_block_size) {
    const auto block = uf2.subspan(at, uf2_block_size);
    if (get(block, 0, 4) != first_magic || get(block, 4, 4) != second_magic ||
        get(block, uf2_block_size - 4, 4) != last_magic) {
      return Failure<std::string>{"this is not a UF2 file"};
    }
    if (get(block, 8, 4) != family_present || get(block, 28, 4) != rp2040_family) {
      return Failure<std::string>{"this UF2 file is not for the RP2040"};
    }
    const std::size_t address = get(block, 12, 4);
    const std::size_t size = get(block, 16, 4);
    if (size != uf2_payload || address < rp2040_flash || address - rp2040_flash + size > largest_flash) {
      return Failure<std::string>{"this UF2 file has a block outside the flash"};
    }
    const std::size_t begin = address - rp2040_flash;
    if (flash.size() < begin + size) flash.resize(begin + size, 0xff);
    std::copy_n(block.begin() + payload_at, size, flash.begin() + static_cast<std::ptrdiff_t>(begin));
  }
  return flash;
}

}  // namespace passo
