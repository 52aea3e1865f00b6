// PlannedAhead: what of a work's motion is planned and not made yet. Motion is planned before it is made, so what a
// part of the plan means (its line, its share of the program) counts from the time at which the board makes it. Private
// to session/.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "progress_ahead.hpp"

#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// The lines of the program whose motion is planned, and when their motion begins.
class LinesAhead {
 public:
  void plan(const OperationSource& line, Seconds begins, Seconds now) {
    static_cast<void>(at(now));
    const OperationSource& last = ahead_.empty() ? now_ : ahead_.back().line;
    if (line.line == last.line && line.line_number == last.line_number) return;
    ahead_.push_back({.line = line, .begins = begins});
  }
  const OperationSource& at(Seconds time) {
    for (; !ahead_.empty() && ahead_.front().begins <= time; ahead_.pop_front()) now_ = ahead_.front().line;
    return now_;
  }

 private:
  struct Planned {
    OperationSource line;
    Seconds begins{0};
  };
  std::deque<Planned> ahead_;
  OperationSource now_;
};

class PlannedAhead {
 public:
  // `whole`: the nominal time of the program; 0: the work tells no progress.
  void begin(const Point& place, const std::vector<PathItem>& lead_in, const MotionLimits& limits, Seconds whole) {
    place_ = place;
    progress_.begin_with(lead_in, limits);
    whole_ = whole;
  }
  void plan(const PlannedMove& move, const MotionLimits& limits, Seconds begins, Seconds ends, Seconds now) {
    place_ = move.segment.tool_at(move.to);
    lines_.plan(move.segment.source, begins, now);
    progress_.plan(nominal_time_of(move, limits), begins, ends, now);
  }
  void plan(const Action& action, Seconds begins, Seconds ends, Seconds now) {
    if (action.dwell > Seconds(0)) progress_.plan(action.dwell, begins, ends, now);
    if (action.kind == Action::Kind::program_end) program_ends_ = ends;
  }

  // The end of the planned path.
  const Point& place() const { return place_; }
  const OperationSource& line_at(Seconds time) { return lines_.at(time); }
  // The part of the program that is executed then, 0 to 1. `left_out`: the nominal time before the place where the
  // motion began. Empty: the work tells no progress.
  std::optional<double> progress_at(Seconds time, Seconds left_out) {
    if (!(whole_ > Seconds(0))) return {};
    return std::min((left_out + std::max(progress_.at(time), Seconds(0))) / whole_, 1.0);
  }
  bool plans_program_end() const { return program_ends_.has_value(); }
  // True, once: an M2 or M30 was planned, and the motion before it is made.
  bool take_program_end(Seconds time) {
    const bool has_ended = program_ends_ && time >= *program_ends_;
    if (has_ended) program_ends_.reset();
    return has_ended;
  }
  bool take_program_end() { return std::exchange(program_ends_, std::nullopt).has_value(); }

 private:
  Point place_;
  LinesAhead lines_;
  ProgressAhead progress_;
  std::optional<Seconds> program_ends_;
  Seconds whole_{0};
};

}  // namespace passo
