#include "part_job_nest.hpp"

#include <algorithm>
#include <cmath>

#include "cam_profile_nest.hpp"
#include <fmt/format.h>

#include "passo/operations/length_text.hpp"
#include "passo/part_job/placed_program.hpp"

namespace passo {
namespace {

double segment_distance(const DrawnPoint& at, const DrawnPoint& a, const DrawnPoint& b) {
  const auto across = static_cast<double>(b.x.count - a.x.count);
  const auto up = static_cast<double>(b.y.count - a.y.count);
  const auto dx = static_cast<double>(at.x.count - a.x.count);
  const auto dy = static_cast<double>(at.y.count - a.y.count);
  const double length2 = across * across + up * up;
  const double share = length2 > 0 ? std::clamp((dx * across + dy * up) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(dx - share * across, dy - share * up);
}

// From the edge of the region, nm; negative inside.
double distance_from(const Region& region, const DrawnPoint& at) {
  double least = 1e300;
  for (const DrawnRing& ring : region.rings) {
    for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
      least = std::min(least, segment_distance(at, ring[last], ring[i]));
    }
  }
  return contains(region, at) ? -least : least;
}

// The radius that the cutter has at a height above its tip, mm.
double radius_at(const Cutter& cutter, double height) {
  double low = 0;
  double high = cutter.radius.value();
  if (cutter.height(Mm(high)).value() <= height) return high;
  constexpr int halvings = 24;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (cutter.height(Mm(middle)).value() <= height ? low : high) = middle;
  }
  return high;
}

bool is_of_part(const PartOperation& operation) {
  return operation.kind != PartKind::face;
}

double unit_of(const PartJob& job) {
  return *mm_of_unit(job.units);
}

std::vector<ProgramPoint> cuts_of(const PartJob& job, const std::string& program) {
  constexpr double step_mm = 0.5;
  std::vector<ProgramPoint> cuts = cut_points_of(program, step_mm / unit_of(job));
  for (ProgramPoint& cut : cuts) cut = {cut.x * unit_of(job), cut.y * unit_of(job), cut.z * unit_of(job)};
  return cuts;
}

DrawnPoint point_of(const ProgramPoint& cut) {
  return {to_nanometres(Mm(cut.x)), to_nanometres(Mm(cut.y))};
}

// Without closed contours: the box around all cuts.
Region box_of_cuts(const PartJob& job, const std::vector<MadeOperation>& made) {
  DrawnRing corners;
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (!is_of_part(job.operations[i])) continue;
    for (const ProgramPoint& cut : cuts_of(job, made[i].program)) corners.push_back(point_of(cut));
  }
  if (corners.empty()) return {};
  const DrawnBox box = box_of(corners);
  const Nanometres least{1'000};  // a single hole has a box, too
  const DrawnBox wider{{box.least.x - least, box.least.y - least}, {box.most.x + least, box.most.y + least}};
  return Region{.rings = {rectangle(wider)}};
}

// How far cuts reach beyond the part.
double reach_of(const PartJob& job, const std::vector<MadeOperation>& made, const Region& outline) {
  double reach = 0;
  for (std::size_t i = 0; i < made.size(); ++i) {
    const PartOperation& operation = job.operations[i];
    if (!is_of_part(operation)) continue;
    for (const std::int32_t tool : {operation.first_tool, operation.tool}) {
      if (tool == 0) continue;
      const Cutter& cutter = job.tools.at(tool).shape.cutter;
      for (const ProgramPoint& cut : cuts_of(job, made[i].program)) {
        const double away = distance_from(outline, point_of(cut)) / nanometres_per_mm;
        reach = std::max(reach, away + radius_at(cutter, std::max(0.0, -cut.z)));
      }
    }
  }
  // Arcs of the program differ from the chords of the outline by some micrometres.
  return std::round(reach * 100) / 100;
}

bool has_tabs(const PartOperation& operation) {
  const auto* const profile = std::get_if<CamProfileArguments>(&operation.arguments);
  if (profile == nullptr || operation.kind != PartKind::profile || profile->side == "inside") return false;
  return !profile->no_tabs && (profile->tabs > 0 || !profile->tab_places.empty());
}

void warn_of_cut_tabs(const PartJob& job, const NestedJob& nested, double reach, Diagnostics& findings) {
  const Nanometres wide = gap_with_tabs(to_nanometres(Mm(reach)));
  const bool any = std::ranges::any_of(job.operations, has_tabs);
  if (!any || nested.options.gap > wide || !has_neighbours(nested.nest)) return;
  Diagnostic finding = job.finding(
      "job.nest-tabs", job.nesting->place,
      fmt::format("with a gap of {:.4g} mm, the cuts of neighbouring copies overlap and go through their tabs, so "
                  "parts may come loose",
                  to_mm(nested.options.gap).value()),
      fmt::format("a nest.gap above {:.4g} mm, or no-tabs and another way to hold the parts", to_mm(wide).value()));
  finding.severity = Severity::warning;
  findings.add(std::move(finding));
}

NestOptions options_of(const PartJob& job, double reach, Diagnostics& findings) {
  const PartNesting& wish = *job.nesting;
  const PartStock& stock = *job.stock;
  NestOptions options{.sheet = {to_nanometres(Mm(stock.width)), to_nanometres(Mm(stock.length))},
                      .rotations = wish.rotations};
  const double room = to_mm(usual_nest_room).value();
  const bool any_tabs = std::ranges::any_of(job.operations, has_tabs);
  const double gap = wish.gap.value_or((any_tabs ? 2 * reach : reach) + room);
  constexpr double rounding = 1e-3;
  if (gap < reach - rounding) {
    findings.add(
        job.finding("job.nest-gap", wish.place,
                    fmt::format("with nest.gap = {:g} mm, the tools would cut into the neighbouring copy", gap),
                    fmt::format("at least {:.4g} mm, the distance that the cuts reach beyond the part", reach)));
  }
  options.gap = to_nanometres(Mm(gap));
  options.margin = to_nanometres(Mm(wish.margin.value_or(wish.gap.value_or(reach + room))));
  for (const PartClamp& clamp : job.clamps) {
    options.obstacles.push_back({{to_nanometres(Mm(clamp.x[0] - stock.x)), to_nanometres(Mm(clamp.y[0] - stock.y))},
                                 {to_nanometres(Mm(clamp.x[1] - stock.x)), to_nanometres(Mm(clamp.y[1] - stock.y))}});
  }
  return options;
}

// Each copy is the nearest one to the copy before.
std::vector<std::size_t> order_of_copies(const NestSheet& sheet, const Region& outline) {
  const DrawnBox box = bounds(outline).value_or(DrawnBox{});
  const DrawnPoint middle{{(box.least.x.count + box.most.x.count) / 2}, {(box.least.y.count + box.most.y.count) / 2}};
  std::vector<DrawnPoint> middles;
  for (const NestPlacement& placement : sheet.placements) middles.push_back(placed(middle, placement));
  std::vector<std::size_t> order;
  std::vector<bool> is_done(middles.size(), false);
  DrawnPoint at{};
  while (order.size() < middles.size()) {
    std::size_t nearest = middles.size();
    for (std::size_t i = 0; i < middles.size(); ++i) {
      if (is_done[i]) continue;
      if (nearest == middles.size() || distance_nm(at, middles[i]) < distance_nm(at, middles[nearest])) nearest = i;
    }
    is_done[nearest] = true;
    at = middles[nearest];
    order.push_back(nearest);
  }
  return order;
}

}  // namespace

DrawnPoint corner_of(const PartStock& stock) {
  return {to_nanometres(Mm(stock.x)), to_nanometres(Mm(stock.y))};
}

Region NestedJob::outlines_on(std::size_t sheet, const PartStock& stock) const {
  Region all;
  const DrawnPoint corner = corner_of(stock);
  for (NestPlacement placement : nest.sheets[sheet].placements) {
    placement.offset = {placement.offset.x + corner.x, placement.offset.y + corner.y};
    for (const DrawnRing& ring : outline.rings) all.rings.push_back(placed(ring, placement));
  }
  return all;
}

Nanometres NestedJob::offcut_of(std::size_t sheet, const PartStock& stock) const {
  return corner_of(stock).x + nest.sheets[sheet].used + options.margin;
}

std::optional<NestedJob> nest_job(const PartJob& job, const std::vector<MadeOperation>& made, const PartJobZero& zero,
                                  Diagnostics& findings, const WorkProgress& progress) {
  const PartNesting& wish = *job.nesting;
  NestedJob nested;
  nested.outline = outline_of_part(job, zero);
  if (nested.outline.empty()) nested.outline = box_of_cuts(job, made);
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (wish.rotations == 1 || !is_of_part(job.operations[i]) || can_be_turned(made[i].program)) continue;
    findings.add(
        job.finding("job.nest-turn", wish.place,
                    fmt::format("'{}' has arcs in vertical planes, which cannot be turned", job.operations[i].title),
                    "nest.rotations = 1"));
  }
  if (nested.outline.empty()) {
    findings.add(
        job.finding("job.nest", wish.place, "the job has no part that could be copied", "an operation with contours"));
  }
  if (findings.any_error()) return std::nullopt;
  const double reach = reach_of(job, made, nested.outline);
  nested.options = options_of(job, reach, findings);
  if (findings.any_error()) return std::nullopt;
  NestShape shape{.name = job.name, .quantity = wish.quantity};
  for (const Region& part : parts_of(nested.outline)) shape.outlines.push_back(part.rings.front());
  auto nest = nest_on_sheets({shape}, nested.options, progress);
  if (!nest) {
    findings.add(job.finding("job.nest-size", wish.place, nest.error().message,
                             "a larger stock, a smaller nest.margin, or clamps elsewhere"));
    return std::nullopt;
  }
  nested.nest = std::move(*nest);
  warn_of_cut_tabs(job, nested, reach, findings);
  return nested;
}

std::vector<std::string> programs_on_sheet(const PartJob& job, const std::string& program, const std::string& park,
                                           const NestedJob& nested, std::size_t sheet) {
  const NestSheet& on = nested.nest.sheets[sheet];
  const DrawnPoint corner = corner_of(*job.stock);
  std::vector<std::string> programs;
  for (const std::string& of_tool : programs_of_tools(program)) {
    for (const std::size_t copy : order_of_copies(on, nested.outline)) {
      const NestPlacement& placement = on.placements[copy];
      const ProgramPlace place{.degrees = placement.degrees,
                               .x = to_mm(placement.offset.x + corner.x).value() / unit_of(job),
                               .y = to_mm(placement.offset.y + corner.y).value() / unit_of(job)};
      programs.push_back(placed_program(of_tool, place, park));
    }
  }
  return programs;
}

}  // namespace passo
