// SpindleEncoder: turns the counts of a board's encoder into turns and seconds, and tells whether the counts are
// plausible.
//
// Counts and ticks come modulo 2^32, and each reading continues the one before. After a long pause that is not certain,
// so call restart(). The direction in which the encoder counts does not matter.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/units/units.hpp"
#include "passo/wire/message.hpp"

namespace passo {

struct SpindleReading {
  Seconds time{0};   // by the board's clock, from any start
  double turns = 0;  // from any start
};

class SpindleEncoder {
 public:
  // `counts_per_turn` 0: there is no encoder.
  SpindleEncoder(int counts_per_turn, Hertz clock) : counts_per_turn_(counts_per_turn), clock_(clock) {}
  bool exists() const { return counts_per_turn_ > 0; }

  void restart() { *this = SpindleEncoder(counts_per_turn_, clock_); }
  void read(const SpindleCount& count);
  const SpindleReading& now() const { return now_; }

  // Turns at the last index since the restart. Empty before the first index.
  const std::optional<double>& index() const { return index_; }
  // For how long, up to now, the encoder has counted nothing.
  Seconds stood() const { return now_.time - moved_at_; }
  // How long `counts` take at one turn a second.
  Seconds time_of_counts(double counts) const { return Seconds(counts / counts_per_turn_); }
  // True: indexes came at places that are not whole turns from the first index, or no index came for several turns.
  bool is_wrong() const;
  // True: two indexes were one or more whole turns apart, and no doubt is open.
  bool is_right() const { return known_good_ && doubts_ == 0; }

 private:
  void record_turns(double turns, double speed);

  int counts_per_turn_;
  Hertz clock_;
  std::optional<SpindleCount> last_;
  SpindleReading now_;
  Seconds moved_at_{0};
  double moved_to_ = 0;
  std::optional<double> index_;
  std::optional<double> first_index_;
  double indexed_at_ = 0;  // turns at the last index, or at the start
  Seconds indexed_then_{0};
  int doubts_ = 0;
  bool known_good_ = false;
};

}  // namespace passo
