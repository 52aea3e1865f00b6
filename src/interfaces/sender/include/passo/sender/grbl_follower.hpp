// GrblFollower: follows the motion of a Grbl board from the lines that it was sent and the positions that it reports.
//
// It answers two questions. How long does the board move if it gets nothing more? That bounds what runs on after a lost
// connection: pieces() divides long lines, and may_send() waits while enough motion lies in the board. And does the
// board move where the lines lead? hear() compares each reported position with the path, and check_modes() the modes
// that $G reports.
//
// A model of the board's planner moves along the lines that were sent. Each report corrects its clock: a board that is
// slower (an override, a hold) makes it wait. A position belongs to the path if it lies on it within a few steps,
// between the last known position and the end of the last line that was sent. The age of a report does not matter for
// that, because the path of the last seconds and of all lines ahead is known.
//
// What cannot be noticed: a deviation that begins and ends between two reports, or is within the tolerance.
//
// Invariant: the model holds only lines that were sent, in their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/grbl_planner/grbl_planner.hpp"
#include "passo/sender/grbl_line_reader.hpp"
#include "passo/units/units.hpp"

namespace passo {

class GrblFollower {
 public:
  struct Trouble {
    std::string code;
    std::string message;
    std::uint32_t first_line = 0;
    std::uint32_t last_line = 0;
  };

  // The board rests at `start`, in machine coordinates; `zero`: the work zero, as for GrblCode. `ahead`: how much
  // motion may lie in the board.
  GrblFollower(const GrblLimits& limits, const Point& start, const Point& zero, Seconds ahead);

  // Divides a line that moves for more than a quarter of `ahead`. The last piece ends exactly where the line ends.
  // Lines must be given in their order.
  std::vector<std::string> pieces(const std::string& text);
  // Returns whether the board may get the line now: it moves for at most `ahead` then, or could not keep its speed
  // without the line.
  bool may_send(std::string_view text, Seconds now);
  // A line was sent. `line`: of the program.
  void sent(std::string_view text, std::uint32_t line, Seconds now);
  // How long the board moves from now on if it gets nothing more.
  Seconds time_in_board(Seconds now);

  // How long the board still dwells, if it does not move: with what follows before the next motion. Empty: it moves.
  std::optional<Seconds> dwell_left(Seconds now);

  // False after a line that led to an unknown place.
  bool knows_path() const { return !lost_; }
  // The feed override, as a factor.
  void set_override(double factor) { clock_.factor = factor; }
  // `rests`: nothing moves. `ends`: all lines were answered before the report, and the board is idle.
  std::optional<Trouble> hear(const Point& place, bool rests, bool ends, Seconds now);
  // `modes`: from [GC:…], after all lines that were sent before the question. `expected`: modes() of that time.
  std::optional<Trouble> check_modes(std::string_view modes, const GrblLineModes& expected, bool in_inches) const;
  const GrblLineModes& modes() const { return sent_reader_.modes(); }
  // The longest time between two reports of different positions, at the slowest feed that lies ahead.
  Seconds longest_between_changes() const;
  // The line in which the board was last, and the last one that it has.
  std::uint32_t first_line() const;
  std::uint32_t last_line() const { return last_line_; }

 private:
  // A straight part of the path.
  struct Leg {
    Point from;
    Point to;
    double begin = 0;  // along the path
    double length = 0;
    std::uint32_t line = 0;
    double speed = 0;  // mm/s, at most
  };
  struct Path {
    std::deque<Leg> legs;
    std::uint32_t first = 0;  // index of legs.front()
    Point end = {};           // of the last leg
    double length = 0;        // of all legs so far
    double known = 0;         // the board has come so far
  };
  // The model's time.
  struct Clock {
    double time = 0;  // s
    double debt = 0;  // how long the model waits, s
    Seconds set{-1};  // the host's time
    double factor = 1;
    bool paused = false;
  };
  // What the board has in its receive buffer, or waits for.
  struct Waiting {
    bool rests = false;
    Seconds dwell{0};
    Point end = {};
    MmPerSecond feed{0};
    std::uint32_t leg = 0;  // index of the leg
    double time = 0;        // s, at its highest speed
  };

  double measured_speed(const Point& way, MmPerSecond feed) const;
  double speed_of(const Point& way, MmPerSecond feed) const;
  double braking_time(const GrblLineMotion& line) const;
  double duration_of(const GrblLineMotion& line) const;
  std::vector<std::string> straight_pieces(const std::string& text, const GrblLineMotion& line, int count) const;
  std::vector<std::string> arc_pieces(const std::string& text, const GrblLineMotion& line, int count) const;
  std::string place_words(const std::string& text, const Point& place) const;
  void add_leg(const Point& end, MmPerSecond feed, std::uint32_t line);
  void advance(Seconds now);
  void run_model(double until);
  double model_place() const;
  double remaining() const;
  double time_with(const GrblLineMotion& line) const;
  bool waits_in_buffer() const { return !waiting_.empty() || model_.full(); }
  std::optional<double> nearest_on_path(const Point& place, double expected) const;
  void correct(double along, bool rests);

  GrblLimits limits_;
  Seconds ahead_;
  double tolerance_ = 0;  // mm
  GrblLineReader added_reader_;
  GrblLineReader sent_reader_;
  GrblPlanner model_;
  std::deque<Waiting> waiting_;
  double rests_until_ = 0;  // of a dwell, in the model's time
  Path path_;
  Clock clock_;
  bool lost_ = false;          // a line led to an unknown place
  bool ends_in_rest_ = false;  // the last line was answered when all motion was complete
  int strikes_ = 0;            // reports beside the path, one after the other
  std::uint32_t last_line_ = 0;
};

}  // namespace passo
