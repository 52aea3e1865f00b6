// PathPlaces: judges from the steps whether a machine stays on its programmed path, whatever disturbs the motion. It
// shares no code with the planning.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "kit/step_log.hpp"
#include <fmt/format.h>

#include "passo/machine_file/machine_description.hpp"
#include "passo/path/segment.hpp"

namespace passo::test {

class PathPlaces {
 public:
  void note(const PathItem& item) {
    const auto* segment = std::get_if<Segment>(&item);
    if (segment == nullptr) return;
    const Curve& curve = segment->curve;
    const double turn = curve.curvature() * curve.length().value();
    const int chords = turn > 0 ? std::clamp(static_cast<int>(turn / 0.02), 16, 2000) : 1;
    const double height = turn * curve.length().value() / (8.0 * chords * chords);  // of a chord
    // That of the junctions at both ends, and a thousandth on an exact path.
    const double own = segment->tolerance.value();
    const double own_turn = segment->turn_tolerance > 0 ? segment->turn_tolerance : own;
    const double tolerance = std::max({own, last_tolerance_, 0.001});
    const double turn_tolerance = std::max({own_turn, last_turn_tolerance_, 0.001});
    Piece piece{.from = curve.start(), .tolerance = tolerance + height, .degree = tolerance / turn_tolerance};
    last_tolerance_ = own;
    last_turn_tolerance_ = own_turn;
    for (int i = 1; i <= chords; ++i) {
      piece.to = curve.at(curve.length() * (static_cast<double>(i) / chords));
      pieces_.push_back(piece);
      piece.from = piece.to;
    }
  }

  // Returns the first of some hundred places that is too far from the path. Nothing if all are on it.
  std::optional<std::string> fault(const MachineDescription& machine, const StepLog::Steps& steps) const {
    constexpr std::size_t looks = 300;
    if (pieces_.empty()) return {};
    for (unsigned m = 0; m < machine.axes.size(); ++m) {
      const std::size_t apart = std::max<std::size_t>(steps[m].size() / looks, 1);
      for (std::size_t i = 0; i < steps[m].size(); i += apart) {
        const double excess = excess_at(machine, steps[m][i].place);
        if (excess <= 0) continue;
        return fmt::format("{:.5f} farther from the path than allowed at {:.4f} s", excess,
                           static_cast<double>(steps[m][i].tick) / machine.board.clock.value());
      }
    }
    return {};
  }

 private:
  struct Piece {
    Point from = {};
    Point to = {};
    double tolerance = 0;
    double degree = 1;  // how much a degree counts, in mm
  };

  using Place = std::array<std::int64_t, StepLog::motors>;

  // How far the machine is from a point of the path. A motor is up to its backlash away from its axis, and up to two
  // steps by rounding.
  static double distance(const MachineDescription& machine, const Place& place, const Piece& piece, double share) {
    double sum = 0;
    for (unsigned m = 0; m < machine.axes.size(); ++m) {
      const AxisDescription& axis = machine.axes[m];
      const double nearest = std::lerp(piece.from[axis.axis], piece.to[axis.axis], share);
      const double away = std::abs(static_cast<double>(place[m]) / axis.steps_per_unit - nearest);
      const double rounding = 2 / std::abs(axis.steps_per_unit) + (axis.screw ? axis.screw->backlash : 0);
      const double excess = std::max(away - rounding, 0.0) * (is_rotary(axis.axis) ? piece.degree : 1);
      sum += excess * excess;
    }
    return std::sqrt(sum);
  }
  // Along a piece the distance has one minimum.
  static double distance(const MachineDescription& machine, const Place& place, const Piece& piece) {
    double low = 0;
    double high = 1;
    for (int i = 0; i < 30; ++i) {
      const double first = low + (high - low) / 3;
      const double second = high - (high - low) / 3;
      if (distance(machine, place, piece, first) < distance(machine, place, piece, second)) {
        high = second;
      } else {
        low = first;
      }
    }
    return distance(machine, place, piece, low);
  }
  // How much farther the machine is from all of the path than the tolerance allows. It is mostly near the piece at
  // which it was before.
  double excess_at(const MachineDescription& machine, const Place& place) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const std::size_t k = (near_ + i) % pieces_.size();
      least = std::min(least, distance(machine, place, pieces_[k]) - pieces_[k].tolerance);
      if (least > 0) continue;
      near_ = k;
      break;
    }
    return least;
  }

  std::vector<Piece> pieces_;
  double last_tolerance_ = 0;
  double last_turn_tolerance_ = 0;
  mutable std::size_t near_ = 0;
};

}  // namespace passo::test
