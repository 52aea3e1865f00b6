// A chart over the time of a motion, as HTML: the curve is an <svg> that is stretched to any width, and all text is
// outside of it, so the text keeps its size.
#pragma once

#include <string>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

struct TimeChart {
  std::string label;  // what the chart shows
  struct Value {
    Seconds time{0};  // how long it lasts
    double value = 0;
  };
  std::vector<Value> values;
  double top = 1;                  // of the scale, which begins at 0; what is higher is drawn at the top
  std::vector<double> marks = {};  // values with a tick
  std::string unit;                // after the number of a mark
  // Values above this are drawn as a warning; 0: none.
  double warns_above = 0;
};

std::string to_html(const TimeChart& chart);

}  // namespace passo
