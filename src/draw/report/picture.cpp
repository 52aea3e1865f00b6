#include "passo/report/picture.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "axis_ticks.hpp"
#include "canvas.hpp"
#include "path_drawing.hpp"
#include "picture_views.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

#include "passo/report/progress.hpp"

namespace passo {
namespace {

using namespace sheet;

// "100.0": three or four significant digits, without an exponent.
std::string length_text(double mm) {
  if (mm == 0) return "0";
  const double size = std::abs(mm);
  const int decimals = size >= 1000 ? 0 : size >= 10 ? 1 : size >= 0.1 ? 2 : 4;
  return fmt::format("{:.{}f}", mm, decimals);
}

// The size of what is drawn.
std::string size_text(const PathRecorder& path, bool rapids) {
  if (path.empty()) return "no motion";
  const Box& box = rapids ? path.extents() : path.feed_extents();
  const auto size = [&](Axis axis) { return length_text(box.high[axis] - box.low[axis]); };
  return fmt::format("X {} \u00D7 Y {} \u00D7 Z {} mm", size(Axis::x), size(Axis::y), size(Axis::z));
}

// What stands below the title.
std::string describe(const PathRecorder& path, const Scene& scene, const PictureOptions& options) {
  std::string line = options.machine.empty() ? "" : options.machine + "   \u00B7   ";
  line += clock_text(path.time()) + "   \u00B7   " + size_text(path, options.rapids);
  if (!path.empty())
    line += scene.work_coordinates ? "   \u00B7   work coordinates" : "   \u00B7   machine coordinates";
  return line;
}

// The map of colours with a scale below it, from `begin` at the left to `end` at the right.
void draw_bar(Canvas& canvas, const std::string& name, double begin, double end, const Area& bar) {
  canvas.text({bar.x, bar.y - 14}, name, caption);
  canvas.fill_with_speeds(bar);
  const double pixels = bar.width / (end - begin);
  const auto room = [&](const std::string& text) { return canvas.text_width(text, label) + 24; };
  const Pen pen{.colour = label.colour, .width = 1};
  for (const Tick& tick : ticks(std::min(begin, end), std::max(begin, end), std::abs(pixels), room)) {
    const double x = bar.x + (tick.value - begin) * pixels;
    canvas.line({x, bar.bottom()}, {x, bar.bottom() + 4}, pen);
    canvas.text({x, bar.bottom() + 14}, tick.label, label, Align::centre);
  }
}

// A stroke in the colour of each tool that feeds. Returns where the legend goes on.
double draw_tools(Canvas& canvas, const PathRecorder& path, double x, double y) {
  constexpr std::size_t most_shown = 8;
  std::vector<bool> feeds(path.tools().size());
  for (const PathRecorder::Vertex& vertex : path.vertices()) {
    if (vertex.kind == PathRecorder::Kind::feed) feeds[vertex.tool] = true;
  }
  std::size_t shown = 0;
  for (std::size_t tool = 0; tool < feeds.size(); ++tool) {
    if (!feeds[tool]) continue;
    const bool more = ++shown > most_shown;
    if (!more) canvas.line({x, y}, {x + 26, y}, {.colour = PathColours::of_tool(tool), .width = 3});
    const std::string name = more                     ? "\u2026"
                             : path.tools()[tool] > 0 ? fmt::format("T{}", path.tools()[tool])
                                                      : "no tool";
    canvas.text({x + (more ? 0 : 34), y}, name, caption);
    x += 34 + canvas.text_width(name, caption) + 26;
    if (more) break;
  }
  return x + 20;
}

void draw_legend(Canvas& canvas, const PathRecorder& path, const Scene& scene, const Area& area) {
  const double middle = area.y + area.height / 2;
  const double between = std::min(70.0, 0.06 * area.width);
  double x = area.x;
  const Area bar{area.x, middle - 6, std::min(520.0, 0.4 * area.width), 12};
  const PathColour by = scene.colours.by();
  if (path.fastest_feed() > MmPerSecond(0) && by == PathColour::tool) {
    x = draw_tools(canvas, path, x, middle);
  } else if (path.fastest_feed() > MmPerSecond(0) && by == PathColour::speed) {
    draw_bar(canvas, "Feed, actual speed in mm/min", 0, path.fastest_feed().value() * seconds_per_minute, bar);
    x = bar.right() + between;
  } else if (path.fastest_feed() > MmPerSecond(0) && by == PathColour::margin) {
    draw_bar(canvas, "Feed, needed torque in % of what is surely there", 0, 100, bar);
    x = bar.right() + between;
  } else if (path.fastest_feed() > MmPerSecond(0)) {
    const double high = path.feed_extents().high[Axis::z] - scene.zero[Axis::z];
    const double low = path.feed_extents().low[Axis::z] - scene.zero[Axis::z];
    if (high > low) {
      draw_bar(canvas, "Feed, Z in mm", high, low, bar);
      x = bar.right() + between;
    } else {
      const std::string words = fmt::format("Feed, all at Z {} mm", length_text(high));
      canvas.line({x, middle}, {x + 26, middle},
                  {.colour = scene.colours.of_class(scene.colours.classes() - 1), .width = 3});
      canvas.text({x + 34, middle}, words, caption);
      x += 34 + canvas.text_width(words, caption) + 60;
    }
  }
  if (scene.rapids) {
    Pen pen = rapid_pen();
    pen.width = 1.2;
    const double sample = std::min(48.0, 0.06 * area.width);
    canvas.line({x, middle}, {x + sample, middle}, pen);
    canvas.text({x + sample + 12, middle}, "Rapid", caption);
    x += sample + 12 + canvas.text_width("Rapid", caption) + std::min(60.0, 0.06 * area.width);
  }
  canvas.disc({x, middle}, 3, label.colour);
  canvas.text({x + 14, middle}, path.origins().size() > 1 ? "Work zeros" : "Work zero", caption);
}

}  // namespace

std::optional<PictureFormat> picture_format_of(std::string_view path) {
  std::string end(path.substr(path.size() < 4 ? 0 : path.size() - 4));
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (end == ".svg") return PictureFormat::svg;
  if (end == ".png") return PictureFormat::png;
  return std::nullopt;
}

Status<OutputError> draw_picture(const PathRecorder& path, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  const Scene scene(path, options);
  const FlatView view = options.view == FlatView::automatic ? natural_view(path, options.is_lathe) : options.view;
  begin_sheet(canvas, options, describe(path, scene, options));
  constexpr double upper = 136;
  constexpr double lower = 150;
  const double views = width - 2 * margin;
  draw_isometric_view(canvas, scene, {margin, upper, views * 0.54, height - upper - lower + 30});
  draw_flat_view(canvas, scene, view, {margin + views * 0.54 + 90, upper, views * 0.46 - 90, height - upper - lower});
  if (!path.empty()) draw_legend(canvas, path, scene, {margin, height - 84, views, 60});
  return canvas.finish();
}

Status<OutputError> draw_view(const PathRecorder& path, PictureView which, const PictureOptions& options,
                              OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  const Scene scene(path, options);
  canvas.fill({0, 0, width, height}, paper);
  constexpr double edge = 12;
  if (which == PictureView::isometric) {
    draw_isometric_view(canvas, scene, {edge, 36, width - 2 * edge, height - 36 - edge});
    return canvas.finish();
  }
  const FlatView view = options.view == FlatView::automatic ? natural_view(path, options.is_lathe) : options.view;
  constexpr double for_labels = 64;
  constexpr double for_legend = 120;
  draw_flat_view(canvas, scene, view, {for_labels, 36, width - for_labels - edge, height - 36 - for_legend});
  if (!path.empty()) draw_legend(canvas, path, scene, {for_labels, height - 66, width - for_labels - edge, 60});
  return canvas.finish();
}

}  // namespace passo
