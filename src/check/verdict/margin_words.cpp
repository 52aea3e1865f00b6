#include "passo/verdict/margin_words.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

std::string with_commas(double value) {
  std::string digits = fmt::format("{:.0f}", value);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

// A limit to keep below, so its third digit is rounded down.
std::string rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  return fmt::format("{:g}", std::floor(value / unit + 1e-9) * unit);
}

}  // namespace

std::string cause_of(const MarginSpot& spot) {
  if (spot.want == LossCause::calm) {
    return fmt::format(
        "{} has enough torque at {} steps/s (needs {:.3g} N\u00B7m, has {:.3g} to {:.3g}), but the motor may lose "
        "steps there through resonance (mid-band instability)",
        letter_of(spot.axis), with_commas(spot.rate.value()), spot.needed.value, spot.there.low.value,
        spot.there.high.value);
  }
  std::string words = fmt::format("{} needs {:.3g} N\u00B7m at {} steps/s", letter_of(spot.axis), spot.needed.value,
                                  with_commas(spot.rate.value()));
  if (spot.want == LossCause::jump) words += " to damp the oscillation after a jump of its torque";
  constexpr double notable = 5e-4;  // N·m
  if (spot.of_cut.value >= notable) words += fmt::format(", {:.3g} of it for the cut", spot.of_cut.value);
  words += fmt::format(", and has {:.3g} to {:.3g}", spot.there.low.value, spot.there.high.value);
  return words;
}

std::string cure_of(const MarginSpot& spot) {
  if (spot.verdict == Verdict::safe) return "";
  const char* unit = is_rotary(spot.axis) ? "deg" : "mm";
  std::string words;
  if (spot.safe_acceleration) {
    words = fmt::format("a <= {} {}/s\u00B2", rounded_down(spot.safe_acceleration->value()), unit);
  }
  if (spot.safe_path_speed) {
    if (!words.empty()) words += ", or ";
    const double share = *spot.safe_path_speed / spot.path_speed;
    words += spot.rapid ? fmt::format("velocity <= {} {}/s", rounded_down(share * spot.speed.value()), unit)
                        : "F <= " + rounded_down(60 * spot.safe_path_speed->value());
  }
  return words.empty() ? "a stronger motor, or less load" : words;
}

bool is_torque_enough(const MarginVerdict& margin) {
  return std::ranges::none_of(margin.worst, [](const MarginSpot& spot) {
    return spot.verdict != Verdict::safe && spot.want == LossCause::torque;
  });
}

}  // namespace passo
