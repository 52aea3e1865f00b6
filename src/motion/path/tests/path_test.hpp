// PathTest: converts operations into segments and diagnostics.
#pragma once

#include <string>
#include <vector>

#include "kit/path_text.hpp"
#include "kit/stage_test.hpp"

#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"

namespace passo {

using test::xyz;

class PathTest : public testing::Test {
 protected:
  PathTest() {
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      options_.axes.add(axis);
      options_.travel[axis] = {.low = -100, .high = 300};
    }
    options_.file = "part.ngc";
  }

  template <class What>
  void add(What what) {
    operations_.push_back({.what = what, .source = {.line = static_cast<std::uint32_t>(operations_.size() + 1)}});
  }
  void feed(double rate) { add(operation::SetFeedRate{operation::FeedPerSecond{MmPerSecond(rate), rate}}); }
  void feed_per_revolution(double rate) { add(operation::SetFeedRate{operation::FeedPerRevolution{Mm(rate), rate}}); }
  void go(double x, double y, double z = 0) { add(operation::StraightFeed{xyz(x, y, z)}); }
  void arc(double x, double y, double center_x, double center_y, std::int32_t turns) {
    add(operation::ArcFeed{
        .end = xyz(x, y), .first_center = Mm(center_x), .second_center = Mm(center_y), .turns = turns});
  }

  std::vector<PathItem> build() {
    test::ListSource<Operation> source(operations_);
    PathBuilder builder(source, options_, diagnostics_);
    return test::drain(builder);
  }
  std::vector<Segment> segments() {
    std::vector<Segment> found;
    for (const PathItem& item : build()) {
      if (const auto* segment = std::get_if<Segment>(&item)) found.push_back(*segment);
    }
    return found;
  }
  // Returns the segments with rounded corners, as in a job.
  std::vector<Segment> smoothed_segments() {
    test::ListSource<PathItem> source(build());
    PathSmoother smoother(source);
    std::vector<Segment> found;
    for (const PathItem& item : test::drain(smoother)) {
      if (const auto* segment = std::get_if<Segment>(&item)) found.push_back(*segment);
    }
    return found;
  }
  std::string text() {
    std::string out;
    for (const PathItem& item : build()) out += to_text(item);
    return out;
  }
  std::vector<std::string> codes() const {
    std::vector<std::string> found;
    for (const Diagnostic& diagnostic : diagnostics_.all()) found.push_back(diagnostic.code);
    return found;
  }

  PathOptions options_;
  Diagnostics diagnostics_{1000};
  std::vector<Operation> operations_;
};

}  // namespace passo
