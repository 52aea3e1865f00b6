#include "passo/report/picture.hpp"

#include <algorithm>
#include <cctype>

#include "axis_ticks.hpp"
#include "cairo_canvas.hpp"
#include "path_drawing.hpp"
#include "picture_views.hpp"
#include <fmt/format.h>

#include "passo/report/progress.hpp"

namespace passo {
namespace {

const Font title{.size = 26, .colour = {0.13, 0.14, 0.17}, .bold = true};
const Font subtitle{.size = 15, .colour = {0.40, 0.42, 0.46}};
const Font label{.size = 12};
const Font caption{.size = 14};
constexpr double margin = 48;

// "100.0": three or four significant digits, without an exponent.
std::string length_text(double mm) {
  if (mm == 0) return "0";
  const int decimals = mm >= 1000 ? 0 : mm >= 10 ? 1 : mm >= 0.1 ? 2 : 4;
  return fmt::format("{:.{}f}", mm, decimals);
}

std::string size_text(const PathRecorder& path) {
  if (path.empty()) return "no motion";
  const auto size = [&](Axis axis) { return length_text(path.extents().high[axis] - path.extents().low[axis]); };
  return fmt::format("X {} \u00D7 Y {} \u00D7 Z {} mm", size(Axis::x), size(Axis::y), size(Axis::z));
}

// Cuts text out of the middle if the text is wider than `room`. The start of a name tells the job, the end tells the
// kind of file.
std::string shortened(Canvas& canvas, const std::string& text, const Font& font, double room) {
  std::string shown = text;
  for (std::size_t kept = text.size(); canvas.text_width(shown, font) > room && kept > 8;) {
    kept -= std::max<std::size_t>(1, kept / 16);
    shown = text.substr(0, kept / 2) + "\u2026" + text.substr(text.size() - kept / 2);
  }
  return shown;
}

void draw_title(Canvas& canvas, const PathRecorder& path, const Scene& scene, const PictureOptions& options) {
  const double room = options.width - 2 * margin;
  canvas.text({margin, 42}, shortened(canvas, options.program, title, room), title);
  std::string line = options.machine.empty() ? "" : options.machine + "   \u00B7   ";
  line += clock_text(path.time()) + "   \u00B7   " + size_text(path);
  if (!path.empty())
    line += scene.work_coordinates ? "   \u00B7   work coordinates" : "   \u00B7   machine coordinates";
  canvas.text({margin, 74}, shortened(canvas, line, subtitle, room), subtitle);
}

void draw_speed_bar(Canvas& canvas, MmPerSecond fastest, const Area& bar) {
  canvas.text({bar.x, bar.y - 14}, "Feed, actual speed in mm/min", caption);
  canvas.fill_with_speeds(bar);
  const double highest = fastest.value() * seconds_per_minute;
  const double pixels = bar.width / highest;
  const auto room = [&](const std::string& text) { return canvas.text_width(text, label) + 24; };
  const Pen pen{.colour = label.colour, .width = 1};
  for (const Tick& tick : ticks(0, highest, pixels, room)) {
    const double x = bar.x + tick.value * pixels;
    canvas.line({x, bar.bottom()}, {x, bar.bottom() + 4}, pen);
    canvas.text({x, bar.bottom() + 14}, tick.label, label, Align::centre);
  }
}

void draw_legend(Canvas& canvas, const PathRecorder& path, const Area& area) {
  const double middle = area.y + area.height / 2;
  double x = area.x;
  if (path.fastest_feed() > MmPerSecond(0)) {
    const Area bar{area.x, middle - 6, 520, 12};
    draw_speed_bar(canvas, path.fastest_feed(), bar);
    x = bar.right() + 70;
  }
  Pen pen = rapid_pen();
  pen.width = 1.2;
  canvas.line({x, middle}, {x + 48, middle}, pen);
  canvas.text({x + 60, middle}, "Rapid", caption);
  x += 60 + canvas.text_width("Rapid", caption) + 60;
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
  canvas.fill({0, 0, width, height}, {1, 1, 1});

  const Scene scene(path);
  draw_title(canvas, path, scene, options);
  constexpr double upper = 136;
  constexpr double lower = 150;
  const double views = width - 2 * margin;
  draw_isometric_view(canvas, scene, {margin, upper, views * 0.54, height - upper - lower + 30});
  draw_top_view(canvas, scene, {margin + views * 0.54 + 90, upper, views * 0.46 - 90, height - upper - lower});
  if (!path.empty()) draw_legend(canvas, path, {margin, height - 84, views, 60});
  return canvas.finish();
}

}  // namespace passo
