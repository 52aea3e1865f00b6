// BlockExecutor: the threading cycle G76.
//
// Depths count from the thread's crest. Pass n goes J * n^(1/R) deep, the last ones (with H spring passes) K. With Q
// the tool follows the thread's flank: the deeper, the further back along Z it starts. E and L let the tool in and out
// on a slope, on which the pitch grows so that along the slope the turns stay as far apart.
#include <cmath>
#include <numbers>

#include "block_executor.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr double most_passes = 1e5;
constexpr double steepest_infeed = 80;  // degrees

}  // namespace

bool BlockExecutor::start_threading() {
  Point end;
  if (!check_threading() || !end_point(end) || !check_threading_words()) return false;
  const double unit = state_.length_unit();
  const double along_x = state_.modal.diameters() ? unit / 2 : unit;  // I J K are along X
  const double direction = end[Axis::z] > state_.position[Axis::z] ? -1 : 1;
  const double infeed = words_.has('Q') ? words_['Q'] * (std::numbers::pi / 180) : 0;
  std::int32_t ends = 0;
  std::int32_t springs = 0;
  if (words_.has('L') && !whole_word('L', 0, 3, ends)) return false;
  if (words_.has('H') && !whole_word('H', 0, most_passes, springs)) return false;

  thread_ = {};
  thread_.start = state_.position;
  thread_.end = end;
  thread_.outward = words_['I'] < 0 ? 1 : -1;
  thread_.crest = std::abs(words_['I']) * along_x;
  thread_.first_cut = words_['J'] * along_x;
  thread_.full_depth = words_['K'] * along_x;
  thread_.pitch = words_['P'] * unit;
  thread_.infeed_tangent = direction * std::tan(infeed);
  thread_.degression = words_.has('R') ? std::max(1.0, words_['R']) : 1;
  thread_.spring_passes = springs;
  const double taper = words_.has('E') ? std::max(0.0, words_['E'] * unit) : 0;
  thread_.taper = direction * taper;
  thread_.taper_at_start = taper > 0 && (ends & 1) != 0;
  thread_.taper_at_end = taper > 0 && (ends & 2) != 0;

  const double length = std::abs(end[Axis::z] - state_.position[Axis::z]);
  if (length == 0) {
    return fail("gcode.bad-thread", motion_span(), "the thread has no length: it ends at the Z where it begins",
                "Z, the thread's end");
  }
  const int tapers = (thread_.taper_at_start ? 1 : 0) + (thread_.taper_at_end ? 1 : 0);
  if (tapers * taper > length) {
    return fail("gcode.bad-thread", words_.span('E'), "the tapers are longer than the thread", "a smaller E");
  }
  const double passes = std::pow(thread_.full_depth / thread_.first_cut, thread_.degression);
  if (passes > most_passes) {
    return fail("gcode.bad-thread", words_.has('R') ? words_.span('R') : words_.span('J'),
                fmt::format("the thread takes more than {:.0f} passes", most_passes), "a larger J, or a smaller R");
  }
  cycle_ = Cycle::threading;
  return true;
}

bool BlockExecutor::check_threading() {
  if (!check_uncompensated("G76")) return false;
  for (const char letter : {'A', 'B', 'C'}) {
    if (!words_.has(letter)) continue;
    return fail("gcode.cycle-axis", words_.span(letter), fmt::format("G76 does not move {}", letter),
                fmt::format("{} in a block before", letter));
  }
  if (state_.spindles[0].direction != SpindleDirection::off) return true;
  return fail("gcode.spindle-off", motion_span(), "G76 while the spindle does not turn",
              "M3 or M4 before, or in this block");
}

bool BlockExecutor::check_threading_words() {
  struct Needed {
    char letter;
    const char* what;
  };
  for (const auto& [letter, what] : {Needed{'P', "the length of one revolution"},
                                     {'I', "from the drive line to the thread's crest, below 0 outside"},
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
  if (words_['I'] == 0) return bad('I', "I below 0 for a thread outside, above 0 for one inside");
  if (words_['J'] <= 0) return bad('J', "J above 0");
  if (words_['K'] <= words_['J']) return bad('K', "K above J");
  if (words_.has('Q') && std::abs(words_['Q']) > steepest_infeed) return bad('Q', "Q of 0 to 80 degrees");
  return true;
}

bool BlockExecutor::step_threading() {
  // From the drive line and in the program's units, so that a pass that comes out at K is rounded as in LinuxCNC.
  const double crest = std::abs(words_['I']);
  const double depth = words_['J'] * std::pow(thread_.pass, 1 / thread_.degression);
  if (!thread_.full_depth_reached && crest + depth < crest + words_['K']) {
    cut_thread(depth * (thread_.first_cut / words_['J']));
    ++thread_.pass;
    return true;
  }
  thread_.full_depth_reached = true;
  cut_thread(thread_.full_depth);
  if (--thread_.spring_passes >= 0) return true;
  state_.position = thread_.end;
  emit(operation::StraightTraverse{thread_.end});
  cycle_ = Cycle::none;
  return true;
}

void BlockExecutor::cut_thread(double depth) {
  const ThreadingCycle& thread = thread_;
  const double back = thread.infeed_tangent;
  const double above = thread.start[Axis::x] + thread.outward * (thread.full_depth - depth);
  const double crest = above - thread.outward * thread.crest;
  const double bottom = crest - thread.outward * thread.full_depth;
  const double first = thread.start[Axis::z] - depth * back;
  const double last = thread.end[Axis::z] + (thread.full_depth - depth) * back;
  const double slope_pitch = thread.taper == 0
                                 ? thread.pitch
                                 : thread.pitch * std::hypot(thread.taper, thread.full_depth) / std::abs(thread.taper);
  Point at = thread.start;
  const auto rapid = [&](double x, double z) {
    at[Axis::x] = x, at[Axis::z] = z;
    emit(operation::StraightTraverse{at});
  };
  const auto cut = [&](double x, double z) {
    at[Axis::x] = x, at[Axis::z] = z;
    emit(operation::StraightFeed{at});
  };

  rapid(above, first);
  if (!thread.taper_at_start) rapid(bottom, first);
  emit(operation::SetFeedOverride{false});
  if (thread.taper_at_start) {
    emit(operation::StartSpeedFeedSync{Mm(slope_pitch), false});
    cut(crest, first);
    cut(bottom, first - thread.taper);
  }
  emit(operation::StartSpeedFeedSync{Mm(thread.pitch), false});
  cut(bottom, thread.taper_at_end ? last + thread.taper : last);
  if (thread.taper_at_end) {
    emit(operation::StartSpeedFeedSync{Mm(slope_pitch), false});
    cut(crest, last);
  }
  emit(operation::StopSpeedFeedSync{});
  rapid(above, last);
  if (state_.feed_override) emit(operation::SetFeedOverride{true});
}

}  // namespace passo
