#include "passo/study/step_move.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

constexpr std::int64_t largest = 2'147'483'647;

std::string complaint(const StepMove& move) {
  const Status<std::string> status = check(move);
  return status ? "" : status.error();
}
StepMove arc(Place from, Place to, Place centre) {
  return {.from = std::move(from), .to = std::move(to), .arc = StepMove::Arc{.centre = std::move(centre)}};
}

TEST(StepMove, within_the_range_is_good) {
  EXPECT_EQ(complaint({.from = {0, 0}, .to = {largest, -largest}, .arc = {}}), "");
  EXPECT_EQ(complaint({.from = {7}, .to = {7}, .arc = {}}), "");
  EXPECT_EQ(complaint(arc({15, 5}, {5, 15}, {5, 5})), "");
  EXPECT_EQ(complaint(arc({10, 0}, {7, 7}, {0, 0})), "");  // 9.9 from the centre
}

TEST(StepMove, beyond_the_range_says_what_is_wrong) {
  EXPECT_THAT(complaint({.from = {0, 0}, .to = {1, 2, 3}, .arc = {}}), HasSubstr("2 axes and ends with 3"));
  EXPECT_THAT(complaint({.from = {-1}, .to = {largest}, .arc = {}}), HasSubstr("2147483648 steps long in x"));
  EXPECT_THAT(complaint({.from = {0}, .to = {largest + 1}, .arc = {}}), HasSubstr("exceeds 2147483647"));
  EXPECT_THAT(complaint({.from = Place(9, 0), .to = Place(9, 1), .arc = {}}), HasSubstr("9 axes; expected one to 8"));
  EXPECT_THAT(complaint(arc({10, 0}, {0, 12}, {0, 0})),
              HasSubstr("10 steps from the centre at its start, 12 at its end"));
  EXPECT_THAT(complaint(arc({1, 1}, {0, 12}, {1, 1})), HasSubstr("starts at its centre"));
  EXPECT_THAT(complaint(arc({1, 1, 1}, {0, 12, 1}, {1, 1})), HasSubstr("two axes"));
}

TEST(StepMove, is_seen_from_its_start_or_its_centre) {
  const LineDistances found = distances({.from = {3, 4}, .to = {1, 10}, .arc = {}});
  EXPECT_EQ(found.all[0], -2);
  EXPECT_EQ(found.all[1], 6);
  EXPECT_EQ(found.all[2], 0);
  const ArcPoints points = arc_points(arc({15, 5}, {5, 15}, {5, 5}));
  EXPECT_EQ(points.start[0], 10);
  EXPECT_EQ(points.end[1], 10);
}

}  // namespace
}  // namespace passo
