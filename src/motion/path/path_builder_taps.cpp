// PathBuilder: rigid taps (G33.1).
#include <algorithm>
#include <cmath>

#include "path_sentences.hpp"

#include "passo/path/path_builder.hpp"

namespace passo {
namespace {

constexpr double per_minute = 60;
// How much room a spindle may need to come to rest: this many times the room that follows from its run-up, and some
// turns more.
constexpr double room_factor = 2;
constexpr double more_turns = 2;

}  // namespace

// The tap goes down in step with the spindle, goes on until the spindle has reversed, and goes back in step to where
// the tap began.
bool PathBuilder::begin_tap(const operation::RigidTap& tap, PathItem& item) {
  if (options_.awaits_spindle_speed) {
    report(Severity::error, "path.tap-on-bus", path_says::tap_on_bus, path_says::not_on_bus);
    return false;
  }
  if (answers_.tap_reversal() == nullptr) return expand(tap), false;
  tap_start_ = position_;
  if (!add_line(tap.end, false, item)) return false;
  auto& down = std::get<Segment>(item);
  down.mode = PathMode::exact_stop;
  down.reverse_at = down.curve.length();
  down.curve = Curve::line(
      tap_start_, down.curve.at(down.curve.length()) + down.curve.tangent(Mm(0)) * room_to_turn(down.curve).value());
  followed_tap_ = TapStep::turn;
  return true;
}

bool PathBuilder::next_tap_step(PathItem& item) {
  switch (followed_tap_) {
    case TapStep::none: return false;
    case TapStep::turn: {
      followed_tap_ = TapStep::back;
      commanded_.spindle = reversed(commanded_.spindle);
      handed_on_ = outputs();
      item =
          Action{.kind = Action::Kind::tap_turns, .outputs = outputs(), .heeds = heeds(), .source = operation_.source};
      return true;
    }
    case TapStep::back: {
      followed_tap_ = TapStep::end;
      position_ = *answers_.tap_reversal();
      if (add_curve(Curve::line(position_, tap_start_), false, item)) {
        std::get<Segment>(item).mode = PathMode::exact_stop;
        return true;
      }
      [[fallthrough]];
    }
    case TapStep::end: {
      followed_tap_ = TapStep::none;
      commanded_.spindle = reversed(commanded_.spindle);
      return false;
    }
  }
  return false;
}

// A tap that does not follow the spindle through the reversal. It goes down to its end at the spindle's speed, reverses
// the spindle, and goes back to where it began.
void PathBuilder::expand(const operation::RigidTap& tap) {
  tap_ = {operation::StraightFeed{tap.end}, operation::TurnSpindle{reversed(commanded_.spindle)},
          operation::StraightFeed{frame_.work_from_machine(position_)}, operation::TurnSpindle{commanded_.spindle}};
  tap_step_ = 0;
}

// The way in which the spindle comes to rest after a tap's end, as far as the travel allows.
Mm PathBuilder::room_to_turn(const Curve& way) const {
  const double turns_per_second = commanded_.revolutions_per_minute / per_minute;
  const double to_rest = turns_per_second * turns_per_second * options_.spindle_run_up.value() * per_minute / 1000 / 2;
  double room = synchronised_pitch_->value() * (room_factor * to_rest + more_turns);
  const Point end = way.end();
  const Point direction = way.tangent(Mm(0));
  for (const Axis axis : all_axes) {
    if (!options_.axes.has(axis) || direction[axis] == 0) continue;
    const TravelLimit& travel = options_.travel[axis];
    const double left = direction[axis] > 0 ? travel.high - end[axis] : end[axis] - travel.low;
    room = std::min(room, std::max(left / std::abs(direction[axis]), 0.0));
  }
  return Mm(room);
}

}  // namespace passo
