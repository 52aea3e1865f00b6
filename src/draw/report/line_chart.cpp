#include "passo/report/line_chart.hpp"

#include <algorithm>
#include <array>

#include "canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"

namespace passo {
namespace {

using namespace sheet;

// Blue, orange, green and purple differ in lightness too, and so in grey.
const std::array<Pen, 4> pens{
    Pen{.colour = {0.10, 0.33, 0.60}, .width = 2.4}, Pen{.colour = {0.90, 0.50, 0.10}, .width = 2.4},
    Pen{.colour = {0.10, 0.45, 0.30}, .width = 2.0}, Pen{.colour = {0.45, 0.20, 0.45}, .width = 2.0}};

// The lines within their frame, which has room around it for the labels.
void draw_lines(Canvas& canvas, const LineChart& chart, const Area& area) {
  double x_end = 0;
  double y_end = 0;
  double y_begin = 0;
  for (const ChartLine& line : chart.lines) {
    for (const auto& [x, y] : line.points) {
      x_end = std::max(x_end, x);
      y_end = std::max(y_end, y);
      y_begin = std::min(y_begin, y);
    }
  }
  Chart frame(canvas, area, {.title = chart.x_title, .end = axis_end(x_end)},
              {.title = chart.y_title, .end = axis_end(1.05 * y_end), .begin = y_begin < 0 ? -axis_end(-y_begin) : 0});
  frame.draw_grid();
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    std::vector<Spot> values;
    for (const auto& [x, y] : chart.lines[i].points) values.push_back({x, y});
    frame.polyline(values, pens[i % pens.size()]);
  }
  frame.draw_frame();
}

}  // namespace

Status<OutputError> draw_line_chart(const LineChart& chart, const PictureOptions& options, OutputFile& file) {
  return draw_line_charts({chart}, options, file);
}

Status<OutputError> draw_line_charts(const std::vector<LineChart>& charts, const PictureOptions& options,
                                     OutputFile& file) {
  Canvas canvas(options, file);
  begin_sheet(canvas, options);
  constexpr double left = margin + 52;
  constexpr double top = 120;
  constexpr double gap_x = 100;
  constexpr double gap_y = 90;
  const std::size_t columns = charts.size() < 3 ? charts.size() : charts.size() <= 6 ? 3 : 5;
  const std::size_t rows = (charts.size() + columns - 1) / columns;
  const auto share = [](double space, double gap, std::size_t count) {
    return (space + gap) / static_cast<double>(count) - gap;
  };
  const double width = share(options.width - left - margin, gap_x, columns);
  const double height = share(options.height - top - 130, gap_y, rows);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const auto column = static_cast<double>(i % columns);
    const auto row = static_cast<double>(i / columns);
    draw_lines(canvas, charts[i], {left + column * (width + gap_x), top + row * (height + gap_y), width, height});
  }
  Legend legend(canvas, {left, options.height - 46.0});
  const std::vector<ChartLine>& lines = charts.front().lines;
  for (std::size_t i = 0; i < lines.size(); ++i) legend.line(pens[i % pens.size()], lines[i].name);
  return canvas.finish();
}

}  // namespace passo
