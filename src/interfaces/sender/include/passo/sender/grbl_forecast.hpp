// GrblForecast: predicts how long a Grbl board takes for the lines that GrblCode writes, and whether the connection is
// fast enough for them.
//
// Position in the pipeline: beside GrblSender, which sends the same lines. The lines are sent as the sender does it:
// the bytes of unanswered lines fill the receive buffer at most, and the board answers a line when its planner has
// taken it. A second planner, which receives every line in time, shows how much time the connection costs.
//
// The times are those of the board's planner: neither the debounce of switches nor the operator is in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string_view>

#include "passo/geometry/axes.hpp"
#include "passo/grbl_planner/grbl_planner.hpp"
#include "passo/sender/grbl_line_reader.hpp"
#include "passo/sender/grbl_machine.hpp"
#include "passo/sender/grbl_target.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The connection to the board.
struct GrblLine {
  double bytes_per_second = 11520;  // 115,200 baud: ten bits per byte. 0: without limit, as on a network
  std::size_t buffer = 128;         // receive buffer of the board, bytes
};

// Returns the board's settings as limits, from its answers to $$ and $I. Values that it has not reported are those of
// Grbl's own defaults; without steps per unit ($100 …) no axis exists.
GrblLimits limits_of(const GrblMachine& machine);

class GrblForecast {
 public:
  struct Result {
    Seconds time{0};        // until the board rests
    Seconds unhindered{0};  // the same if every line arrives in time
    // The highest feed at which the connection keeps up with the densest lines; 0: every feed.
    MmPerSecond feed_carried{0};
    std::uint32_t densest_line = 0;  // where: the source of the first of these lines
  };

  // The board rests at `start`, in machine coordinates; `target`: as for GrblCode.
  GrblForecast(const GrblLimits& limits, const GrblLine& line, const Point& start, const GrblTarget& target);

  // Sets a listener for the phases of the motion, in order.
  void hear(std::function<void(const GrblPhase&)> listener) { hindered_.hear(std::move(listener)); }
  // Adds a line of GrblCode, without its line end. `source`: the line of the program.
  void add(std::string_view text, std::uint32_t source);
  // Waits for the end of the motion.
  Result finish();

 private:
  struct Sent {
    std::size_t bytes = 0;
    double answered = 0;
  };
  // Lines whose bytes take the connection a while, and what they move.
  struct Stretch {
    double bytes = 0;
    double length = 0;
    std::uint32_t source = 0;
  };

  static Seconds run(GrblPlanner& planner, const GrblLineMotion& line, std::uint32_t source, Seconds when);
  double arrival(std::size_t bytes);
  void weigh(std::size_t bytes, double length, std::uint32_t source);

  GrblLimits limits_;
  GrblLine line_;
  GrblLineReader reader_;
  GrblPlanner hindered_;
  GrblPlanner unhindered_;
  std::deque<Sent> unanswered_;
  std::size_t unanswered_bytes_ = 0;
  double free_at_ = 0;  // when the connection has sent all bytes
  double answered_ = 0;
  double answered_unhindered_ = 0;
  std::deque<Stretch> window_;
  double window_bytes_ = 0;
  double window_length_ = 0;
  Result result_;
};

}  // namespace passo
