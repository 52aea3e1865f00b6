// Ticks of a chart's axis: round numbers, as many as there is room for. Private to report/.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace passo {

struct Tick {
  double value = 0;
  std::string label;
};

// The smallest of …, 0.1, 0.2, 0.5, 1, 2, 5, 10, … that is not below `least`.
double round_step(double least);
// The label has as many decimals as `step` needs ("12.5"), and is never "-0".
std::string tick_label(double value, double step);

// The ticks in low…high, far enough apart that the widest label has room. One unit is `pixels` long, and `room(label)`
// is the number of pixels that a label takes along the axis, with its margin.
std::vector<Tick> ticks(double low, double high, double pixels, const std::function<double(const std::string&)>& room);

}  // namespace passo
