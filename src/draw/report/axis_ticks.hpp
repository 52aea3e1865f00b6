// Ticks of a chart axis: round numbers, as many as fit. Private to report/.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace passo {

struct Tick {
  double value = 0;
  std::string label;
};

// Returns the smallest of …, 0.1, 0.2, 0.5, 1, 2, 5, 10, … that is not below `least`.
double round_step(double least);
// Formats a value with as many decimals as `step` needs ("12.5"); never returns "-0".
std::string tick_label(double value, double step);

// Returns the ticks in low…high, far enough apart for the widest label. One unit is `pixels` long, and `room(label)` is
// the number of pixels that a label needs along the axis, including its margin.
std::vector<Tick> ticks(double low, double high, double pixels, const std::function<double(const std::string&)>& room);

}  // namespace passo
