#include "passo/activity/low_rapids.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double nothing = 1e-3;  // mm: less is rounding in programs

}  // namespace

LowRapids::LowRapids(const MachineDescription& machine, std::string file, Diagnostics& diagnostics)
    : OperationWatcher(std::move(file), diagnostics),
      has_height_(std::ranges::all_of(std::array{Axis::x, Axis::y, Axis::z}, [&](Axis axis) {
        return std::ranges::find(machine.axes, axis, &AxisDescription::axis) != machine.axes.end();
      })) {}

void LowRapids::watch(const Operation& operation) {
  using namespace passo::operation;
  if (!has_height_) return;
  const OperationKind& what = operation.what;
  if (const auto* line = std::get_if<StraightFeed>(&what)) return feed_to(line->end);
  if (const auto* arc = std::get_if<ArcFeed>(&what)) return feed_to(arc->end);
  if (const auto* rapid = std::get_if<StraightTraverse>(&what)) return rapid_to(operation, rapid->end);
  if (const auto* probe = std::get_if<StraightProbe>(&what)) {
    end_descent();
    place_ = probe->end;
  } else if (std::holds_alternative<NurbsFeed>(what)) {
    end_descent();
    place_.reset();  // somewhere in X and Y
  } else if (std::holds_alternative<SetToolOffset>(what)) {
    end_descent();
    place_.reset();
  } else if (std::holds_alternative<SetWorkOffset>(what) || std::holds_alternative<SetG92Offset>(what) ||
             std::holds_alternative<SetRotation>(what)) {
    forget_heights();
  }
}

void LowRapids::feed_to(const Point& end) {
  const double z = end[Axis::z];
  if (place_ && z < (*place_)[Axis::z] - nothing) {
    descends_ = true;
  } else {
    end_descent();
  }
  place_ = end;
  deepest_ = std::min(deepest_.value_or(z), z);
}

void LowRapids::end_descent() {
  if (!std::exchange(descends_, false) || !place_) return;
  const double z = (*place_)[Axis::z];
  top_ = std::max(top_.value_or(z), z);
}

void LowRapids::rapid_to(const Operation& operation, const Point& end) {
  end_descent();
  const std::optional<Point> from = std::exchange(place_, end);
  if (!from) return;
  const double z = end[Axis::z];
  const bool sideways = std::hypot(end[Axis::x] - (*from)[Axis::x], end[Axis::y] - (*from)[Axis::y]) > nothing;
  if (sideways && top_ && z <= *top_ + nothing && !std::exchange(told_sideways_, true)) {
    diagnostics_.add_certain(
        warning(operation, "path.low-rapid",
                fmt::format("a rapid goes sideways at Z{:.6g}, and the program has cut at Z{:.6g}", z, *top_),
                "Z above the work before a rapid goes sideways, or a feed (G1)"));
  }
  const bool down = z < (*from)[Axis::z] - nothing;
  if (!sideways && down && deepest_ && z < *deepest_ - nothing && !std::exchange(told_down_, true)) {
    diagnostics_.add_certain(
        warning(operation, "path.rapid-plunge",
                fmt::format("a rapid goes down to Z{:.6g}, deeper than all feeds before it (Z{:.6g})", z, *deepest_),
                "a feed (G1) where there may be material"));
  }
}

void LowRapids::forget_heights() {
  end_descent();
  place_.reset();
  top_.reset();
  deepest_.reset();
}

}  // namespace passo
