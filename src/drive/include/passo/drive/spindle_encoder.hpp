// SpindleEncoder: what a board's encoder counts, as turns and seconds, and whether that can be.
//
// Counts and ticks come modulo 2^32 and are put together from one reading to the next; behind a pause, after which that
// would not be certain, restart(). Which way round it counts does not matter.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/units/units.hpp"
#include "passo/wire/message.hpp"

namespace passo {

struct SpindleReading {
  Seconds time{0};   // of the board's clock, from any start
  double turns = 0;  // from any start
};

class SpindleEncoder {
 public:
  // `counts_per_turn`: 0, there is none.
  SpindleEncoder(int counts_per_turn, Hertz clock) : counts_per_turn_(counts_per_turn), clock_(clock) {}
  bool exists() const { return counts_per_turn_ > 0; }

  void restart() { *this = SpindleEncoder(counts_per_turn_, clock_); }
  void read(const SpindleCount& count);
  const SpindleReading& now() const { return now_; }

  // Turns at the last index since the restart; nothing before there was one.
  const std::optional<double>& index() const { return index_; }
  // For how long, up to now, it has counted nothing.
  Seconds stood() const { return now_.time - moved_at_; }
  // So many, at a turn a second.
  Seconds time_of_counts(double counts) const { return Seconds(counts / counts_per_turn_); }
  // Indexes came where no turn ends, by the count since the first; or there was none though it turns and turns.
  bool is_wrong() const;
  // Two indexes were a turn apart, or some, and none came elsewhere.
  bool is_right() const { return known_good_ && doubts_ == 0; }

 private:
  void note_turns(double turns, double speed);

  int counts_per_turn_;
  Hertz clock_;
  std::optional<SpindleCount> last_;
  SpindleReading now_;
  Seconds moved_at_{0};
  double moved_to_ = 0;
  std::optional<double> index_;
  std::optional<double> first_index_;
  double indexed_at_ = 0;  // turns at the last one, or at the start
  Seconds indexed_then_{0};
  int doubts_ = 0;
  bool known_good_ = false;
};

}  // namespace passo
