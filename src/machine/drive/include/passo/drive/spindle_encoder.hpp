// SpindleEncoder: converts the counts of a board's encoder into revolutions and seconds, and checks their plausibility.
//
// Counts and ticks are modulo 2^32, and each reading continues the previous one. After a long pause this is not
// certain, so call restart(). The counting direction of the encoder does not matter.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/units/units.hpp"
#include "passo/wire/message.hpp"

namespace passo {

struct SpindleReading {
  Seconds time{0};   // by the board's clock, from an arbitrary zero
  double turns = 0;  // revolutions from an arbitrary zero
};

class SpindleEncoder {
 public:
  // `counts_per_turn` 0: there is no encoder.
  SpindleEncoder(int counts_per_turn, Hertz clock) : counts_per_turn_(counts_per_turn), clock_(clock) {}
  bool exists() const { return counts_per_turn_ > 0; }

  void restart() { *this = SpindleEncoder(counts_per_turn_, clock_); }
  void read(const SpindleCount& count);
  const SpindleReading& now() const { return now_; }

  // The revolutions at the last index since the restart. Empty before the first index.
  const std::optional<double>& index() const { return index_; }
  // The time since the encoder last counted.
  Seconds stood() const { return now_.time - moved_at_; }
  // The time of `counts` at one revolution per second.
  Seconds time_of_counts(double counts) const { return Seconds(counts / counts_per_turn_); }
  // Returns true if index pulses were not a whole number of revolutions after the first one, or no index came for
  // several revolutions.
  bool is_wrong() const;
  // Returns true if two index pulses were a whole number of revolutions apart, and no doubt is open.
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
  double indexed_at_ = 0;  // revolutions at the last index, or at the start
  Seconds indexed_then_{0};
  int doubts_ = 0;
  bool known_good_ = false;
};

}  // namespace passo
