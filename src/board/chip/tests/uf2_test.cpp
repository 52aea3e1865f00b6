#include "passo/chip/uf2.hpp"

#include <numeric>

#include <gtest/gtest.h>

namespace passo {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes counting(std::size_t size) {
  Bytes bytes(size);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

std::uint32_t word(const Bytes& bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
         std::uint32_t{bytes[at + 3]} << 24;
}
void put(Bytes& bytes, std::size_t at, std::uint32_t value, unsigned size = 4) {
  for (unsigned i = 0; i < size; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> 8 * i);
}

// A program of one part, for a machine, at an address.
Bytes elf_with(const Bytes& part, std::uint32_t address, std::uint32_t machine = 40) {
  Bytes elf(52 + 32, 0);
  put(elf, 0, 0x464c457f);
  elf[4] = 1;
  put(elf, 18, machine, 2);
  put(elf, 28, 52);
  put(elf, 42, 32, 2);
  put(elf, 44, 1, 2);
  put(elf, 52, 1);
  put(elf, 52 + 4, 84);
  put(elf, 52 + 12, address);
  put(elf, 52 + 16, static_cast<std::uint32_t>(part.size()));
  elf.insert(elf.end(), part.begin(), part.end());
  return elf;
}

// Of zeros: the checksum by its definition, a polynomial division bit by bit.
TEST(Uf2, boot_code_has_the_checksum_that_the_rom_computes) {
  const Bytes zeros(252, 0);
  EXPECT_EQ(boot2_checksum(zeros), [] {
    std::uint32_t rest = 0xffffffff;
    for (int bit = 0; bit < 252 * 8; ++bit) rest = (rest & 0x80000000) != 0 ? rest << 1 ^ 0x04c11db7 : rest << 1;
    return rest;
  }());
}

TEST(Uf2, a_block_says_what_the_specification_says) {
  const Bytes file = uf2_of_flash(counting(600));
  ASSERT_EQ(file.size(), 3 * 512U);
  for (std::uint32_t block = 0; block < 3; ++block) {
    const std::size_t at = block * std::size_t{512};
    EXPECT_EQ(word(file, at), 0x0a324655U);
    EXPECT_EQ(word(file, at + 4), 0x9e5d5157U);
    EXPECT_EQ(word(file, at + 8), 0x2000U) << "a family is named";
    EXPECT_EQ(word(file, at + 12), 0x10000000U + block * 256);
    EXPECT_EQ(word(file, at + 16), 256U);
    EXPECT_EQ(word(file, at + 20), block);
    EXPECT_EQ(word(file, at + 24), 3U);
    EXPECT_EQ(word(file, at + 28), 0xe48bff56U);
    EXPECT_EQ(word(file, at + 508), 0x0ab16f30U);
    EXPECT_EQ(file[at + 32 + 7], static_cast<std::uint8_t>(block * 256 + 7));
  }
}

TEST(Uf2, the_flash_comes_back_as_it_was) {
  const Bytes flash = counting(1024);
  const auto back = flash_of_uf2(uf2_of_flash(flash));
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(*back, flash);
}

TEST(Uf2, a_program_lies_in_the_flash_with_its_checksum) {
  const Bytes part = counting(300);
  const auto flash = flash_of_elf(elf_with(part, 0x10000000));
  ASSERT_TRUE(flash) << flash.error();
  ASSERT_EQ(flash->size(), 512U);
  EXPECT_TRUE(std::equal(part.begin(), part.begin() + 252, flash->begin()));
  EXPECT_EQ(word(*flash, 252), boot2_checksum(part));
  EXPECT_EQ((*flash)[299], part[299]);
  EXPECT_EQ((*flash)[300], 0xff);
}

TEST(Uf2, what_is_no_program_for_the_chip_is_refused) {
  EXPECT_FALSE(flash_of_elf({}));
  EXPECT_FALSE(flash_of_elf(counting(100)));
  EXPECT_FALSE(flash_of_elf(elf_with(counting(300), 0x10000000, 83))) << "an AVR's";
  EXPECT_FALSE(flash_of_elf(elf_with(counting(300), 0x20000000))) << "not in flash";
  Bytes cut = elf_with(counting(300), 0x10000000);
  cut.resize(200);
  EXPECT_FALSE(flash_of_elf(cut));
}

TEST(Uf2, what_is_no_file_for_the_chip_is_refused) {
  const Bytes good = uf2_of_flash(counting(512));
  EXPECT_FALSE(flash_of_uf2({}));
  EXPECT_FALSE(flash_of_uf2(Bytes(good.begin(), good.end() - 1)));
  for (const std::size_t at : {0U, 4U, 8U, 28U, 508U, 512U, 512U + 28U}) {
    Bytes other = good;
    other[at] ^= 1;
    EXPECT_FALSE(flash_of_uf2(other)) << at;
  }
}

}  // namespace
}  // namespace passo
