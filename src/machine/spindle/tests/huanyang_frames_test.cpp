// Frames against those that Huanyang's manual and its users give, byte for byte.
#include "passo/spindle/huanyang_frames.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

Bytes with_checksum(Bytes frame) {
  const std::uint16_t sum = modbus_checksum(frame);
  frame.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
  frame.push_back(static_cast<std::uint8_t>(sum >> 8U));
  return frame;
}

TEST(HuanyangFrames, have_the_bytes_of_published_examples) {
  EXPECT_THAT(with_checksum(huanyang_request(1, VfdTask::run_forward, 0)), ElementsAre(1, 3, 1, 0x01, 0x31, 0x88));
  EXPECT_THAT(with_checksum(huanyang_request(1, VfdTask::stop, 0)), ElementsAre(1, 3, 1, 0x08, 0xF1, 0x8E));
  EXPECT_THAT(with_checksum(huanyang_request(1, VfdTask::run_reverse, 0)), ElementsAre(1, 3, 1, 0x11, 0x30, 0x44));
  EXPECT_THAT(with_checksum(huanyang_request(1, VfdTask::set_speed, 2500)),
              ElementsAre(1, 5, 2, 0x09, 0xC4, 0xBF, 0x0F));
  EXPECT_THAT(huanyang_request(7, VfdTask::read_speed, 0), ElementsAre(7, 4, 3, 1, 0, 0));
  EXPECT_THAT(huanyang_request(1, VfdTask::read_fault, 0), ElementsAre());
}

TEST(HuanyangFrames, a_reply_gives_its_value) {
  const auto value = [](VfdTask task, std::uint16_t written, Bytes reply) {
    return parse_huanyang_reply(with_checksum(std::move(reply)), huanyang_request(1, task, written));
  };
  EXPECT_EQ(*value(VfdTask::read_speed, 0, {1, 4, 3, 1, 0x9C, 0x40}), 40000);
  EXPECT_EQ(*value(VfdTask::set_speed, 2500, {1, 5, 2, 0x09, 0xC4}), 2500);
  EXPECT_EQ(*value(VfdTask::run_forward, 0, {1, 3, 1, 0x09}), 9);
}

TEST(HuanyangFrames, a_reply_that_does_not_belong_to_the_request_is_refused) {
  const Bytes request = huanyang_request(1, VfdTask::read_speed, 0);
  const auto kind = [&](Bytes reply) {
    const auto value = parse_huanyang_reply(reply, request);
    return value ? std::string("taken") : value.error().words;
  };
  EXPECT_EQ(kind(with_checksum({1, 4, 3, 1, 0, 1})), "taken");
  EXPECT_EQ(kind(with_checksum({1, 4, 3, 2, 0, 1})), "it answers another request");
  EXPECT_EQ(kind(with_checksum({1, 3, 1, 9})), "it answers another request");
  EXPECT_EQ(kind(with_checksum({2, 4, 3, 1, 0, 1})), "it comes from address 2");
  EXPECT_EQ(kind({1, 4, 3, 1, 0, 1, 0xFF, 0xFF}), "its checksum is wrong");
  EXPECT_EQ(kind({1, 4}), "it has a wrong length");
  EXPECT_EQ(kind(with_checksum({1, 4, 2, 1, 0})), "it has a wrong length");
  const auto refused = parse_huanyang_reply(with_checksum({1, 0x84, 2}), request);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, VfdTrouble::Kind::refused);
  EXPECT_EQ(refused.error().exception, 2);
  const auto other =
      parse_huanyang_reply(with_checksum({1, 5, 2, 9, 9}), huanyang_request(1, VfdTask::set_speed, 2500));
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().words, "it confirms another frequency");
}

TEST(HuanyangFrames, the_length_of_a_reply_follows_from_its_head) {
  EXPECT_FALSE(huanyang_reply_length(Bytes{1, 4}).has_value());
  EXPECT_EQ(huanyang_reply_length(Bytes{1, 4, 3}), 8U);
  EXPECT_EQ(huanyang_reply_length(Bytes{1, 5, 2}), 7U);
  EXPECT_EQ(huanyang_reply_length(Bytes{1, 0x84, 2}), 5U);
  EXPECT_EQ(huanyang_reply_length(Bytes{1, 4, 200}), 0U);
}

}  // namespace
}  // namespace passo
