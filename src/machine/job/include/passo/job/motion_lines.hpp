// Finds the program line that makes the motion at a position or at a time, for messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "passo/geometry/axes.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// Records which program line made which part of the latest motion, at least as far back as the length of the board's
// queue.
class LatestMotion {
 public:
  void watch(const MotionItem& motion);
  // Returns the line whose motion comes nearest to `place`; if several do, the first. 0: nothing has moved.
  std::uint32_t line_at(const Point& place) const;

 private:
  static constexpr std::size_t most_pieces = 4000;
  struct Piece {
    std::uint32_t line = 0;
    Point from;
    Point to;
  };
  std::deque<Piece> pieces_;
};

// Records at which time each program line is executed. Motion is planned ahead of the board, so the lines of unexecuted
// motion are kept.
class PlannedLines {
 public:
  // `begins`: the board's time at the start of the program.
  explicit PlannedLines(Seconds begins) : planned_(begins) {}
  // Adds planned motion, in order.
  void watch(const MotionItem& motion);
  // Returns the line executed at `time`, which must not be in the dropped past. After the planned motion: the last
  // line. 0: nothing is planned.
  std::uint32_t line_at(Seconds time) const;
  void forget_before(Seconds time);

 private:
  struct Planned {
    Seconds end{0};
    std::uint32_t line = 0;
  };
  Seconds planned_;
  std::deque<Planned> ahead_;
};

}  // namespace passo
