// The second check: sums of words by this test's own formulas, and errors that deceive the CRC.
#include "random_messages.hpp"
#include <gtest/gtest.h>

#include "passo/wire/announcement.hpp"

namespace passo {
namespace {

constexpr std::uint8_t motors = 3;

std::vector<Bytes> random_items(RandomMessages& random, unsigned count) {
  std::vector<Bytes> items;
  for (unsigned i = 0; i < count; ++i) {
    std::uint8_t frame[largest_frame];
    std::uint8_t size = 0;
    if (random.below(4) == 0) {
      BoardOutputs outputs{.switches = random.byte()};
      outputs.spindle_rpm = random.word();
      size = encode(outputs, 0, frame);
    } else {
      size = encode(random.segment(motors), motors, 0, frame);
    }
    items.emplace_back(frame, frame + size);
  }
  return items;
}

WireFrame read(const Bytes& bytes) {
  Decoder decoder;
  decoder.set_motors(motors);
  for (const std::uint8_t byte : bytes) static_cast<void>(decoder.feed(byte));
  return decoder.frame();
}

Replace announce(std::uint16_t number, std::uint16_t after, const std::vector<Bytes>& items) {
  Announcement announcement(number, after, motors);
  for (const Bytes& item : items) announcement.add(item.data(), static_cast<std::uint8_t>(item.size()));
  return announcement.replace();
}

// The sums that remain on the board.
ItemSums left(const Replace& replace, std::uint16_t number, const std::vector<WireFrame>& items) {
  ItemSums sums = replace.sums;
  sums.add_announcement(number, replace.after, replace.count);
  for (const WireFrame& item : items) sums.add(item, motors);
  return sums;
}

TEST(ItemSums, leave_nothing_of_what_was_announced) {
  RandomMessages random(test::seed());
  for (int trial = 0; trial < 1000; ++trial) {
    const std::vector<Bytes> items = random_items(random, 1 + random.below(20));
    std::vector<WireFrame> frames;
    for (const Bytes& item : items) frames.push_back(read(item));
    const std::uint16_t number = random.word();
    const std::uint16_t after = random.word();
    const Replace replace = announce(number, after, items);
    ASSERT_EQ(replace.count, items.size());
    ASSERT_TRUE(left(replace, number, frames).is_nothing());
    Replace other = replace;
    other.after = static_cast<std::uint16_t>(after + 1 + random.below(65'535));
    ASSERT_FALSE(left(other, number, frames).is_nothing());
    ASSERT_FALSE(left(replace, static_cast<std::uint16_t>(number + 256), frames).is_nothing());
    std::swap(frames.front(), frames.back());
    const bool same = items.front() == items.back();
    ASSERT_EQ(left(replace, number, frames).is_nothing(), same);
  }
}

TEST(ItemSums, are_the_sum_of_words_and_the_sum_of_sums) {
  const BoardSegment segment{.events = 0x0302,
                             .directions = 4,
                             .flips = 5,
                             .bend = 0x21,
                             .interval = 0x09080706,
                             .change = 0x0C0B0A,
                             .increments = {0x0E0D, 0x100F, 0x1211}};
  std::uint8_t frame[largest_frame];
  const std::uint8_t size = encode(segment, motors, 0, frame);
  const Replace replace = announce(7, 300, {Bytes(frame, frame + size)});
  // The announcement, then type and payload two bytes at a time.
  const unsigned words[] = {7, 300, 1, 0x0233, 0x0403, 0x0695, 0x0807, 0x0A09, 0x0C0B, 0x0E0D, 0x100F, 0x1211};
  unsigned first = replace.sums.first;
  unsigned second = replace.sums.second;
  for (const unsigned word : words) {
    first = (first + word) % 65'536;
    second = (second + first) % 65'536;
  }
  EXPECT_EQ(first, 0U);
  EXPECT_EQ(second, 0U);
}

// A byte doubled or lost in a segment, with a CRC that happens to be right: the test makes it right.
TEST(ItemSums, see_what_a_crc_of_16_bits_lets_pass) {
  RandomMessages random(test::seed());
  int seen = 0;
  constexpr int trials = 20'000;
  for (int trial = 0; trial < trials; ++trial) {
    const std::vector<Bytes> items = random_items(random, 5);
    std::vector<WireFrame> frames;
    for (const Bytes& item : items) frames.push_back(read(item));
    WireFrame& damaged = frames[random.below(5)];
    const std::uint8_t size = payload_size(static_cast<std::uint8_t>(damaged.type), motors);
    const unsigned at = random.below(size);
    std::uint8_t* const payload = damaged.payload;
    const WireFrame before = damaged;
    if (random.below(2) == 0) {
      for (unsigned i = size - 1U; i > at; --i) payload[i] = payload[i - 1];
    } else {
      for (unsigned i = at; i + 1 < size; ++i) payload[i] = payload[i + 1];
      payload[size - 1] = random.byte();
    }
    if (std::equal(payload, payload + size, before.payload)) continue;
    ++seen;
    ASSERT_FALSE(left(announce(1, 0, items), 1, frames).is_nothing()) << "trial " << trial;
  }
  EXPECT_GT(seen, trials / 2);
}

}  // namespace
}  // namespace passo
