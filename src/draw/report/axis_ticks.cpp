#include "axis_ticks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

std::vector<Tick> ticks_of_step(double low, double high, double step) {
  std::vector<Tick> all;
  // Rounding must not lose a tick at an end of the range.
  const double slack = step * 1e-6;
  const double first = std::ceil((low - slack) / step);
  const double last = std::floor((high + slack) / step);
  for (double i = first; i <= last; ++i) all.push_back({i * step, tick_label(i * step, step)});
  return all;
}

}  // namespace

double round_step(double least) {
  const double decade = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least * (1 - 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

std::string tick_label(double value, double step) {
  const int decimals = static_cast<int>(std::clamp(-std::floor(std::log10(step) + 1e-9), 0.0, 9.0));
  std::string label = fmt::format("{:.{}f}", value, decimals);
  const bool zero = label.find_first_not_of("-0.") == std::string::npos;
  if (zero && label.front() == '-') label.erase(0, 1);
  if (label.front() == '-') label.replace(0, 1, "\u2212");
  return label;
}

std::vector<Tick> ticks(double low, double high, double pixels, const std::function<double(const std::string&)>& room) {
  if (!(high > low) || !(pixels > 0)) return {};
  constexpr double nearest = 12;  // pixels; every label is at least this wide
  double step = round_step(nearest / pixels);
  for (int attempt = 0; attempt < 30; ++attempt) {
    std::vector<Tick> all = ticks_of_step(low, high, step);
    double widest = 0;
    for (const Tick& tick : all) widest = std::max(widest, room(tick.label));
    if (widest <= step * pixels || all.size() < 2) return all;
    step = round_step(step * 1.5);
  }
  return {};
}

}  // namespace passo
