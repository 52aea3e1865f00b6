#include "passo/path/path_smoother.hpp"

#include "smoothing_kit.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using test::apart;
using test::Faults;
using test::Random;
using test::RandomPath;
using test::segments_of;
using test::smooth;
using test::xyz;

class PathSmootherTest : public testing::Test {
 protected:
  Segment& add(const Curve& curve) {
    path_.emplace_back(Segment{.curve = curve,
                               .speed = MmPerSecond(50),
                               .tolerance = Mm(tolerance_),
                               .merge = Mm(tolerance_ * 0.05),
                               .source = {.line = static_cast<std::uint32_t>(path_.size() + 1)}});
    position_ = curve.end();
    return std::get<Segment>(path_.back());
  }
  Segment& go(double x, double y, double z = 0) { return add(Curve::line(position_, xyz(x, y, z))); }
  Segment& arc(double x, double y, double center_x, double center_y, double sweep) {
    return add(Curve::arc(position_, xyz(x, y), Axis::x, Axis::y, center_x, center_y, sweep));
  }
  void expect_good(const std::vector<PathItem>& path) {
    const Faults faults = test::faults_of(path, smooth(path));
    EXPECT_LE(faults.excess, 1e-9) << faults.where;
    EXPECT_EQ(faults.gaps, 0U);
    EXPECT_LT(faults.tangent_jump, 1e-9);
    EXPECT_LT(faults.bend_jump, 1e-4);
  }
  std::vector<Segment> smoothed() { return segments_of(smooth(path_)); }
  static std::size_t cubics(const std::vector<Segment>& segments) {
    return static_cast<std::size_t>(std::ranges::count_if(
        segments, [](const Segment& segment) { return segment.curve.shape() == Curve::Shape::cubic; }));
  }
  static std::size_t stops(const std::vector<Segment>& segments) {
    return static_cast<std::size_t>(
        std::ranges::count(segments, PathMode::exact_stop, [](const Segment& segment) { return segment.mode; }));
  }

  std::vector<PathItem> path_;
  Point position_;
  double tolerance_ = 0.01;
};

TEST_F(PathSmootherTest, random_paths_stay_in_the_tube_without_a_gap_or_a_bend) {
  Random random;
  long extra = 0, all = 0;
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE(round);
    RandomPath drawn(random);
    drawn.rotary = round % 3 == 0;
    drawn.merge_share = 0;
    const std::vector<PathItem> path = drawn.draw(150);
    expect_good(path);
    {
      extra += stops(segments_of(smooth(path))) - test::rests_of(path);
      all += test::rests_of(path);
    }
    if (HasFailure()) break;
  }
  std::printf("extra %ld all %ld\n", extra, all);
}

}  // namespace
}  // namespace passo
