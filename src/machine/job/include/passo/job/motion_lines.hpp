// Which line of a program makes the motion at a place, or at a time: for words on what has happened there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "passo/geometry/axes.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// Knows which line of the program made which part of the latest motion. The board holds no more than a part of it.
class LatestMotion {
 public:
  void watch(const MotionItem& motion);
  // The line whose motion comes nearest to the place; of several the first. 0: nothing has moved.
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

// Knows which line of the program is played when. Motion is planned ahead of the board, so it keeps the lines whose
// motion has not been played yet.
class PlannedLines {
 public:
  // `begins`: the board's time when the program begins.
  explicit PlannedLines(Seconds begins) : planned_(begins) {}
  // What is planned, in order.
  void watch(const MotionItem& motion);
  // Of a time that was not forgotten. After all that is planned: the last line. 0: nothing is planned.
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
