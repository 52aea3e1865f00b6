#include "passo/tooling/tool_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "kit/seed.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

MmPerSecond mm_per_minute(double speed) {
  return MmPerSecond(speed / 60);
}

std::string codes_of(const std::vector<ToolWarning>& warnings) {
  std::vector<std::string> codes;
  for (const ToolWarning& warning : warnings) codes.push_back(warning.code);
  return fmt::format("{}", fmt::join(codes, " "));
}

const CuttingTool cutter{.number = 2, .diameter = Mm(3), .flute_length = Mm(12), .stick_out = Mm(20)};
constexpr ToolUse good{.rpm = 12000, .feed = MmPerSecond(20), .depth = Mm(6), .depth_per_pass = Mm(3)};

TEST(ToolWarnings, are_silent_about_a_good_use_and_about_what_is_unknown) {
  EXPECT_EQ(codes_of(warnings_of(cutter, good, WorkMaterial::hardwood, {8000, 24000})), "");
  EXPECT_EQ(codes_of(warnings_of({}, {}, WorkMaterial::hardwood)), "");
  ToolUse slow = good;
  slow.feed = mm_per_minute(1);
  EXPECT_EQ(codes_of(warnings_of(cutter, slow, std::nullopt)), "");
}

TEST(ToolWarnings, a_3_mm_cutter_rubs_in_wood_at_200_mm_per_minute) {
  ToolUse use = good;
  use.feed = mm_per_minute(200);
  const auto warnings = warnings_of(cutter, use, WorkMaterial::hardwood);
  ASSERT_EQ(codes_of(warnings), "tool.chip-small");
  EXPECT_EQ(warnings[0].message, "T2 cuts 0.00833 mm per tooth in hardwood: below 0.024 mm the teeth rub");
  EXPECT_EQ(warnings[0].advice, "a feed of 1152 mm/min");
  // The machine is slower: the spindle, too.
  const auto slow = warnings_of(cutter, use, WorkMaterial::hardwood, {5000, 24000}, mm_per_minute(600));
  EXPECT_EQ(slow.at(0).advice, "a feed of 600 mm/min and a spindle speed of 6250 rpm");
  const auto hopeless = warnings_of(cutter, use, WorkMaterial::hardwood, {12000, 24000}, mm_per_minute(250));
  EXPECT_EQ(hopeless.at(0).advice, "another tool: no feed rate and spindle speed of this machine suit this one");
}

TEST(ToolWarnings, give_the_numbers_of_each_kind) {
  const auto only = [](const ToolUse& use, const CuttingTool& tool = cutter) {
    const auto warnings = warnings_of(tool, use, WorkMaterial::hardwood, {8000, 24000});
    EXPECT_EQ(warnings.size(), 1U) << codes_of(warnings);
    return warnings.empty() ? std::string() : warnings[0].code + ": " + warnings[0].message;
  };
  ToolUse use = good;
  use.depth = Mm(15);
  EXPECT_EQ(only(use), "tool.depth-over-flutes: T2 cuts 15 mm deep, but its flutes are 12 mm long");
  use = good;
  use.feed = mm_per_minute(4000);
  EXPECT_EQ(only(use), "tool.chip-large: T2 cuts 0.167 mm per tooth in hardwood: the tables permit at most 0.096 mm");
  use = good;
  use.step_over = Mm(3.5);
  EXPECT_EQ(only(use), "tool.step-over: passes 3.5 mm apart leave material between them: T2 is 3 mm wide");
  use = good;
  use.rpm = 7000;
  use.feed = mm_per_minute(900);
  EXPECT_EQ(only(use), "tool.spindle: 7000 rpm: the spindle turns at least 8000 rpm");
  use = good;
  use.plunges = true;
  CuttingTool hollow = cutter;
  hollow.centre_cutting = false;
  EXPECT_EQ(only(use, hollow), "tool.plunge: T2 plunges, but has no teeth at its centre");
  CuttingTool short_one = cutter;
  short_one.flute_length = Mm(0);
  short_one.stick_out = Mm(5);
  EXPECT_EQ(only(good, short_one),
            "tool.holder: the holder of T2 touches the material: the cut is 6 mm deep, and the tool sticks out 5 mm");
}

// Advice makes a warning useful. If it is followed, the warning disappears, and no other one appears.
TEST(ToolWarnings, the_advice_helps_for_every_tool_and_use) {
  std::mt19937_64 random(test::seed());
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::size_t followed = 0;
  std::size_t hopeless = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    CuttingTool tool{
        .number = 1, .diameter = Mm(std::exp(draw(-2, 3))), .flutes = 1 + static_cast<std::uint32_t>(trial) % 4U};
    if (random() % 2 == 0) tool.flute_length = Mm(draw(1, 30));
    if (random() % 2 == 0) tool.stick_out = Mm(draw(1, 50));
    if (random() % 3 == 0) tool.most_rpm = draw(9000, 30000);
    tool.centre_cutting = random() % 3 != 0;
    ToolUse use{.rpm = draw(1000, 40000), .feed = MmPerSecond(std::exp(draw(-1, 5)))};
    use.depth = Mm(draw(0.1, 40));
    use.depth_per_pass = Mm(draw(0.1, use.depth.value()));
    use.step_over = Mm(draw(0.01, tool.diameter.value() * 1.5));
    use.plunges = random() % 2 == 0;
    if (random() % 2 == 0) use.width = draw(0.02, 1);
    const SpindleRange spindle = random() % 2 == 0 ? SpindleRange{} : SpindleRange{draw(1000, 8000), 24000};
    const MmPerSecond most_feed(random() % 2 == 0 ? 0 : draw(5, 100));
    const auto material = static_cast<WorkMaterial>(random() % 10);
    const auto warnings = warnings_of(tool, use, material, spindle, most_feed);
    std::set<std::string> before;
    for (const ToolWarning& warning : warnings) before.insert(warning.code);
    for (const ToolWarning& warning : warnings) {
      ASSERT_FALSE(warning.advice.empty());
      if (warning.advice.starts_with("another tool")) {
        ++hopeless;
        continue;
      }
      ++followed;
      for (const ToolWarning& after : warnings_of(tool, warning.advised, material, spindle, most_feed)) {
        ASSERT_NE(after.code, warning.code) << trial << ": " << warning.message << "; " << warning.advice;
        ASSERT_TRUE(before.contains(after.code)) << trial << ": " << warning.advice << " brings " << after.message;
      }
    }
  }
  EXPECT_GT(followed, 5000U);
  EXPECT_LT(hopeless * 5, followed);
}

}  // namespace
}  // namespace passo
