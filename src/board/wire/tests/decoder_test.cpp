#include "passo/wire/decoder.hpp"

#include <algorithm>
#include <bit>

#include "kit/frames_in.hpp"
#include "random_messages.hpp"

namespace passo {
namespace {

constexpr std::uint8_t motors = 5;

Decoder decoder_for_five() {
  Decoder decoder;
  decoder.set_motors(motors);
  return decoder;
}

// What a decoder reports for some bytes.
struct Heard {
  std::vector<WireFrame> frames;
  std::vector<std::size_t> at;  // index of each frame's last byte
  int refused = 0;
};
void feed(Decoder& decoder, const Bytes& bytes, Heard& heard) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const Decoded decoded = decoder.feed(bytes[i]);
    if (decoded == Decoded::refused) ++heard.refused;
    if (decoded != Decoded::frame) continue;
    heard.frames.push_back(decoder.frame());
    heard.at.push_back(i);
  }
}
Heard feed(Decoder& decoder, const Bytes& bytes) {
  Heard heard;
  feed(decoder, bytes, heard);
  return heard;
}

bool same(const WireFrame& a, const WireFrame& b) {
  const std::uint8_t size = payload_size(static_cast<std::uint8_t>(a.type), motors);
  return a.type == b.type && a.sequence == b.sequence && std::equal(a.payload, a.payload + size, b.payload);
}
// The message of a frame, taken out of its bytes as docs/wire.md describes.
WireFrame message_in(const Bytes& bytes) {
  Bytes plain = bytes;
  for (std::size_t at = 1; bytes[at] != 0;) {
    at += bytes[at];
    plain[at] = sync_byte;
  }
  WireFrame frame;
  frame.type = static_cast<MessageType>(plain[2]);
  frame.sequence = plain[3];
  std::copy(plain.begin() + 4, plain.end() - 2, frame.payload);
  return frame;
}

class RandomFrames : public testing::Test {
 protected:
  RandomFrames()
      : seed_(test::seed()), random_(seed_), trace_(__FILE__, __LINE__, "PASSO_SEED=" + std::to_string(seed_)) {}

  // Whether a frame is reported from these bytes, and with its very last byte.
  static bool ends_with(const Heard& heard, const Bytes& bytes, const WireFrame& message) {
    return !heard.frames.empty() && same(heard.frames.back(), message) && heard.at.back() == bytes.size() - 1;
  }

  std::uint64_t seed_;
  RandomMessages random_;
  testing::ScopedTrace trace_;
};

TEST_F(RandomFrames, come_out_as_they_went_in) {
  Decoder decoder = decoder_for_five();
  for (int i = 0; i < 20000; ++i) {
    const Bytes bytes = random_.frame(motors);
    ASSERT_LE(bytes.size(), largest_frame);
    const Heard heard = feed(decoder, bytes);
    ASSERT_EQ(heard.frames.size(), 1U);
    ASSERT_EQ(heard.refused, 0);
    ASSERT_TRUE(ends_with(heard, bytes, message_in(bytes)));
  }
}

TEST_F(RandomFrames, hold_no_sync_byte_but_the_first_and_those_of_the_crc) {
  for (int i = 0; i < 20000; ++i) {
    const Bytes bytes = random_.frame(motors);
    ASSERT_EQ(bytes.front(), sync_byte);
    ASSERT_EQ(std::count(bytes.begin() + 1, bytes.end() - 2, sync_byte), 0);
  }
}

TEST_F(RandomFrames, are_refused_with_any_one_bit_flipped_and_the_next_is_accepted) {
  for (int i = 0; i < 500; ++i) {
    const Bytes good = random_.frame(motors);
    const Bytes next = random_.frame(motors);
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
      Bytes bad = good;
      bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ 1U << bit % 8);
      Decoder decoder = decoder_for_five();
      const Heard of_bad = feed(decoder, bad);
      ASSERT_TRUE(of_bad.frames.empty()) << "frame " << i << " bit " << bit;
      const Heard of_next = feed(decoder, next);
      ASSERT_EQ(of_next.frames.size(), 1U) << "frame " << i << " bit " << bit;
      ASSERT_TRUE(ends_with(of_next, next, message_in(next)));
    }
  }
}

TEST_F(RandomFrames, are_accepted_after_a_frame_that_was_cut_short_at_any_byte) {
  for (int i = 0; i < 500; ++i) {
    const Bytes cut = random_.frame(motors);
    const Bytes next = random_.frame(motors);
    for (std::size_t left = 0; left < cut.size(); ++left) {
      Decoder decoder = decoder_for_five();
      ASSERT_TRUE(feed(decoder, {cut.begin(), cut.begin() + static_cast<std::ptrdiff_t>(left)}).frames.empty());
      const Heard heard = feed(decoder, next);
      ASSERT_TRUE(ends_with(heard, next, message_in(next))) << "frame " << i << " cut to " << left;
      // If the lost last byte was a sync byte, the next frame's sync byte replaces it.
      if (heard.frames.size() == 2) {
        ASSERT_EQ(cut.back(), sync_byte);
        ASSERT_EQ(left, cut.size() - 1);
        ASSERT_TRUE(same(heard.frames.front(), message_in(cut)));
      } else {
        ASSERT_EQ(heard.frames.size(), 1U);
      }
    }
  }
}

TEST_F(RandomFrames, are_accepted_when_a_byte_was_lost_before_them_or_one_too_many_came) {
  for (int i = 0; i < 500; ++i) {
    const Bytes good = random_.frame(motors);
    const Bytes next = random_.frame(motors);
    for (std::size_t at = 0; at < good.size(); ++at) {
      const auto place = static_cast<std::ptrdiff_t>(at);
      Bytes lost = good;
      lost.erase(lost.begin() + place);
      Bytes doubled = good;
      doubled.insert(doubled.begin() + place, random_.byte());
      for (const Bytes& before : {lost, doubled}) {
        Decoder decoder = decoder_for_five();
        feed(decoder, before);
        const Heard heard = feed(decoder, next);
        ASSERT_TRUE(ends_with(heard, next, message_in(next))) << "frame " << i << " byte " << at;
      }
    }
  }
}

TEST_F(RandomFrames, are_accepted_after_any_garbage) {
  Decoder decoder = decoder_for_five();
  for (int i = 0; i < 5000; ++i) {
    Bytes garbage(random_.below(80));
    for (std::uint8_t& byte : garbage) byte = random_.byte();
    const Bytes next = random_.frame(motors);
    ASSERT_EQ(test::frames_in(garbage, motors), 0);
    ASSERT_TRUE(feed(decoder, garbage).frames.empty());
    ASSERT_TRUE(ends_with(feed(decoder, next), next, message_in(next)));
  }
}

TEST(Decoder, takes_the_sync_byte_in_a_crc_for_what_it_is) {
  // Searched among credits: one with a sync byte in the CRC's first byte, one in its second.
  for (const std::size_t place : {8U, 9U}) {
    bool found = false;
    for (unsigned value = 0; value < 0x10000 && !found; ++value) {
      Bytes bytes(largest_frame);
      const Credit credit{.executed = static_cast<std::uint16_t>(value)};
      bytes.resize(encode(credit, 0, bytes.data()));
      if (bytes[place] != sync_byte) continue;
      found = true;
      Decoder decoder;
      EXPECT_EQ(feed(decoder, bytes).frames.size(), 1U);
    }
    EXPECT_TRUE(found);
  }
}

// Tests every value of a credit after each frame that ends in a sync byte. A frame that has lost its first byte is
// whole again after such a frame: the price of "a frame that arrives whole is accepted".
TEST(Decoder, takes_a_sync_byte_at_a_frames_end_for_the_start_of_the_next_too) {
  int found = 0;
  for (unsigned value = 0; value < 0x10000; ++value) {
    Bytes bytes(largest_frame);
    bytes.resize(encode(Credit{.executed = static_cast<std::uint16_t>(value)}, 0, bytes.data()));
    Bytes next(largest_frame);
    next.resize(encode(Hello{.motors = 3}, 7, next.data()));
    const bool ends_in_sync = bytes.back() == sync_byte;
    bytes.insert(bytes.end(), next.begin() + 1, next.end());
    Decoder decoder;
    const Heard heard = feed(decoder, bytes);
    ASSERT_EQ(heard.frames.size(), ends_in_sync ? 2U : 1U) << value;
    ASSERT_EQ(test::frames_in(bytes, 0), ends_in_sync ? 2 : 1) << value;
    found += ends_in_sync ? 1 : 0;
  }
  EXPECT_GT(found, 100);
}

TEST(Decoder, refuses_segments_until_the_number_of_motors_is_known) {
  Bytes bytes(largest_frame);
  bytes.resize(encode(BoardSegment{.events = 1}, 3, 0, bytes.data()));
  Decoder decoder;
  EXPECT_TRUE(feed(decoder, bytes).frames.empty());
  decoder.set_motors(3);
  EXPECT_EQ(feed(decoder, bytes).frames.size(), 1U);
}

TEST(Decoder, tells_of_a_frame_that_the_next_one_cut_short) {
  Bytes bytes(largest_frame);
  bytes.resize(encode(Hello{.motors = 3}, 0, bytes.data()));
  Decoder decoder;
  EXPECT_EQ(feed(decoder, {bytes[0], bytes[1], bytes[2]}).refused, 0);
  const Heard heard = feed(decoder, bytes);
  EXPECT_EQ(heard.refused, 1);
  EXPECT_EQ(heard.frames.size(), 1U);
}

TEST(MessageType, differs_from_every_other_in_at_least_three_bits) {
  std::vector<unsigned> types;
  for (unsigned type = 0; type < 256; ++type) {
    if (payload_size(static_cast<std::uint8_t>(type), 8) != 0) types.push_back(type);
  }
  EXPECT_EQ(types.size(), 15U);
  for (const unsigned a : types) {
    EXPECT_NE(a, sync_byte);
    for (const unsigned b : types) {
      EXPECT_TRUE(a == b || std::popcount(a ^ b) >= 3) << a << ' ' << b;
    }
  }
}

}  // namespace
}  // namespace passo
