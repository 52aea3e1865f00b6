#include "threading_codes.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr double most_passes = 1e5;
constexpr double steepest_infeed = 80;  // degrees

}  // namespace

bool ThreadingCodes::start() {
  Point end;
  if (!check() || !end_point(end) || !check_words()) return false;
  const double unit = state_.length_unit();
  const double direction = end[Axis::z] > state_.position[Axis::z] ? -1 : 1;
  const double infeed = words_.has('Q') ? words_['Q'] * (std::numbers::pi / 180) : 0;
  std::int32_t ends = 0;
  std::int32_t springs = 0;
  if (words_.has('L') && !whole_word('L', 0, 3, ends)) return false;
  if (words_.has('H') && !whole_word('H', 0, most_passes, springs)) return false;

  ThreadingPlan plan;
  plan.start = state_.position;
  plan.end = end;
  plan.outward = words_['I'] < 0 ? 1 : -1;
  plan.crest = std::abs(words_['I']);
  plan.first_cut = words_['J'];
  plan.full_depth = words_['K'];
  plan.unit = unit * diameter_factor(Axis::x);  // I, J and K are along X
  plan.pitch = words_['P'] * unit;
  plan.infeed_tangent = direction * std::tan(infeed);
  plan.degression = words_.has('R') ? std::max(1.0, words_['R']) : 1;
  plan.spring_passes = springs;
  const double taper = words_.has('E') ? std::max(0.0, words_['E'] * unit) : 0;
  plan.taper = direction * taper;
  plan.taper_at_start = taper > 0 && (ends & 1) != 0;
  plan.taper_at_end = taper > 0 && (ends & 2) != 0;
  plan.feed_override = state_.feed_override;
  if (!check_thread(plan)) return false;
  cycle_.emplace(plan, block_.source);
  return true;
}

bool ThreadingCodes::check_thread(const ThreadingPlan& plan) {
  const double length = std::abs(plan.end[Axis::z] - plan.start[Axis::z]);
  if (length == 0) {
    return fail("gcode.bad-thread", motion_span(), "the thread has no length: Z is the same at its start and its end",
                "Z, the end of the thread");
  }
  const int tapers = (plan.taper_at_start ? 1 : 0) + (plan.taper_at_end ? 1 : 0);
  if (tapers * std::abs(plan.taper) > length) {
    return fail("gcode.bad-thread", words_.span('E'), "the tapers are longer than the thread", "a smaller E");
  }
  const double passes = std::pow(plan.full_depth / plan.first_cut, plan.degression);
  if (passes > most_passes) {
    return fail("gcode.bad-thread", words_.has('R') ? words_.span('R') : words_.span('J'),
                fmt::format("the thread takes more than {:.0f} passes", most_passes), "a larger J, or a smaller R");
  }
  return true;
}

bool ThreadingCodes::check() {
  if (!check_uncompensated("G76")) return false;
  for (const char letter : {'A', 'B', 'C'}) {
    if (!words_.has(letter)) continue;
    return fail("gcode.cycle-axis", words_.span(letter), fmt::format("G76 does not move {}", letter),
                fmt::format("{} in an earlier block", letter));
  }
  if (state_.spindles[0].direction != SpindleDirection::off) return true;
  return fail("gcode.spindle-off", motion_span(), "G76 while the spindle does not turn",
              "M3 or M4 in this block or earlier");
}

bool ThreadingCodes::check_words() {
  struct Needed {
    char letter;
    const char* what;
  };
  for (const auto& [letter, what] :
       {Needed{'P', "the length of one revolution"},
        {'I', "the distance from the drive line to the thread's crest, below 0 for an external thread"},
        {'J', "the depth of the first pass"},
        {'K', "the depth of the thread"}}) {
    if (words_.has(letter)) continue;
    return fail("gcode.missing-word", motion_span(), fmt::format("G76 without {}", letter),
                fmt::format("{}, {}", letter, what));
  }
  const auto bad = [this](char letter, std::string_view expected) {
    return fail("gcode.bad-thread", words_.span(letter),
                fmt::format("{} of G76 is {}", letter, plain_number(words_[letter])), std::string(expected));
  };
  if (words_['P'] <= 0) return bad('P', "P above 0");
  if (words_['I'] == 0) return bad('I', "I below 0 for an external thread, above 0 for an internal thread");
  if (words_['J'] <= 0) return bad('J', "J above 0");
  if (words_['K'] <= words_['J']) return bad('K', "K above J");
  if (words_.has('Q') && std::abs(words_['Q']) > steepest_infeed) return bad('Q', "Q of 0 to 80 degrees");
  return true;
}

}  // namespace passo
