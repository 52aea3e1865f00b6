// A chart over motion time, as HTML: the curve is an <svg> that is stretched to any width, and all text is outside of
// it, so the text keeps its size.
#pragma once

#include <string>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

struct TimeChart {
  std::string label;  // the quantity shown
  struct Value {
    Seconds time{0};  // total duration
    double value = 0;
  };
  std::vector<Value> values;
  double top = 1;                  // end of the scale, which begins at 0; higher values are clipped
  std::vector<double> marks = {};  // values with a tick mark
  std::string unit;                // unit of the marks
  // Values above this are drawn as a warning; 0: none.
  double warns_above = 0;
};

std::string to_html(const TimeChart& chart);

}  // namespace passo
