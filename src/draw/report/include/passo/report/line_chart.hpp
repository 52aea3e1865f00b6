// A picture of lines over one axis: a chart with a legend, for studies whose result is a table of numbers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct ChartLine {
  std::string name;
  std::vector<std::pair<double, double>> points;  // x ascending
};

struct LineChart {
  std::string x_title;
  std::string y_title;
  std::vector<ChartLine> lines;  // at most four, so that each has a colour of its own
};

// `options.program` is the title, `options.machine` the line below it. Draws into `file`, which the caller commits.
Status<OutputError> draw_line_chart(const LineChart& chart, const PictureOptions& options, OutputFile& file);

// Several charts with lines of the same names, each with axes of its own, on one sheet.
Status<OutputError> draw_line_charts(const std::vector<LineChart>& charts, const PictureOptions& options,
                                     OutputFile& file);

}  // namespace passo
