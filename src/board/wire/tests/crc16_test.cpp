#include "passo/wire/crc16.hpp"

#include <string_view>

namespace passo {
namespace {

std::uint16_t crc_of(std::string_view text) {
  std::uint16_t crc = crc16_start;
  for (const char c : text) crc = crc16(crc, static_cast<std::uint8_t>(c));
  return crc;
}

// The division by the polynomial, bit by bit.
std::uint16_t long_division(std::uint16_t crc, std::uint8_t byte) {
  unsigned remainder = crc;
  for (unsigned bit = 0; bit < 8; ++bit) {
    const bool subtract = ((remainder ^ byte >> bit) & 1U) != 0;
    remainder >>= 1;
    if (subtract) remainder ^= 0x8408;  // x^16 + x^12 + x^5 + 1, mirrored
  }
  return static_cast<std::uint16_t>(remainder);
}

TEST(Crc16, has_the_published_check_value) {
  EXPECT_EQ(crc_of("123456789"), 0x6F91);
}

TEST(Crc16, of_nothing_is_its_start) {
  EXPECT_EQ(crc_of(""), 0xFFFF);
}

TEST(Crc16, is_the_remainder_of_the_division_for_every_state_and_byte) {
  for (unsigned crc = 0; crc <= 0xFFFF; crc += 3) {
    for (unsigned byte = 0; byte <= 0xFF; ++byte) {
      ASSERT_EQ(crc16(static_cast<std::uint16_t>(crc), static_cast<std::uint8_t>(byte)),
                long_division(static_cast<std::uint16_t>(crc), static_cast<std::uint8_t>(byte)))
          << crc << ' ' << byte;
    }
  }
}

}  // namespace
}  // namespace passo
