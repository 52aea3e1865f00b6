// RampSequence: the intervals of a ramp or of a whole move, one at a time, by any method. Used by `passo ramp`.
//
// It selects the suitable implementation: interpolate/ramp_move.hpp over a ramp, or an SCurveMove. If a method is not
// applicable, the error gives the reason. Constant memory, except for a table.
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
  bool whole_move = false;      // true: including deceleration to a stop; false: acceleration only
  bool whole_ticks = false;     // as a chip plays them; a table always has whole ticks
  Hertz rate{0};                // maximum rate; 0: no limit
  Hertz start{0};               // pull-in rate of the start/stop region; 0: none
  RadiansPerSecond3 jerk;       // jerk limit of a whole move; 0: no limit
  std::int32_t table_size = 0;  // 0: as many entries as the steps require
  std::int64_t stop_after = 0;  // stops a whole move after this many steps; 0: does not
  // After this many steps a whole move is redirected to its start position: it brakes, reverses, and returns. 0: never.
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
  // Returns the next interval, in ticks. Requires !done().
  double next();
  // Returns the motor's position after the step at the end of the last interval. The move began at 0.
  std::int64_t place() const;
  bool whole_ticks() const { return whole_ticks_; }

  class Walk;

 private:
  RampSequence(std::unique_ptr<Walk> walk, const RampRequest& request);

  std::unique_ptr<Walk> walk_;
  std::int64_t left_ = 0;        // remaining steps, for acceleration only
  std::int64_t to_stop_ = 0;     // steps until the stop command; 0: none follows
  std::int64_t to_reverse_ = 0;  // steps until the return command
  bool whole_move_ = false;
  bool whole_ticks_ = false;
};

}  // namespace passo
