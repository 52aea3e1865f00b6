#include "passo/report/line_chart.hpp"

#include <algorithm>
#include <array>

#include "cairo_canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"

namespace passo {
namespace {

using namespace sheet;

// Blue, orange, green and purple differ in lightness too, and so in grey.
const std::array<Pen, 4> pens{
    Pen{.colour = {0.10, 0.33, 0.60}, .width = 2.4}, Pen{.colour = {0.90, 0.50, 0.10}, .width = 2.4},
    Pen{.colour = {0.10, 0.45, 0.30}, .width = 2.0}, Pen{.colour = {0.45, 0.20, 0.45}, .width = 2.0}};

}  // namespace

Status<OutputError> draw_line_chart(const LineChart& chart, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  begin_sheet(canvas, options);
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
  constexpr double left = margin + 52;
  constexpr double top = 120;
  const Area area{left, top, options.width - left - margin, options.height - top - 130};
  Chart frame(canvas, area, {.title = chart.x_title, .end = axis_end(x_end)},
              {.title = chart.y_title, .end = axis_end(1.05 * y_end), .begin = y_begin < 0 ? -axis_end(-y_begin) : 0});
  frame.draw_grid();
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    std::vector<Spot> values;
    for (const auto& [x, y] : chart.lines[i].points) values.push_back({x, y});
    frame.polyline(values, pens[i % pens.size()]);
  }
  frame.draw_frame();
  Legend legend(canvas, {left, options.height - 46.0});
  for (std::size_t i = 0; i < chart.lines.size(); ++i) legend.line(pens[i % pens.size()], chart.lines[i].name);
  return canvas.finish();
}

}  // namespace passo
