#include "passo/chip/line_decoder.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/wire/message.hpp"

namespace passo {
namespace {

// Frames with a lot of sync bytes in them, cut, doubled and spoilt.
TEST(LineDecoder, tells_what_the_decoder_of_the_wire_tells_whatever_comes) {
  std::mt19937_64 random(test::seed());
  LineDecoder line;
  Decoder wire;
  int frames = 0;
  int refusals = 0;
  for (int i = 0; i < 50'000; ++i) {
    const auto motors = static_cast<std::uint8_t>(random() % (max_motors + 1));
    if (random() % 100 == 0) {
      line.set_motors(motors);
      wire.set_motors(motors);
    }
    BoardSegment segment{.events = 1, .interval = static_cast<std::uint32_t>(random())};
    for (std::uint16_t& increment : segment.increments) {
      increment = static_cast<std::uint16_t>(random() % 3 == 0 ? 0xA5A5 : random());
    }
    std::uint8_t bytes[largest_frame];
    std::uint8_t size = random() % 4 == 0 ? encode(Hello{.motors = motors}, static_cast<std::uint8_t>(random()), bytes)
                                          : encode(segment, motors, static_cast<std::uint8_t>(random()), bytes);
    if (random() % 3 == 0) bytes[random() % size] = static_cast<std::uint8_t>(random() % 2 == 0 ? 0xA5 : random());
    if (random() % 5 == 0) size = static_cast<std::uint8_t>(random() % size);
    for (std::uint8_t k = 0; k < size; ++k) {
      const Decoded told = wire.feed(bytes[k]);
      ASSERT_EQ(line.feed(bytes[k]), told) << "frame " << i << ", byte " << int{k};
      if (told == Decoded::refused) ++refusals;
      if (told != Decoded::frame) continue;
      ++frames;
      ASSERT_EQ(line.frame().type, wire.frame().type);
      ASSERT_EQ(line.frame().sequence, wire.frame().sequence);
      const std::uint8_t length = payload_size(static_cast<std::uint8_t>(wire.frame().type), max_motors);
      ASSERT_EQ(std::memcmp(line.frame().payload, wire.frame().payload, std::min<std::size_t>(length, 10)), 0);
    }
  }
  EXPECT_GT(frames, 5'000);
  EXPECT_GT(refusals, 5'000);
}

}  // namespace
}  // namespace passo
