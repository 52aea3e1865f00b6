// PlannedAhead: the planned but not yet executed motion of a work item. The data of a planned part (its line, its zero,
// its share of the program) take effect at the time at which the board executes that part. Private to session/.
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

// A program line, and the zero of the work coordinate system for its motion.
struct PlannedLine {
  OperationSource source;
  Point work_zero;

  bool is_as(const PlannedLine& other) const {
    return source.line == other.source.line && source.line_number == other.source.line_number &&
           work_zero == other.work_zero;
  }
};

// The program lines of the planned motion, with the start times of their motion.
class LinesAhead {
 public:
  void plan(const PlannedLine& line, Seconds begins, Seconds now) {
    static_cast<void>(at(now));
    if (line.is_as(ahead_.empty() ? now_ : ahead_.back().line)) return;
    ahead_.push_back({.line = line, .begins = begins});
  }
  const PlannedLine& at(Seconds time) {
    for (; !ahead_.empty() && ahead_.front().begins <= time; ahead_.pop_front()) now_ = ahead_.front().line;
    return now_;
  }

 private:
  struct Planned {
    PlannedLine line;
    Seconds begins{0};
  };
  std::deque<Planned> ahead_;
  PlannedLine now_;
};

class PlannedAhead {
 public:
  // `whole`: the nominal time of the program; 0: no progress is reported.
  void begin(const Point& place, const std::vector<PathItem>& lead_in, const MotionLimits& limits, Seconds whole) {
    place_ = place;
    progress_.begin_with(lead_in, limits);
    whole_ = whole;
  }
  void plan(const PlannedMove& move, const MotionLimits& limits, Seconds begins, Seconds ends, Seconds now) {
    place_ = move.segment.tool_at(move.to);
    lines_.plan({.source = move.segment.source, .work_zero = move.segment.work_zero}, begins, now);
    progress_.plan(nominal_time_of(move, limits), begins, ends, now);
  }
  void plan(const Action& action, Seconds begins, Seconds ends, Seconds now) {
    if (action.dwell > Seconds(0)) progress_.plan(action.dwell, begins, ends, now);
    if (action.kind == Action::Kind::program_end) program_ends_ = ends;
  }

  // The end of the planned path.
  const Point& place() const { return place_; }
  const PlannedLine& line_at(Seconds time) { return lines_.at(time); }
  // Returns the fraction of the program executed at that time, 0 to 1. `left_out`: the nominal time before the point
  // where the motion began. Empty: no progress is reported.
  std::optional<double> progress_at(Seconds time, Seconds left_out) {
    if (!(whole_ > Seconds(0))) return {};
    return std::min((left_out + std::max(progress_.at(time), Seconds(0))) / whole_, 1.0);
  }
  bool plans_program_end() const { return program_ends_.has_value(); }
  // Returns true once, if an M2 or M30 was planned, and the motion before it is executed.
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
