// The words for a stop at once: which switch it was, where in the program, and what to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "opened_machine.hpp"

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

// For a board that has stopped its motors at once: a sentence without a full stop, with a code. Ends the conversation
// with the board, because it asks which switches are closed. `program`: its name; empty: no program moved the machine.
// `known_line`: where that was, if it is known otherwise than by the place.
std::string stop_words(OpenedMachine& opened, const MachineDescription& machine, const std::string& program = {},
                       const LatestMotion& motion = {}, std::uint32_t known_line = 0);

// The same for a board that has stood still amid motion. `line` as known_line.
std::string slip_words(OpenedMachine& opened, const MachineDescription& machine, const std::string& program = {},
                       std::uint32_t line = 0);
// Near which line of the program the board told that the motors have stood still. 0: not known.
std::uint32_t line_of_standstill(OpenedMachine& opened, const MachineDescription& machine, const LatestMotion& motion);

}  // namespace passo
