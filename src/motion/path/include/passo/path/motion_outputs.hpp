// MotionOutputs: the outputs that a program switches without a stop, at their position on the path: digital outputs
// (M62 to M65) and the laser (S, M3 to M5, M67, M68).
//
// Each segment carries their state (PathOutputs), as it carries its speed. So whatever happens to the path (merging,
// rounding, a rewind after a broken link), each change stays at its position. See docs/decisions/0210.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "passo/path/segment.hpp"

namespace passo {

inline constexpr std::size_t most_digital_outputs = 3;

struct LaserOptions {
  double maximum_s = 1000;  // the S of full power
  double minimum = 0;       // the least power of an S above 0, as a fraction of full power
};

struct MotionOutputOptions {
  // The bit of the board's outputs for each number of M62 to M65. 0: there is no such output.
  std::array<std::uint8_t, most_digital_outputs> digital{};
  std::optional<LaserOptions> laser = {};

  std::uint8_t bit_of(std::int32_t number) const {
    const bool is_known = number >= 0 && static_cast<std::size_t>(number) < digital.size();
    return is_known ? digital[static_cast<std::size_t>(number)] : std::uint8_t{0};
  }
  bool has_digital() const {
    return std::ranges::any_of(digital, [](std::uint8_t bit) { return bit != 0; });
  }
};

class MotionOutputs {
 public:
  // `with_motion`: with the next motion (M62, M63), otherwise at once (M64, M65).
  void set_digital(std::uint8_t bit, bool on, bool with_motion) {
    set(with_next_, bit, on);
    if (!with_motion) set(now_, bit, on);
  }
  // For S: as a fraction of full power.
  void set_power(double power) { power_ = power; }
  // M4: the power follows the speed.
  void turn_laser(SpindleDirection direction) { laser_ = direction; }
  void switch_off() {
    now_ = with_next_ = 0;
    laser_ = SpindleDirection::off;
  }

  // The state during the next segment. The laser is on in feeds only.
  PathOutputs begin_segment(bool feeds, bool has_digital) {
    now_ = handed_on_ = with_next_;
    PathOutputs outputs;
    if (feeds && laser_ != SpindleDirection::off) outputs.power = power_;
    outputs.follows_speed = outputs.power > 0 && laser_ == SpindleDirection::counterclockwise;
    if (has_digital) outputs.switches = now_;
    return outputs;
  }
  // Whether a stop must switch something, because no segment does.
  bool is_news() const { return now_ != handed_on_; }
  void hand_on() { handed_on_ = now_; }
  // The digital outputs that are on in a stop.
  std::uint8_t at_rest() const { return now_; }

 private:
  static void set(std::uint8_t& switches, std::uint8_t bit, bool on) {
    switches = static_cast<std::uint8_t>(on ? switches | bit : switches & ~bit);
  }

  std::uint8_t now_ = 0;
  std::uint8_t with_next_ = 0;  // the state with the next motion
  std::uint8_t handed_on_ = 0;  // in the items of the path so far
  double power_ = 0;
  SpindleDirection laser_ = SpindleDirection::off;
};

}  // namespace passo
