// A line chart with a legend, for studies with a table of numbers as their result.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct ChartLine {
  std::string name;
  std::vector<std::pair<double, double>> points;  // in ascending order of x
};

struct LineChart {
  std::string x_title;
  std::string y_title;
  std::vector<ChartLine> lines;  // at most four, so that each has a distinct colour
};

// `options.program` is the title, `options.machine` the line below it. Draws into `file`; the caller commits it.
Status<OutputError> draw_line_chart(const LineChart& chart, const PictureOptions& options, OutputFile& file);

// Draws several charts, with the same line names but separate axes, on one sheet.
Status<OutputError> draw_line_charts(const std::vector<LineChart>& charts, const PictureOptions& options,
                                     OutputFile& file);

}  // namespace passo
