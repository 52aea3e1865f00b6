// RampSequence: the intervals of a ramp or of a whole move, one at a time, by any method. `passo ramp` shows them.
//
// It chooses the walk that fits: interpolate/ramp_move.hpp over a ramp, or an SCurveMove. If a method does not apply,
// the error gives the reason. Constant memory, except for a table.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "passo/base/result.hpp"
#include "passo/ramp/ramp_setup.hpp"

namespace passo {

enum class RampMethod : std::uint8_t { exact, recursive, table, midpoint };

struct RampRequest {
  static constexpr std::int64_t most_steps = std::int64_t{1} << 29;

  RampSetup setup;
  RampMethod method = RampMethod::exact;
  std::int64_t steps = 0;       // 1…most_steps
  bool whole_move = false;      // true: to rest again; false: upwards only
  bool whole_ticks = false;     // as a chip plays them; a table always has whole ticks
  Hertz rate{0};                // the greatest rate; 0: no limit
  Hertz start{0};               // of the start/stop region; 0: none
  RadiansPerSecond3 jerk;       // the greatest jerk of a whole move; 0: no limit
  std::int32_t table_size = 0;  // 0: as many entries as the steps need
  std::int64_t stop_after = 0;  // stop a whole move after so many steps; 0: do not
  // After so many steps a whole move is told to go back to where it began: it brakes, turns, and returns. 0: it is not.
  std::int64_t reverse_after = 0;
};

struct RampError {
  std::string message;
};

class RampSequence {
 public:
  static constexpr std::int32_t largest_table = 65535;

  static Result<RampSequence, RampError> start(const RampRequest& request);

  RampSequence(RampSequence&&) noexcept;
  RampSequence& operator=(RampSequence&&) noexcept;
  ~RampSequence();

  bool done() const;
  // The next interval, in ticks. Only when not done().
  double next();
  // The motor's position after the step returned by the last next(). The move began at 0.
  std::int64_t place() const;
  bool whole_ticks() const { return whole_ticks_; }

  class Walk;

 private:
  RampSequence(std::unique_ptr<Walk> walk, const RampRequest& request);

  std::unique_ptr<Walk> walk_;
  std::int64_t left_ = 0;        // of a ramp up
  std::int64_t to_stop_ = 0;     // steps until the order to stop; 0: none will come
  std::int64_t to_reverse_ = 0;  // steps until the order to go back
  bool whole_move_ = false;
  bool whole_ticks_ = false;
};

}  // namespace passo
