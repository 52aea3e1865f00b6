#include "passo/lab/board_play.hpp"

#include <algorithm>
#include <vector>

#include "json_text.hpp"

namespace passo {

std::uint8_t BoardPins::rows() const {
  unsigned rows = 0;
  for (unsigned row = 0; row < keypad_rows; ++row) {
    rows |= (pressed >> key_at(static_cast<std::uint8_t>(row), column_) & 1U) << row;
  }
  return static_cast<std::uint8_t>(rows);
}

bool BoardPins::millisecond() {
  if (now_us < next_us_) return false;
  next_us_ += 1000;
  return true;
}

void BoardPins::windings(std::uint8_t axis, std::uint8_t place) {
  constexpr WindingTable table = winding_table(DriveMode::two_on);
  patterns[axis] = table.at(place);
  // The nearest position of this pattern: one step up or down, or two when the counters have been cleared.
  const std::int64_t away = (place - rotors[axis]) & table.mask;
  rotors[axis] += away == 3 ? -1 : away;
}

void BoardPins::leds(bool automatic, bool manual, bool raising) {
  is_automatic = automatic;
  is_manual = manual;
  is_raising = raising;
}

void BoardPins::float_outputs() {
  for (std::uint8_t& pattern : patterns) pattern = 0;
  relay_closed = is_relay_lit = is_automatic = is_manual = is_raising = false;
  next_us_ = now_us + 1000;
}

void BoardPlay::reset(bool pressed) {
  pins_.float_outputs();
  follower_.reset();
  if (!pressed) follower_.emplace(pins_).begin();
}

void BoardPlay::drive_clock(unsigned axes, bool high) {
  const unsigned driven = axes & wired_;
  const unsigned levels = high ? ~idle_ : idle_;
  pins_.levels = static_cast<std::uint8_t>((pins_.levels & ~driven) | (levels & driven));
}

void BoardPlay::set_clock(std::uint8_t axes, std::int64_t half_us, std::int64_t pulses, std::uint8_t idle,
                          std::uint8_t wired) {
  const bool is_on = clock_axes_ != 0;
  drive_clock(clock_axes_ & ~static_cast<unsigned>(axes), false);
  if ((clock_axes_ & axes) == 0) is_high_ = false;
  clock_axes_ = axes & 7;
  idle_ = idle & 7;
  wired_ = wired & 7;
  half_us_ = std::max(half_us, 2 * turn_us);
  pulses_left_ = pulses;
  // Another rate takes effect at once, even where the old one was very slow.
  next_edge_us_ = is_on ? std::min(next_edge_us_, pins_.now_us + half_us_) : pins_.now_us + half_us_;
}

void BoardPlay::advance_clock() {
  if (clock_axes_ == 0 || pins_.now_us < next_edge_us_) return;
  if (!is_high_ && pulses_left_ == 0) {
    clock_axes_ = 0;
    return;
  }
  next_edge_us_ += half_us_;
  is_high_ = !is_high_;
  drive_clock(clock_axes_, is_high_);
  if (!is_high_) return;
  ++pulses_made_;
  if (pulses_left_ > 0) --pulses_left_;
}

void BoardPlay::run(std::int64_t microseconds) {
  const std::int64_t end = pins_.now_us + std::clamp(microseconds, std::int64_t{0}, longest_run_us);
  while (pins_.now_us < end) {
    pins_.now_us += turn_us;
    advance_clock();
    if (follower_) follower_->poll();
  }
}

std::string BoardPlay::answer() const {
  JsonText json;
  json.number("lines", pins_.levels);
  json.flag("clock_runs", clock_axes_ != 0);
  json.number("pulses", static_cast<double>(pulses_made_));
  json.list("patterns", std::vector<int>(std::begin(pins_.patterns), std::end(pins_.patterns)));
  json.list("rotors", std::vector<std::int64_t>(std::begin(pins_.rotors), std::end(pins_.rotors)));
  json.flag("relay", pins_.relay_closed);
  json.flag("relay_led", pins_.is_relay_lit);
  json.words("mode", !follower_ ? "reset" : pins_.is_automatic ? "automatic" : pins_.is_manual ? "manual" : "waiting");
  // RB0, RD1, RD2, RD3. RD1 to RD3 are lit when low, which a pin that floats is not.
  const bool waits_or_runs = follower_ && !pins_.is_manual;
  const std::vector<int> lit = {pins_.is_automatic, waits_or_runs || pins_.is_raising, waits_or_runs, waits_or_runs};
  json.list("leds", lit);
  return json.take();
}

}  // namespace passo
