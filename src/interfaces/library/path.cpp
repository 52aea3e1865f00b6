#include <cmath>
#include <numbers>

#include "inner_types.hpp"
#include "path_content.hpp"
#include <fmt/format.h>

#include "passo/geometry/plane_arc.hpp"
#include "passo/interpreter/plane_axes.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo::v1 {
namespace {

constexpr double farthest_mm = 1e5;
constexpr double farthest_degrees = 1e7;
constexpr double largest_tolerance = 100;
constexpr double longest_dwell = 86'400;
constexpr int most_turns = 1000;
constexpr double least_limit = 1e-3;
constexpr double most_velocity = 1e5;
constexpr double most_acceleration = 1e6;
constexpr double most_jerk = 1e9;
constexpr std::size_t most_errors = 20;
// Shorter pieces are rounding errors.
constexpr passo::Mm still{1e-9};
// How far merged lines may leave the path, as in a program: a part of the tolerance.
constexpr double merge_share = 0.05;

passo::PlaneAxes axes_of(ArcPlane plane) {
  switch (plane) {
    case ArcPlane::zx: return passo::axes_of(passo::Plane::zx);
    case ArcPlane::yz: return passo::axes_of(passo::Plane::yz);
    case ArcPlane::xy: break;
  }
  return passo::axes_of(passo::Plane::xy);
}

// Also false for values that are no numbers.
bool is_within(double value, double low, double high) {
  return value >= low && value <= high;
}

class PathErrors {
 public:
  PathErrors(const Path::Content& path, const Limits& limits) : path_(path), limits_(limits) {}

  std::vector<Finding> find() {
    check_limits();
    check_place(path_.start);
    Position from = path_.start;
    for (const PathPiece& piece : path_.pieces) {
      ++number_;
      if (errors_.size() >= most_errors) break;
      check(piece, from);
      if (piece.kind != PathPiece::Kind::stop) from = piece.end;
    }
    if (path_.pieces.size() > most_pieces) {
      number_ = 0;
      add("plan.too-long", fmt::format("the path has {} pieces", path_.pieces.size()),
          fmt::format("at most {} pieces", most_pieces));
    }
    return std::move(errors_);
  }

 private:
  void add(const char* code, std::string message, std::string expected) {
    errors_.push_back(error_of(code, "path", number_, std::move(message), std::move(expected)));
  }

  void check_limits() {
    const auto check_value = [this](Axis axis, const char* what, double value, double most) {
      if (is_within(value, least_limit, most)) return;
      add("plan.limit", fmt::format("the {} of {} is {}", what, letter_of(axis), value),
          fmt::format("{} to {:g}", least_limit, most));
    };
    for (const Axis axis : all_axes) {
      const AxisLimits& own = limits_[axis];
      if (own.velocity_mm_per_s == 0) continue;
      check_value(axis, "velocity", own.velocity_mm_per_s, most_velocity);
      check_value(axis, "acceleration", own.acceleration_mm_per_s2, most_acceleration);
      if (own.jerk_mm_per_s3 != 0) check_value(axis, "jerk", own.jerk_mm_per_s3, most_jerk);
    }
  }

  void check_place(const Position& place) {
    for (const Axis axis : all_axes) {
      const double most = passo::is_rotary(inner(axis)) ? farthest_degrees : farthest_mm;
      if (is_within(place[axis], -most, most)) continue;
      add("plan.place", fmt::format("{} is {}", letter_of(axis), place[axis]),
          fmt::format("{:g} to {:g}", -most, most));
    }
  }

  void check(const PathPiece& piece, const Position& from) {
    if (piece.kind == PathPiece::Kind::stop) {
      if (!is_within(piece.dwell, 0, longest_dwell)) {
        add("plan.dwell", fmt::format("the dwell is {} s", piece.dwell), fmt::format("0 to {} s", longest_dwell));
      }
      return;
    }
    check_place(piece.end);
    // Infinite is no limit.
    if (!(piece.speed >= least_limit)) {
      add("plan.speed", fmt::format("the speed is {} mm/s", piece.speed), fmt::format("{} mm/s or more", least_limit));
    }
    if (!is_within(piece.tolerance, 0, largest_tolerance)) {
      add("plan.tolerance", fmt::format("the tolerance is {} mm", piece.tolerance),
          fmt::format("0 to {} mm", largest_tolerance));
    }
    if (piece.kind == PathPiece::Kind::arc) check_arc(piece, from);
    for (const Axis axis : all_axes) {
      const bool in_plane = piece.kind == PathPiece::Kind::arc &&
                            (inner(axis) == axes_of(piece.plane).first || inner(axis) == axes_of(piece.plane).second);
      if ((piece.end[axis] == from[axis] && !in_plane) || limits_[axis].velocity_mm_per_s != 0) continue;
      add("plan.no-axis", fmt::format("{} moves, and has no limits", letter_of(axis)),
          fmt::format("a velocity and an acceleration for {}", letter_of(axis)));
    }
  }

  void check_arc(const PathPiece& piece, const Position& from) {
    if (piece.turns == 0 || piece.turns < -most_turns || piece.turns > most_turns) {
      add("plan.turns", fmt::format("the arc has {} turns", piece.turns),
          fmt::format("1 to {}, or -1 to -{}", most_turns, most_turns));
    }
    if (!is_within(piece.first_centre, -farthest_mm, farthest_mm) ||
        !is_within(piece.second_centre, -farthest_mm, farthest_mm)) {
      add("plan.place", fmt::format("the centre is {}, {}", piece.first_centre, piece.second_centre),
          fmt::format("{:g} to {:g}", -farthest_mm, farthest_mm));
      return;
    }
    const passo::PlaneAxes axes = axes_of(piece.plane);
    const auto radius = [&](const Position& place) {
      return std::hypot(place[outer(axes.first)] - piece.first_centre, place[outer(axes.second)] - piece.second_centre);
    };
    if (radius(from) < least_limit || radius(piece.end) < least_limit) {
      add("plan.radius",
          fmt::format("the radius of the arc is {} mm at its start, and {} at its end", radius(from),
                      radius(piece.end)),
          fmt::format("{} mm or more", least_limit));
    }
  }

  const Path::Content& path_;
  const Limits& limits_;
  std::uint32_t number_ = 0;
  std::vector<Finding> errors_;
};

passo::Curve curve_of(const PathPiece& piece, const passo::Point& from) {
  const passo::Point end = point_of(piece.end);
  if (piece.kind == PathPiece::Kind::line) return passo::Curve::line(from, end);
  const auto [first, second, normal] = axes_of(piece.plane);
  const double start_angle = std::atan2(from[second] - piece.second_centre, from[first] - piece.first_centre);
  const double end_angle = std::atan2(end[second] - piece.second_centre, end[first] - piece.first_centre);
  return passo::Curve::arc(from, end, first, second, piece.first_centre, piece.second_centre,
                           passo::sweep_between(start_angle, end_angle, piece.turns));
}

}  // namespace

Path::Path(const Position& start) : content_(std::make_unique<Content>()) {
  content_->start = start;
}
Path::Path(const Path& other) : content_(std::make_unique<Content>(*other.content_)) {}
Path::Path(Path&& other) noexcept = default;
Path& Path::operator=(Path other) noexcept {
  content_ = std::move(other.content_);
  return *this;
}
Path::~Path() = default;

void Path::set_tolerance(double tolerance_mm) {
  content_->tolerance = tolerance_mm;
}

void Path::line_to(const Position& end, double speed_mm_per_s) {
  content_->pieces.push_back(
      {.kind = PathPiece::Kind::line, .end = end, .speed = speed_mm_per_s, .tolerance = content_->tolerance});
}

void Path::arc_to(const Position& end, ArcPlane plane, double first_centre_mm, double second_centre_mm, int turns,
                  double speed_mm_per_s) {
  content_->pieces.push_back({.kind = PathPiece::Kind::arc,
                              .plane = plane,
                              .turns = turns,
                              .end = end,
                              .first_centre = first_centre_mm,
                              .second_centre = second_centre_mm,
                              .speed = speed_mm_per_s,
                              .tolerance = content_->tolerance});
}

void Path::stop(double dwell_s) {
  content_->pieces.push_back({.kind = PathPiece::Kind::stop, .end = end(), .dwell = dwell_s});
}

std::size_t Path::size() const {
  return content_->pieces.size();
}

Position Path::end() const {
  return content_->pieces.empty() ? content_->start : content_->pieces.back().end;
}

std::vector<Finding> errors_of(const Path::Content& path, const Limits& limits) {
  return PathErrors(path, limits).find();
}

PathPieces::PathPieces(const Path::Content& path) : path_(path), position_(point_of(path.start)) {}

bool PathPieces::next(passo::PathItem& item) {
  while (next_ < path_.pieces.size()) {
    const PathPiece& piece = path_.pieces[next_++];
    const passo::OperationSource source{.line = static_cast<std::uint32_t>(next_)};
    if (piece.kind == PathPiece::Kind::stop) {
      item = passo::Action{.kind = passo::Action::Kind::dwell, .dwell = passo::Seconds(piece.dwell), .source = source};
      return true;
    }
    const passo::Curve curve = curve_of(piece, position_);
    if (curve.length() < still) continue;
    position_ = curve.end();
    const bool stops = piece.tolerance == 0;
    const bool is_unlimited = piece.speed > passo::fastest;
    item = passo::Segment{.curve = curve,
                          .speed = passo::MmPerSecond(is_unlimited ? unlimited : piece.speed),
                          .rapid = is_unlimited,
                          .mode = stops ? passo::PathMode::exact_path : passo::PathMode::continuous,
                          .tolerance = passo::Mm(piece.tolerance),
                          .merge = passo::Mm(piece.tolerance * merge_share),
                          .source = source};
    return true;
  }
  return false;
}

}  // namespace passo::v1
