// GrblExecuted: which part of the path a Grbl machine has executed, from its answers and its reported positions.
//
// Such a machine does not report the line that it executes. A line that it has answered lies in its planner, or is
// executed. The planner has few blocks, so lines before the last ones are executed for sure. Among the others, the
// first one that leads through the reported position is taken to be executing; a piece on which the machine would go
// back is done. So the result is never ahead of the machine, as long as its reports are true.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "passo/geometry/curve.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Returns the distance of a point from a curve. Arcs and splines count as sixteen chords.
double grbl_distance(const Curve& curve, const Point& place);

class GrblExecuted {
 public:
  // Sets an observer of each piece that is executed to its end, in order.
  void watch_passed(std::function<void()> watcher) { passed_ = std::move(watcher); }
  // Adds a piece of path, whose last line is the `lines`-th of all lines of the sender. `time`: its nominal time;
  // `work_zero`: the zero of the work coordinate system for it.
  void add(const Curve& curve, const OperationSource& source, Seconds time, std::uint64_t lines,
           const Point& work_zero = {});
  // Adds a dwell before the next piece.
  void add_dwell(Seconds time) { dwell_ += time; }
  // `answered`: how many lines were answered; `blocks`: how many of them the machine may still hold.
  void hear(std::uint64_t answered, std::size_t blocks, const Point& place);
  // The machine is idle, and has answered all lines.
  void finish();

  // The line that is executed, or that was executed last. Line 0: none yet.
  const OperationSource& source() const { return now_; }
  // Its zero of the work coordinate system, machine coordinates.
  const Point& work_zero() const { return work_zero_; }
  // The last line that the machine may be executing.
  std::uint32_t last_line() const { return last_line_; }
  // The nominal time of what is executed, including the part of the present piece. `dwell_left`: how long the machine
  // still dwells at the end of that piece.
  Seconds time(std::optional<Seconds> dwell_left = {}) const;

 private:
  struct Piece {
    Curve curve;
    OperationSource source;
    Seconds time{0};
    Seconds dwell{0};  // before it
    std::uint64_t lines = 0;
    Point work_zero;
  };
  void enter();  // the first piece
  void pass();
  bool has_begun() const;  // the first piece

  std::function<void()> passed_;
  std::deque<Piece> pieces_;
  OperationSource now_;
  Point work_zero_;
  std::uint32_t last_line_ = 0;
  Seconds time_{0};
  Seconds dwell_{0};  // after the last piece
  double share_ = 0;  // executed part of the first piece, 0 to 1
};

}  // namespace passo
