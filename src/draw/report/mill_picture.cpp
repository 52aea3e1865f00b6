#include "passo/report/mill_picture.hpp"

#include <algorithm>
#include <cmath>

#include "plan_view.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

constexpr Colour face_colour{0.93, 0.80, 0.62};
constexpr Colour warning_colour{0.80, 0.05, 0.05};
constexpr Nanometres drawn_chords{20'000};
const Pen sheet_pen{.colour = {0.45, 0.33, 0.18}, .width = 1.4};
const Pen offcut_pen{.colour = {0.45, 0.33, 0.18}, .width = 1.4, .dashes = {6, 4}};

PlanView view_of(const MillScene& scene, const Area& area) {
  DrawnPoint start = scene.park;
  if (scene.rapids && !scene.rapids->empty()) start = scene.rapids->front().front();
  DrawnBox box = bounds(scene.face).value_or(DrawnBox{start, start});
  if (scene.rapids || !scene.link.start || !scene.link.ends_in_place) extend(box, start);
  for (const DrawnRing& line : scene.rapids.value_or(std::vector<DrawnRing>())) {
    for (const DrawnPoint& point : line) extend(box, point);
  }
  if (scene.sheet) {
    extend(box, scene.sheet->least);
    extend(box, scene.sheet->most);
  }
  for (const MillTool& tool : scene.plan.tools) {
    for (const MillRun& run : tool.runs) {
      for (const MillPoint& point : run) extend(box, point.at);
    }
  }
  return {box, area};
}

// From wide to narrow: a hole is paper on what it lies in.
void fill_region(Canvas& canvas, const PlanView& view, const Region& region, const Colour& colour) {
  std::vector<std::pair<double, const DrawnRing*>> rings;
  for (const DrawnRing& ring : region.rings) rings.emplace_back(area_mm2(ring), &ring);
  std::ranges::stable_sort(rings, [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  for (const auto& [area, ring] : rings) {
    std::vector<Spot> polygon;
    polygon.reserve(ring->size());
    for (const DrawnPoint& point : *ring) polygon.push_back(view.spot(point));
    canvas.fill(polygon, area > 0 ? colour : sheet::paper);
  }
}

void draw_ways(Canvas& canvas, const PlanView& view, const MillTool& tool, const Pen& pen) {
  for (const MillRun& run : tool.runs) {
    const std::vector<DrawnPoint> points = chords_of(run, drawn_chords);
    canvas.move_to(view.spot(points.front()));
    for (std::size_t i = 1; i < points.size(); ++i) canvas.line_to(view.spot(points[i]));
    canvas.stroke(pen);
  }
}

// Returns where the next tool comes from. `to`: where this one goes; empty: it stays at its last cut.
DrawnPoint draw_rapids(Canvas& canvas, const PlanView& view, const MillTool& tool, DrawnPoint at,
                       std::optional<DrawnPoint> to) {
  for (const MillRun& run : tool.runs) {
    canvas.move_to(view.spot(at));
    canvas.line_to(view.spot(run.front().at));
    canvas.stroke(rapids_pen);
    at = run.back().at;
  }
  if (!to) return at;
  canvas.move_to(view.spot(at));
  canvas.line_to(view.spot(*to));
  canvas.stroke(rapids_pen);
  return *to;
}

void draw_known_rapids(Canvas& canvas, const PlanView& view, const std::vector<DrawnRing>& rapids) {
  for (const DrawnRing& line : rapids) {
    canvas.move_to(view.spot(line.front()));
    for (std::size_t i = 1; i < line.size(); ++i) canvas.line_to(view.spot(line[i]));
    canvas.stroke(rapids_pen);
  }
}

double length_of_lines(const std::vector<DrawnRing>& lines) {
  double length = 0;
  for (const DrawnRing& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      length += std::hypot(static_cast<double>(line[i].x.count - line[i - 1].x.count),
                           static_cast<double>(line[i].y.count - line[i - 1].y.count));
    }
  }
  return length;
}

void draw_mark(Canvas& canvas, Spot middle) {
  constexpr double radius = 9;
  constexpr int corners = 24;
  for (int i = 0; i <= corners; ++i) {
    const double angle = 2 * 3.14159265358979 * i / corners;
    const Spot spot{middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)};
    i == 0 ? canvas.move_to(spot) : canvas.line_to(spot);
  }
  canvas.stroke({.colour = warning_colour, .width = 2});
}

void draw_sheet(Canvas& canvas, const PlanView& view, const DrawnBox& sheet) {
  const DrawnRing corners = rectangle(sheet);
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    const Spot spot = view.spot(corners[i % corners.size()]);
    i == 0 ? canvas.move_to(spot) : canvas.line_to(spot);
  }
  canvas.stroke(sheet_pen);
}

}  // namespace

Status<OutputError> draw_mill_plan(const MillScene& scene, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  MillLengths all;
  for (const MillLengths& lengths : lengths_of(scene.plan, scene.park, scene.link)) {
    all.runs += lengths.runs;
    all.milled_nm += lengths.milled_nm;
    all.rapids_nm += lengths.rapids_nm;
  }
  if (scene.rapids) all.rapids_nm = length_of_lines(*scene.rapids);
  begin_sheet(
      canvas, options,
      fmt::format("{} down   \u00B7   {:.1f} mm milled   \u00B7   {:.1f} mm of rapids", counted(all.runs, "time"),
                  all.milled_nm / nanometres_per_mm, all.rapids_nm / nanometres_per_mm));
  const Area area{sheet::margin, 100, options.width - 2 * sheet::margin, options.height - 190.0};
  const PlanView view = view_of(scene, area);
  if (scene.sheet) draw_sheet(canvas, view, *scene.sheet);
  if (scene.sheet && scene.offcut) {
    canvas.move_to(view.spot({*scene.offcut, scene.sheet->least.y}));
    canvas.line_to(view.spot({*scene.offcut, scene.sheet->most.y}));
    canvas.stroke(offcut_pen);
  }
  fill_region(canvas, view, scene.face, face_colour);
  fill_region(canvas, view, scene.warned, warning_colour);
  constexpr double thinnest = 0.6;
  for (std::size_t i = 0; i < scene.plan.tools.size(); ++i) {
    const MillTool& tool = scene.plan.tools[i];
    const double width = std::max(thinnest, view.pixels(tool.width));
    draw_ways(canvas, view, tool, {.colour = colour_of_tool(i), .width = width, .opacity = 0.35});
  }
  DrawnPoint at = scene.link.from(scene.park);
  for (std::size_t i = 0; i < scene.plan.tools.size(); ++i) {
    if (!scene.rapids) {
      const std::optional<DrawnPoint> to = scene.link.to(scene.park, i + 1 == scene.plan.tools.size());
      at = draw_rapids(canvas, view, scene.plan.tools[i], at, to);
    }
    draw_ways(canvas, view, scene.plan.tools[i], {.colour = colour_of_tool(i), .width = thinnest});
  }
  if (scene.rapids) draw_known_rapids(canvas, view, *scene.rapids);
  for (const DrawnPoint& mark : scene.marks) draw_mark(canvas, view.spot(mark));

  constexpr std::size_t most_named = 7;
  Legend legend(canvas, {sheet::margin, options.height - 40.0});
  if (scene.sheet) legend.line(sheet_pen, "Sheet");
  if (scene.sheet && scene.offcut) legend.line(offcut_pen, "Offcut");
  if (!scene.face.empty()) legend.patch(face_colour, scene.face_name);
  for (std::size_t i = 0; i < std::min(most_named, scene.plan.tools.size()); ++i) {
    legend.patch(colour_of_tool(i), scene.plan.tools[i].words);
  }
  legend.line(rapids_pen, "Rapids");
  if (!scene.warned.empty() && !scene.warned_name.empty()) legend.patch(warning_colour, scene.warned_name);
  if (!scene.marks.empty()) legend.line({.colour = warning_colour, .width = 2}, scene.mark_name);
  return canvas.finish();
}

}  // namespace passo
