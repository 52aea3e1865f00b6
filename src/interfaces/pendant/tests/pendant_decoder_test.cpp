#include "passo/pendant/pendant_decoder.hpp"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace passo {
namespace {

using Report = std::vector<std::uint8_t>;

constexpr std::size_t whb04b = 0;
constexpr std::size_t shuttle_xpress = 1;

// What the reports say, one line each.
class Decoded {
 public:
  explicit Decoded(std::size_t table) : table_(known_pendants()[table]), decoder_(table_) {}

  std::string operator()(const Report& report) {
    std::string words;
    for (const PendantEvent& event : decoder_.decode(report)) words += describe(event, table_) + "; ";
    return words;
  }

 private:
  const PendantTable& table_;
  PendantDecoder decoder_;
};

TEST(PendantDecoder, reads_the_reports_of_a_whb04b) {
  Decoded say(whb04b);
  EXPECT_EQ(say({4, 0x5A, 0, 0, 0x0D, 0x11, 0, 0x5A}), "axis X; step 0.001, 2 %; ");
  EXPECT_EQ(say({4, 0x11, 0, 0, 0x0D, 0x11, 3, 0x11}), "wheel +3; ");
  EXPECT_EQ(say({4, 0x11, 0, 0, 0x0D, 0x11, 0xFE, 0x11}), "wheel -2; ");
  EXPECT_EQ(say({4, 0x11, 0, 0, 0x10, 0x13, 0, 0x11}), "axis Z; step 1, 30 %; ");
  EXPECT_EQ(say({4, 0x11, 0, 0, 0x1C, 0x06, 0, 0x11}), "axis off; step: no known position; ");
  EXPECT_EQ(say({4, 0x11, 2, 0, 0x1C, 0x06, 0, 0x11}), "key Stop pressed; ");
  EXPECT_EQ(say({4, 0x11, 2, 0x0C, 0x1C, 0x06, 0, 0x11}), "key Fn pressed; ");
  EXPECT_EQ(say({4, 0x11, 0, 0, 0x1C, 0x06, 0, 0x11}), "key Fn released; key Stop released; ");
  EXPECT_EQ(say({4, 0x11, 4, 0x0C, 0x1C, 0x06, 0, 0x11}), "key Fn pressed; key Feed-plus pressed; ")
      << "the modifier first";
}

TEST(PendantDecoder, reads_the_reports_of_a_shuttle) {
  Decoded say(shuttle_xpress);
  EXPECT_EQ(say({0, 200, 0, 0, 0}), "") << "where the wheel's counter begins";
  EXPECT_EQ(say({0, 201, 0, 0, 0}), "wheel +1; ");
  EXPECT_EQ(say({0, 199, 0, 0, 0}), "wheel -2; ");
  EXPECT_EQ(say({0, 3, 0, 0, 0}), "wheel +60; ") << "the counter wraps";
  EXPECT_EQ(say({7, 3, 0, 0, 0}), "ring +7; ");
  EXPECT_EQ(say({0xFD, 3, 0, 0, 0}), "ring -3; ");
  EXPECT_EQ(say({0, 3, 0, 0x10, 0}), "ring +0; key 1 pressed; ");
  EXPECT_EQ(say({0, 3, 0, 0x10, 1}), "key 5 pressed; ");
  EXPECT_EQ(say({0x7F, 3, 0, 0x10, 1}), "ring +7; ") << "no further than the table goes";
}

TEST(PendantDecoder, does_not_act_for_what_is_held_at_the_first_report) {
  Decoded shuttle(shuttle_xpress);
  EXPECT_EQ(shuttle({5, 9, 0, 0x10, 0}), "");
  EXPECT_EQ(shuttle({5, 10, 0, 0x10, 0}), "wheel +1; ");
  Decoded whb(whb04b);
  EXPECT_EQ(whb({4, 0, 3, 0, 0x0D, 0x11, 0, 0}), "axis X; step 0.001, 2 %; ");
}

TEST(PendantDecoder, notices_a_lost_link_and_begins_again) {
  Decoded say(whb04b);
  say({4, 0, 0, 0, 0x0F, 0x12, 0, 0});
  EXPECT_EQ(say({4, 0, 0, 0, 0, 0, 0, 0}), "link lost; ");
  EXPECT_EQ(say({4, 0, 0, 0, 0, 0, 0, 0}), "");
  EXPECT_EQ(say({4, 0, 3, 0, 0x0F, 0x12, 0, 0}), "link is back; axis Y; step 0.1, 10 %; ")
      << "Start is held, and does nothing";
}

TEST(PendantDecoder, ignores_reports_of_another_form) {
  Decoded say(whb04b);
  EXPECT_EQ(say({}), "");
  EXPECT_EQ(say({4, 0, 0, 0, 0x0D, 0x11, 5}), "");
  EXPECT_EQ(say({5, 0, 0, 0, 0x0D, 0x11, 5, 0}), "");
  EXPECT_EQ(say(Report(64, 4)), "");
}

TEST(PendantDecoder, takes_any_bytes) {
  std::mt19937 random(1);
  for (const std::size_t table : {whb04b, shuttle_xpress}) {
    Decoded say(table);
    for (int i = 0; i < 20'000; ++i) {
      Report report(random() % 10);
      for (std::uint8_t& byte : report) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? random() : random() % 8);
      say(report);
    }
  }
}

}  // namespace
}  // namespace passo
