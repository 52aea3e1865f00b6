#include "passo/report/interpolation_picture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"
#include "step_view.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/study/faulty_listing.hpp"
#include "passo/study/ideal_path.hpp"

namespace passo {
namespace {

constexpr double border = 40;

std::string coordinates(const Place& place) {
  return fmt::format("({})", fmt::join(place, ", "));
}

std::vector<Shown> followed(const Method& method, const StepMove& move) {
  std::vector<Shown> all = {{.place = move.from}};
  std::optional<ListingCheck> check;
  if (right_method_of(method)) check.emplace(method, move);
  const auto add = [&](const Followed& now) {
    const int axes = std::popcount(now.pulse.steps);
    const bool wrong = check && check->is_wrong(now.pulse);
    if (axes == 0) {
      all.back().waited = true;
    } else {
      all.push_back({.place = now.place, .axes = axes, .wrong = wrong});
    }
  };
  static_cast<void>(follow(method, move, add).has_value());
  return all;
}

void draw_ideal(Canvas& canvas, const StepView& view, const StepMove& move) {
  const IdealPath path(move);
  const int pieces = move.arc ? 720 : 1;
  for (int i = 0; i <= pieces; ++i) {
    const auto point = path.at(static_cast<double>(i) / pieces);
    const Spot spot = view.spot(point[view.across()], point[view.up()]);
    if (i == 0) canvas.move_to(spot);
    canvas.line_to(spot);
  }
  canvas.stroke({.colour = step_look::ideal_colour, .width = 1.6});
}

// The corner of the view that is farthest from all pulses, as an area of this size.
Area emptiest_corner(const StepView& view, const std::vector<Shown>& shown, double size) {
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
void draw_magnified(Canvas& canvas, const StepView& view, const std::vector<Shown>& shown, const StepMove& move) {
  constexpr double pixels = 12;  // a step
  const double size = 0.42 * std::min(view.frame().width, view.frame().height);
  const double steps = std::floor(size / pixels);
  if (view.has_dots() || steps < 4) return;
  const Place& middle = shown[shown.size() / 2].place;
  const auto begin = [&](std::size_t axis) { return StepView::value(middle, axis) - std::floor(steps / 2) - 0.5; };
  const Spot low{begin(view.across()), begin(view.up())};
  const StepView near(view, low, steps, emptiest_corner(view, shown, size));
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
  canvas.fill(near.frame(), sheet::paper);
  canvas.clip(near.frame());
  draw_step_lines(canvas, near);
  if (!inside.empty()) draw_pulses(canvas, near, inside);
  draw_ideal(canvas, near, move);
  canvas.end_clip();
  canvas.frame(near.frame(), mark);
  // The place stands above or below the part, on the side of the view's middle.
  const std::string caption = "at " + coordinates(middle);
  const bool is_high = near.frame().y + size / 2 < view.frame().y + view.frame().height / 2;
  const double y = is_high ? near.frame().bottom() + 10 : near.frame().y - 10;
  const double width = canvas.text_width(caption, step_look::tick_font);
  const double x = near.frame().x + size / 2;
  canvas.fill({x - width / 2 - 3, y - 8, width + 6, 16}, sheet::paper);
  canvas.text({x, y}, caption, step_look::tick_font, Align::centre);
}

void draw_view(Canvas& canvas, const StepView& view, const std::vector<Shown>& shown, const StepMove& move) {
  draw_step_grid(canvas, view);
  draw_pulses(canvas, view, shown);
  draw_ideal(canvas, view, move);
  draw_magnified(canvas, view, shown, move);
}

std::string figures(const Measures& found) {
  std::string text = counted(found.pulses, "pulse");
  if (found.together != 0) text += fmt::format(", {} of several axes", found.together);
  if (found.idle != 0) text += fmt::format(", {} of none", found.idle);
  return text;
}
std::string deviations(const Measures& found) {
  return fmt::format("off by {:.3f} step at most, {:.3f} on average", found.largest_deviation, found.mean_deviation);
}

// What a faulty listing gets wrong; empty for a method.
std::string fault(const Method& method, const StepMove& move) {
  if (!right_method_of(method)) return {};
  const auto check = check_listing(method, move);
  return check ? check->describe() : std::string();
}

std::string move_text(const StepMove& move) {
  const std::string ends = coordinates(move.from) + " to " + coordinates(move.to);
  if (!move.arc) return "Line from " + ends;
  return fmt::format("{} arc about {} from {}", move.arc->clockwise ? "Clockwise" : "Counterclockwise",
                     coordinates(move.arc->centre), ends);
}

// A view of two axes of the move, on an area of the paper, wide enough for the pulses and the ideal path.
StepView view_of(const std::vector<Shown>& shown, const StepMove& move, std::size_t across, std::size_t up,
                 const Area& area) {
  std::vector<Spot> path;
  const IdealPath ideal(move);
  for (int i = 0; i <= 256; ++i) {
    const auto point = ideal.at(i / 256.0);
    path.push_back({point[across], point[up]});
  }
  return {shown, path, across, up, area};
}

// Master and slaves decide at the middle of the cell's side: a slave steps where the ideal line reaches or passes it.
bool has_midlines(const Method& method, const StepMove& move) {
  return !move.arc && (method.name == MethodName::master_slave || method.name == MethodName::lean);
}

// Draws the middle of each side through which the line leaves a cell, if the view shows the master and a slave.
void draw_midlines(Canvas& canvas, const StepView& view, const std::vector<Shown>& shown, const StepMove& move) {
  const auto length = [&](std::size_t axis) {
    return std::abs(StepView::value(move.to, axis) - StepView::value(move.from, axis));
  };
  double longest = 0;
  for (std::size_t axis = 0; axis < move.axes(); ++axis) longest = std::max(longest, length(axis));
  const bool master_across = length(view.across()) == longest;
  const std::size_t master = master_across ? view.across() : view.up();
  const std::size_t slave = master_across ? view.up() : view.across();
  if (length(master) != longest || length(slave) == longest || length(slave) == 0 || view.scale() < 12) return;
  const double sense = StepView::value(move.to, slave) < StepView::value(move.from, slave) ? -1 : 1;
  for (std::size_t k = 1; k < shown.size(); ++k) {
    const double side = StepView::value(shown[k].place, master);
    const double middle = StepView::value(shown[k - 1].place, slave) + 0.5 * sense;
    const double half = 0.3;
    const Spot from = master_across ? view.spot(side - half, middle) : view.spot(middle, side - half);
    const Spot to = master_across ? view.spot(side + half, middle) : view.spot(middle, side + half);
    canvas.line(from, to, {.colour = step_look::midline_colour, .width = 2.2});
  }
}

// --- evenness of speed ----------------------------------------------------------------------------------------------

struct RuleLook {
  const char* name;
  Colour colour;
};
const std::array<RuleLook, speed_rules> rule_looks = {{{"all pulses equally long", {0.55, 0.30, 0.65}},
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
  Chart chart(canvas, area, {.title = "fraction of the path"},
              {.title = "distance from the ideal path, steps", .end = most});
  chart.draw_grid();
  chart.polyline(curve, {.colour = step_look::one_axis, .width = 1.5});
  chart.draw_frame();
}

void draw_evenness(Canvas& canvas, const StudiedMethod& studied, const StepMove& move, const Area& area) {
  const Lags all = lags(studied, move);
  double most = 0.5;
  for (const auto& curve : all) {
    for (const Spot& spot : curve) most = std::max(most, std::abs(spot.y));
  }
  most = axis_end(most);
  Chart chart(canvas, area, {.title = "fraction of the time"},
              {.title = "ahead of a point at constant speed, steps", .end = most, .begin = -most});
  chart.draw_grid();
  for (std::size_t rule = 0; rule < speed_rules; ++rule) {
    const double y = area.y - 70 + 17 * static_cast<double>(rule);
    canvas.line({area.x, y}, {area.x + 22, y}, {.colour = rule_looks[rule].colour, .width = 2});
    canvas.text({area.x + 28, y},
                fmt::format("{}: fastest step {:.2f} \u00D7 the slowest", rule_looks[rule].name,
                            studied.measures.evenness[rule].ratio),
                step_look::caption_font);
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
  const StepView view = view_of(ends, move, 0, 1, {0, 0, 1000, 1000});
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
    canvas.text({cell.x, cell.y + 14}, passo::title(studied.method), step_look::heading_font);
    canvas.text({cell.x, cell.y + 36}, figures(studied.measures), step_look::caption_font);
    const std::string wrong = fault(studied.method, move);
    canvas.text({cell.x, cell.y + 54}, wrong.empty() ? deviations(studied.measures) : wrong, step_look::caption_font);
    const std::vector<Shown> shown = followed(studied.method, move);
    const StepView view = view_of(shown, move, 0, all[i].up, {cell.x + 30, cell.y + 80, width - 60, height - 110});
    draw_view(canvas, view, shown, move);
    draw_wrong_pulses(canvas, view, shown);
    if (!wrong.empty() && shown.back().place != move.to) draw_wrong_end(canvas, view, shown.back().place);
    if (methods.size() == 1 && has_midlines(studied.method, move)) draw_midlines(canvas, view, shown, move);
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
  canvas.fill({0, 0, width, height}, sheet::paper);
  canvas.text({border, 36}, move_text(move), step_look::title_font);
  std::vector<StepKey> keys = step_keys();
  if (methods.size() == 1 && has_midlines(methods[0].method, move)) {
    keys.push_back({"midline of the cell: a slave axis steps where the ideal path reaches or crosses it",
                    step_look::midline_colour, true});
  }
  if (!methods.empty() && right_method_of(methods[0].method)) {
    keys.push_back({"wrong step", step_look::wrong_colour, false});
  }
  draw_step_keys(canvas, keys, border, 66);
  const double charts = methods.size() == 1 && methods[0].measures.pulses > 0 ? 290 : 0;
  draw_panels(canvas, move, methods, {border, 92, width - 2 * border, height - 92 - 16 - charts});
  if (charts > 0) {
    const double half = width / 2 - border - 50;
    draw_deviation(canvas, methods[0], move, {border + 30, height - 190, half, 134});
    draw_evenness(canvas, methods[0], move, {width / 2 + 50, height - 190, half, 134});
  }
  return canvas.finish();
}

}  // namespace passo
