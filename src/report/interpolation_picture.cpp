#include "passo/report/interpolation_picture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "axis_ticks.hpp"
#include "cairo_canvas.hpp"
#include "chart.hpp"
#include <fmt/format.h>

#include "passo/study/ideal_path.hpp"

namespace passo {
namespace {

const Font title_font{.size = 24, .colour = {0.13, 0.14, 0.17}, .bold = true};
const Font heading_font{.size = 17, .colour = {0.13, 0.14, 0.17}, .bold = true};
const Font caption_font{.size = 13, .colour = {0.40, 0.42, 0.46}};
const Font tick_font{.size = 11, .colour = {0.40, 0.42, 0.46}};
const Colour paper{1, 1, 1};
const Colour grid_colour{0.90, 0.91, 0.93};
const Colour edge_colour{0.62, 0.64, 0.67};
const Colour ideal_colour{0.80, 0.22, 0.20};
const Colour one_axis{0.16, 0.38, 0.70};
const Colour together{0.93, 0.55, 0.10};
const Colour waiting{0.80, 0.82, 0.86};
constexpr double margin = 40;

std::string coordinates(const Place& place) {
  return fmt::format("({})", fmt::join(place, ", "));
}

struct Shown {  // one pulse, or the start
  Place place;
  int axes = 0;  // number of axes that stepped
  bool waited = false;
};

std::vector<Shown> followed(const Method& method, const StepMove& move) {
  std::vector<Shown> all = {{.place = move.from}};
  const auto add = [&](const Followed& now) {
    const int axes = std::popcount(now.pulse.steps);
    if (axes == 0) {
      all.back().waited = true;
    } else {
      all.push_back({.place = now.place, .axes = axes});
    }
  };
  static_cast<void>(follow(method, move, add).has_value());
  return all;
}

// A view of two axes of the move, on an area of the paper.
class View {
 public:
  View(const std::vector<Shown>& shown, const StepMove& move, std::size_t across, std::size_t up, const Area& area)
      : across_(across), up_(up) {
    for (const Shown& one : shown) include(value(one.place, across), value(one.place, up));
    const IdealPath path(move);
    for (int i = 0; i <= 256; ++i) {
      const auto point = path.at(i / 256.0);
      include(point[across], point[up]);
    }
    constexpr double border = 0.6;
    const double width = high_.x - low_.x + 2 * border;
    const double height = high_.y - low_.y + 2 * border;
    scale_ = std::min({area.width / width, area.height / height, 60.0});
    low_.x -= border;
    low_.y -= border;
    high_.x += border;
    high_.y += border;
    frame_ = {area.x + (area.width - width * scale_) / 2, area.y + (area.height - height * scale_) / 2, width * scale_,
              height * scale_};
  }

  // A magnified view of the steps from `low` to `high`, which fills the area.
  View(const View& whole, Spot low, double steps, const Area& area)
      : across_(whole.across_),
        up_(whole.up_),
        low_(low),
        high_{low.x + steps, low.y + steps},
        scale_(area.width / steps),
        frame_(area) {}

  bool shows(const Place& place) const {
    const double x = value(place, across_);
    const double y = value(place, up_);
    return x >= low_.x - 1 && x <= high_.x + 1 && y >= low_.y - 1 && y <= high_.y + 1;
  }
  // Whether a pulse has room to be a dot.
  bool has_dots() const { return dot_radius() >= smallest_dot; }
  double dot_radius() const { return std::min(5.0, scale_ * 0.2); }

  static double value(const Place& place, std::size_t axis) {
    return axis < place.size() ? static_cast<double>(place[axis]) : 0;
  }
  Spot spot(double x, double y) const {
    return {frame_.x + (x - low_.x) * scale_, frame_.bottom() - (y - low_.y) * scale_};
  }
  Spot spot(const Place& place) const { return spot(value(place, across_), value(place, up_)); }
  const Area& frame() const { return frame_; }
  const Spot& low() const { return low_; }
  const Spot& high() const { return high_; }
  double scale() const { return scale_; }  // pixels a step
  std::size_t across() const { return across_; }
  std::size_t up() const { return up_; }

 private:
  static constexpr double smallest_dot = 1.2;

  void include(double x, double y) {
    low_ = {std::min(low_.x, x), std::min(low_.y, y)};
    high_ = {std::max(high_.x, x), std::max(high_.y, y)};
  }

  std::size_t across_;
  std::size_t up_;
  Spot low_{INFINITY, INFINITY};
  Spot high_{-INFINITY, -INFINITY};
  double scale_ = 1;
  Area frame_;
};

// Draws a line at every step if there is room for it, else only at round numbers of steps.
void draw_grid(Canvas& canvas, const View& view) {
  const Pen pen{.colour = grid_colour, .width = 1};
  const Area& frame = view.frame();
  const double step = view.scale() >= 6 ? 1 : round_step(12 / view.scale());
  for (double x = std::ceil(view.low().x / step) * step; x <= view.high().x; x += step) {
    const Spot at = view.spot(x, 0);
    canvas.line({at.x, frame.y}, {at.x, frame.bottom()}, pen);
  }
  for (double y = std::ceil(view.low().y / step) * step; y <= view.high().y; y += step) {
    const Spot at = view.spot(0, y);
    canvas.line({frame.x, at.y}, {frame.right(), at.y}, pen);
  }
  canvas.frame(frame, {.colour = edge_colour, .width = 1});
}

// Ticks at whole steps, where each label needs `room` pixels.
std::vector<Tick> step_ticks(double low, double high, double scale, double room) {
  const double step = std::max(1.0, round_step(room / scale));
  std::vector<Tick> all;
  for (double value = std::ceil(low / step) * step; value <= high; value += step) {
    all.push_back({value, tick_label(value, step)});
  }
  return all;
}

void draw_ticks(Canvas& canvas, const View& view) {
  const Area& frame = view.frame();
  double label_end = frame.x;
  const double widest = std::max(canvas.text_width(tick_label(view.low().x, 1), tick_font),
                                 canvas.text_width(tick_label(view.high().x, 1), tick_font));
  for (const Tick& tick : step_ticks(view.low().x, view.high().x, view.scale(), widest + 12)) {
    const double x = view.spot(tick.value, 0).x;
    canvas.text({x, frame.bottom() + 12}, tick.label, tick_font, Align::centre);
    label_end = x + canvas.text_width(tick.label, tick_font) / 2;
  }
  for (const Tick& tick : step_ticks(view.low().y, view.high().y, view.scale(), 18)) {
    canvas.text({frame.x - 7, view.spot(0, tick.value).y}, tick.label, tick_font, Align::right);
  }
  // The last label may reach out beyond the frame.
  canvas.text({std::max(frame.right() + 14, label_end + 10), frame.bottom() + 12}, axis_name(view.across()), tick_font);
  canvas.text({frame.x - 7, frame.y - 14}, axis_name(view.up()), tick_font, Align::right);
}

void draw_pulses(Canvas& canvas, const View& view, const std::vector<Shown>& shown) {
  const double radius = view.dot_radius();
  const bool dots = view.has_dots();
  for (const Shown& one : shown) {
    if (dots && one.waited) canvas.disc(view.spot(one.place), radius * 1.9, waiting);
  }
  canvas.move_to(view.spot(shown.front().place));
  for (const Shown& one : shown) canvas.line_to(view.spot(one.place));
  canvas.stroke({.colour = one_axis, .width = dots ? 1.6 : 1.2, .opacity = dots ? 0.55 : 1});
  for (const Shown& one : shown) {
    if (dots) canvas.disc(view.spot(one.place), radius, one.axes > 1 ? together : one_axis);
  }
}

void draw_ideal(Canvas& canvas, const View& view, const StepMove& move) {
  const IdealPath path(move);
  const int pieces = move.arc ? 720 : 1;
  for (int i = 0; i <= pieces; ++i) {
    const auto point = path.at(static_cast<double>(i) / pieces);
    const Spot spot = view.spot(point[view.across()], point[view.up()]);
    if (i == 0) canvas.move_to(spot);
    canvas.line_to(spot);
  }
  canvas.stroke({.colour = ideal_colour, .width = 1.6});
}

// The corner of the view that is farthest from all pulses, as an area of this size.
Area emptiest_corner(const View& view, const std::vector<Shown>& shown, double size) {
  constexpr double gap = 8;
  const Area& frame = view.frame();
  Area best;
  double farthest = -1;
  for (const double x : {frame.x + gap, frame.right() - gap - size}) {
    for (const double y : {frame.y + gap, frame.bottom() - gap - size}) {
      const Spot middle{x + size / 2, y + size / 2};
      double nearest = INFINITY;
      for (const Shown& one : shown) {
        const Spot spot = view.spot(one.place);
        nearest = std::min(nearest, std::hypot(spot.x - middle.x, spot.y - middle.y));
      }
      if (nearest <= farthest) continue;
      farthest = nearest;
      best = {x, y, size, size};
    }
  }
  return best;
}

// Where single pulses cannot be seen, the middle of the move is shown magnified too, in a corner of the view.
void draw_magnified(Canvas& canvas, const View& view, const std::vector<Shown>& shown, const StepMove& move) {
  constexpr double pixels = 12;  // a step
  const double size = 0.42 * std::min(view.frame().width, view.frame().height);
  const double steps = std::floor(size / pixels);
  if (view.has_dots() || steps < 4) return;
  const Place& middle = shown[shown.size() / 2].place;
  const auto begin = [&](std::size_t axis) { return View::value(middle, axis) - std::floor(steps / 2) - 0.5; };
  const Spot low{begin(view.across()), begin(view.up())};
  const View near(view, low, steps, emptiest_corner(view, shown, size));
  std::vector<Shown> inside;
  for (const Shown& one : shown) {
    if (near.shows(one.place)) inside.push_back(one);
  }

  const Pen mark{.colour = {0.25, 0.27, 0.30}, .width = 1};
  const Spot corner = view.spot(low.x, low.y + steps);
  const double least = 5;  // a frame that is smaller cannot be seen
  const double side = std::max(least, steps * view.scale());
  canvas.frame({corner.x, corner.y, side, side}, mark);
  canvas.line({corner.x + side / 2, corner.y + side / 2}, {near.frame().x + size / 2, near.frame().y + size / 2},
              {.colour = mark.colour, .width = 0.8, .dashes = {2, 3}});
  canvas.fill(near.frame(), paper);
  canvas.clip(near.frame());
  draw_grid(canvas, near);
  if (!inside.empty()) draw_pulses(canvas, near, inside);
  draw_ideal(canvas, near, move);
  canvas.end_clip();
  canvas.frame(near.frame(), mark);
  // The place stands above or below the part, on the side of the view's middle.
  const std::string caption = "at " + coordinates(middle);
  const bool is_high = near.frame().y + size / 2 < view.frame().y + view.frame().height / 2;
  const double y = is_high ? near.frame().bottom() + 10 : near.frame().y - 10;
  const double width = canvas.text_width(caption, tick_font);
  const double x = near.frame().x + size / 2;
  canvas.fill({x - width / 2 - 3, y - 8, width + 6, 16}, paper);
  canvas.text({x, y}, caption, tick_font, Align::centre);
}

void draw_view(Canvas& canvas, const View& view, const std::vector<Shown>& shown, const StepMove& move) {
  draw_grid(canvas, view);
  draw_ticks(canvas, view);
  draw_pulses(canvas, view, shown);
  draw_ideal(canvas, view, move);
  draw_magnified(canvas, view, shown, move);
}

std::string figures(const Measures& found) {
  std::string text = fmt::format("{} pulses", found.pulses);
  if (found.together != 0) text += fmt::format(", {} of several axes", found.together);
  if (found.idle != 0) text += fmt::format(", {} of none", found.idle);
  return text;
}
std::string deviations(const Measures& found) {
  return fmt::format("off by {:.3f} step at most, {:.3f} on average", found.largest_deviation, found.mean_deviation);
}

std::string move_text(const StepMove& move) {
  const std::string ends = coordinates(move.from) + " to " + coordinates(move.to);
  if (!move.arc) return "Line from " + ends;
  return fmt::format("{} arc about {} from {}", move.arc->clockwise ? "Clockwise" : "Counterclockwise",
                     coordinates(move.arc->centre), ends);
}

struct Key {
  const char* text;
  Colour colour;
  bool line;
};

void draw_legend(Canvas& canvas, double x, double y) {
  const Key keys[] = {{"ideal path", ideal_colour, true},
                      {"one axis steps", one_axis, false},
                      {"several step at once", together, false},
                      {"waits for a pulse or more", waiting, false}};
  for (const Key& key : keys) {
    if (key.line) {
      canvas.line({x, y}, {x + 22, y}, {.colour = key.colour, .width = 1.6});
    } else {
      canvas.disc({x + 14, y}, 5, key.colour);
    }
    canvas.text({x + 28, y}, key.text, caption_font);
    x += 28 + canvas.text_width(key.text, caption_font) + 26;
  }
}

// --- evenness of speed ----------------------------------------------------------------------------------------------

struct RuleLook {
  const char* name;
  Colour colour;
};
const std::array<RuleLook, speed_rules> rule_looks = {{{"every pulse the same time", {0.55, 0.30, 0.65}},
                                                       {"\u221An for a pulse of n axes", {0.93, 0.55, 0.10}},
                                                       {"exact", {0.18, 0.55, 0.34}}}};

using Lags = std::array<std::vector<Spot>, speed_rules>;  // x: time 0…1; y: steps ahead of a point at even speed

Lags lags(const StudiedMethod& studied, const StepMove& move) {
  double way = 0;
  static_cast<void>(follow(studied.method, move, [&](const Followed& now) { way += way_of(now.pulse); }).has_value());
  const double length = IdealPath(move).length();
  Lags all;
  for (std::size_t rule = 0; rule < speed_rules; ++rule) {
    SpeedClock clock(static_cast<SpeedRule>(rule), studied.measures.pulses, way);
    all[rule] = {{0, 0}};
    const auto add = [&](const Followed& now) {
      const double time = clock.after(now);
      all[rule].push_back({time, (now.progress - time) * length});
    };
    static_cast<void>(follow(studied.method, move, add).has_value());
  }
  return all;
}

void draw_deviation(Canvas& canvas, const StudiedMethod& studied, const StepMove& move, const Area& area) {
  std::vector<Spot> curve = {{0, 0}};
  const auto add = [&](const Followed& now) { curve.push_back({now.progress, now.deviation}); };
  static_cast<void>(follow(studied.method, move, add).has_value());
  const double most = axis_end(std::max(0.5, studied.measures.largest_deviation));
  Chart chart(canvas, area, {.title = "share of the way"},
              {.title = "distance from the ideal path, steps", .end = most});
  chart.draw_grid();
  chart.polyline(curve, {.colour = one_axis, .width = 1.5});
  chart.draw_frame();
}

void draw_evenness(Canvas& canvas, const StudiedMethod& studied, const StepMove& move, const Area& area) {
  const Lags all = lags(studied, move);
  double most = 0.5;
  for (const auto& curve : all) {
    for (const Spot& spot : curve) most = std::max(most, std::abs(spot.y));
  }
  most = axis_end(most);
  Chart chart(canvas, area, {.title = "share of the time"},
              {.title = "ahead of a point at constant speed, steps", .end = most, .begin = -most});
  chart.draw_grid();
  for (std::size_t rule = 0; rule < speed_rules; ++rule) {
    const double y = area.y - 70 + 17 * static_cast<double>(rule);
    canvas.line({area.x, y}, {area.x + 22, y}, {.colour = rule_looks[rule].colour, .width = 2});
    canvas.text({area.x + 28, y},
                fmt::format("{}: fastest step {:.2f} \u00D7 the slowest", rule_looks[rule].name,
                            studied.measures.evenness[rule].ratio),
                caption_font);
    chart.polyline(all[rule], {.colour = rule_looks[rule].colour, .width = 1.5});
  }
  chart.draw_frame();
}

// --- the sheet ------------------------------------------------------------------------------------------------------

struct Panel {
  std::size_t method = 0;
  std::size_t up = 1;  // the axis that points up; X points right
};

std::vector<Panel> panels(const StepMove& move, std::size_t methods) {
  std::vector<Panel> all;
  for (std::size_t method = 0; method < methods; ++method) {
    all.push_back({method, 1});
    if (move.axes() > 2) all.push_back({method, 2});
  }
  return all;
}

// The number of columns that makes views of this shape as large as possible.
std::size_t best_columns(std::size_t count, double aspect, const Area& area) {
  std::size_t best = 1;
  double largest = 0;
  for (std::size_t columns = 1; columns <= count; ++columns) {
    const auto rows = static_cast<double>((count + columns - 1) / columns);
    const double width = area.width / static_cast<double>(columns) - 60;
    const double height = area.height / rows - 110;
    const double scale = std::min(width / aspect, height);
    if (scale > largest) {
      largest = scale;
      best = columns;
    }
  }
  return best;
}

double aspect_of(const StepMove& move) {
  const std::vector<Shown> ends = {{.place = move.from}, {.place = move.to}};
  const View view(ends, move, 0, 1, {0, 0, 1000, 1000});
  return view.frame().width / view.frame().height;
}

void draw_panels(Canvas& canvas, const StepMove& move, const std::vector<StudiedMethod>& methods, const Area& area) {
  const std::vector<Panel> all = panels(move, methods.size());
  const std::size_t columns = best_columns(all.size(), aspect_of(move), area);
  const std::size_t rows = (all.size() + columns - 1) / columns;
  const double width = area.width / static_cast<double>(columns);
  const double height = area.height / static_cast<double>(rows);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Area cell{area.x + static_cast<double>(i % columns) * width,
                    area.y + static_cast<double>(i / columns) * height, width, height};
    const StudiedMethod& studied = methods[all[i].method];
    canvas.text({cell.x, cell.y + 14}, title(studied.method), heading_font);
    canvas.text({cell.x, cell.y + 36}, figures(studied.measures), caption_font);
    canvas.text({cell.x, cell.y + 54}, deviations(studied.measures), caption_font);
    const std::vector<Shown> shown = followed(studied.method, move);
    const View view(shown, move, 0, all[i].up, {cell.x + 30, cell.y + 80, width - 60, height - 110});
    draw_view(canvas, view, shown, move);
  }
}

}  // namespace

Status<OutputError> draw_interpolation(const StepMove& move, const std::vector<StudiedMethod>& methods,
                                       PictureFormat format, OutputFile& file) {
  PictureOptions options{.format = format, .program = {}, .machine = {}};
  options.width = 1400;
  options.height = 900;
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  canvas.fill({0, 0, width, height}, paper);
  canvas.text({margin, 36}, move_text(move), title_font);
  draw_legend(canvas, margin, 66);
  const double charts = methods.size() == 1 && methods[0].measures.pulses > 0 ? 290 : 0;
  draw_panels(canvas, move, methods, {margin, 92, width - 2 * margin, height - 92 - 16 - charts});
  if (charts > 0) {
    const double half = width / 2 - margin - 50;
    draw_deviation(canvas, methods[0], move, {margin + 30, height - 190, half, 134});
    draw_evenness(canvas, methods[0], move, {width / 2 + 50, height - 190, half, 134});
  }
  return canvas.finish();
}

}  // namespace passo
