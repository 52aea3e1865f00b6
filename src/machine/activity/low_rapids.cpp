#include "passo/activity/low_rapids.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "mistake_sentences.hpp"
#include <fmt/format.h>

#include "passo/interpreter/is_any_of.hpp"

namespace passo {
namespace {

constexpr double nothing = 1e-3;  // mm: less is rounding in programs

std::string height(double z) {
  return fmt::format("{:.6g}", z);
}

}  // namespace

LowRapids::LowRapids(const MachineDescription& machine, bool zero_is_known, std::string file, Diagnostics& diagnostics)
    : OperationWatcher(std::move(file), diagnostics),
      has_height_(std::ranges::all_of(std::array{Axis::x, Axis::y, Axis::z},
                                      [&](Axis axis) {
                                        return std::ranges::find(machine.axes, axis, &AxisDescription::axis) !=
                                               machine.axes.end();
                                      })),
      has_spindle_(machine.tool.highest_rpm > 0 && !machine.motion_outputs.laser),
      zero_is_known_(zero_is_known) {}

void LowRapids::watch(const Operation& operation, const ToolTrack& track) {
  using namespace passo::operation;
  if (!has_height_) return;
  if (track.frame_changed()) {
    end_descent(track.from());
    zero_is_known_ |= operation.source.line > 0;
    knows_z_ = false;
    if (is_any_of<SetToolOffset>(operation)) return;
    top_.reset();
    deepest_.reset();
    return;
  }
  if (!is_any_of<StraightTraverse, StraightFeed, ArcFeed, NurbsFeed, StraightProbe>(operation)) return;
  const bool knew_z = knows_z_;
  know_place(operation);
  if (!knows_z_) {
    descends_ = false;
  } else if (is_any_of<StraightFeed, ArcFeed>(operation)) {
    feed(operation, track, knew_z);
  } else {
    end_descent(track.from());
    if (is_any_of<StraightTraverse>(operation)) rapid(operation, track, knew_z);
  }
}

// Where the zero of the work is not known, a place of the machine is nowhere in the work. A Z of the program is.
void LowRapids::know_place(const Operation& operation) {
  const auto has = [&](Axis axis) {
    return operation.axis_words != nullptr && (*operation.axis_words)[axis].column > 0;
  };
  if (operation.in_machine) {
    knows_z_ = knows_z_ && zero_is_known_;
    return;
  }
  knows_z_ |= has(Axis::z) || is_any_of<operation::StraightProbe>(operation);
  if (!is_any_of<operation::StraightTraverse>(operation) || knows_xy_) {
    knows_xy_ = true;
    return;
  }
  knows_xy_ = has(Axis::x) || has(Axis::y);
  const double z = std::get<operation::StraightTraverse>(operation.what).end[Axis::z];
  if (knows_xy_ || !has(Axis::z) || z >= -nothing || is_noted(operation, "path.blind-plunge")) return;
  diagnostics_.add_certain(warning(operation, "path.blind-plunge", mistakes_say::blind_plunge.with({{"z", height(z)}}),
                                   mistakes_say::place_first));
}

void LowRapids::feed(const Operation& operation, const ToolTrack& track, bool knew_z) {
  const double z = track.to()[Axis::z];
  if (knew_z && z < track.from()[Axis::z] - nothing) {
    descends_ = true;
    if (has_spindle_ && !no_depth_ && lowest_ > nothing) {
      no_depth_ = warning(operation, "path.no-depth", {}, mistakes_say::minus_sign);
    }
  } else {
    end_descent(track.from());
  }
  deepest_ = std::min(deepest_.value_or(z), z);
  lowest_ = std::min(lowest_, z);
}

// `end`: where the last feed led.
void LowRapids::end_descent(const Point& end) {
  if (!std::exchange(descends_, false)) return;
  top_ = std::max(top_.value_or(end[Axis::z]), end[Axis::z]);
}

void LowRapids::rapid(const Operation& operation, const ToolTrack& track, bool knew_z) {
  const Point& from = track.from();
  const double z = track.to()[Axis::z];
  const bool sideways = std::hypot(track.to()[Axis::x] - from[Axis::x], track.to()[Axis::y] - from[Axis::y]) > nothing;
  if (sideways && top_ && z <= *top_ + nothing && !is_noted(operation, "path.low-rapid")) {
    diagnostics_.add_certain(warning(operation, "path.low-rapid",
                                     mistakes_say::low_rapid.with({{"z", height(z)}, {"cut", height(*top_)}}),
                                     mistakes_say::above_work));
  }
  const bool down = knew_z && z < from[Axis::z] - nothing;
  if (!sideways && down && deepest_ && z < *deepest_ - nothing && !is_noted(operation, "path.rapid-plunge")) {
    diagnostics_.add_certain(
        warning(operation, "path.rapid-plunge",
                mistakes_say::rapid_plunge.with({{"z", height(z)}, {"deepest", height(*deepest_)}}),
                mistakes_say::feed_in_material));
  }
}

void LowRapids::finish() {
  if (!no_depth_ || lowest_ <= nothing) return;
  no_depth_->message = mistakes_say::no_depth.with({{"z", height(lowest_)}});
  diagnostics_.add_certain(*std::exchange(no_depth_, std::nullopt));
}

}  // namespace passo
