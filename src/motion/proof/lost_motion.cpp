#include "lost_motion.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {
namespace {

constexpr int looks_in_motion = 32;  // where the tool is off the planned path
constexpr int looks = 8;             // in each move; between two of them an axis of a smooth path turns back by little

}  // namespace

LostMotion::LostMotion(const ProofOptions& options, MotionProof& proof) : proof_(proof) {
  for (std::size_t i = 0; i < options.axes.size(); ++i) {
    const ProvenAxis& axis = options.axes[i];
    if (axis.backlash > Mm(0)) plays_.push_back({.number = i, .axis = axis.axis, .backlash = axis.backlash.value()});
  }
}

void LostMotion::watch(const PlannedMove& move, const ExactCurve& curve, Seconds now) {
  way_.clear();
  if (plays_.empty()) return;
  const bool is_off_path = move.segment.lead.has_value();
  const int count = is_off_path ? looks_in_motion : looks;
  const double from = move.from().value();
  for (int i = 0; i <= count; ++i) {
    const Point place = curve.place(from + (move.to.value() - from) * i / count);
    for (Play& play : plays_) {
      if (!begun_) play.place = motor_of(play, move, place[play.axis]);
      follow(play, move, place[play.axis], now);
    }
    begun_ = true;
    if (!is_off_path) continue;
    way_.push_back(place);
    for (const Play& play : plays_) {
      if (play.axis == move.segment.lead->axis) way_.back()[play.axis] = play.place;
    }
  }
}

double LostMotion::motor_of(const Play& play, const PlannedMove& move, double at) {
  return move.segment.downs.has(play.axis) ? at - play.backlash : at;
}

void LostMotion::follow(Play& play, const PlannedMove& move, double at, Seconds now) {
  const double motor = motor_of(play, move, at);
  play.place = std::clamp(play.place, motor, motor + play.backlash);
  if (move.segment.lead && move.segment.lead->axis == play.axis) return;
  const double planned = move.segment.takes_up_backlash ? move.segment.curve.end()[play.axis] : at;
  const double behind = std::abs(planned - play.place);
  Finding& finding = proof_.axes[play.number].lost_motion;
  if (!(behind > finding.value)) return;
  finding.value = behind;
  finding.time = now;
  finding.line = move.segment.source.line;
}

}  // namespace passo::proof
