#include "passo/report/drill_picture.hpp"

#include <algorithm>
#include <cmath>

#include "plan_view.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/cam/bulge.hpp"

namespace passo {
namespace {

PlanView view_of(const DrillPlan& plan, DrawnPoint park, const RouteLink& link, const Area& area) {
  DrawnBox box{link.from(park), link.from(park)};
  if (!link.ends_in_place) extend(box, park);
  for (const DrillTool& tool : plan.tools) {
    for (const DrillTarget& target : tool.targets) {
      for (const PathPoint& point : target.points) extend(box, point.at);
    }
  }
  return {box, area};
}

void draw_rapids(Canvas& canvas, const PlanView& view, const DrillPlan& plan, DrawnPoint park, const RouteLink& link) {
  DrawnPoint at = link.from(park);
  for (const DrillTool& tool : plan.tools) {
    canvas.move_to(view.spot(at));
    for (const DrillTarget& target : tool.targets) {
      at = target.points.front().at;
      canvas.line_to(view.spot(at));
    }
    if (const auto to = link.to(park, &tool == &plan.tools.back())) {
      at = *to;
      canvas.line_to(view.spot(at));
    }
    canvas.stroke(rapids_pen);
  }
}

void draw_target(Canvas& canvas, const PlanView& view, const DrillTarget& target, Nanometres diameter,
                 const Colour& colour) {
  constexpr double least = 1;  // a smaller dot cannot be seen
  const DrawnPoint at = target.points.front().at;
  if (target.kind != DrillTarget::Kind::slot) {
    const Nanometres wide{diameter.count + 2 * target.radius.count};
    canvas.disc(view.spot(at), std::max(least, view.pixels(wide) / 2), colour);
    return;
  }
  constexpr int pieces = 24;  // of an arc
  canvas.move_to(view.spot(at));
  const std::size_t count = target.points.size() - (target.radius.count == 0 ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const DrawnPoint from = target.points[i].at;
    const DrawnPoint to = target.points[(i + 1) % target.points.size()].at;
    const double bulge = target.points[i].bulge;
    const int count_of_pieces = bulge == 0 ? 1 : pieces;
    for (int k = 1; k <= count_of_pieces; ++k) {
      canvas.line_to(view.spot(point_along(from, to, bulge, static_cast<double>(k) / count_of_pieces)));
    }
  }
  canvas.stroke({.colour = colour, .width = std::max(least, view.pixels(diameter))});
}

}  // namespace

Status<OutputError> draw_drill_plan(const DrillPlan& plan, DrawnPoint park, const RouteLink& link,
                                    const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  std::size_t holes = 0;
  double rapids = 0;
  for (const DrillTool& tool : plan.tools) {
    holes += tool.targets.size();
    rapids += tool.rapids_after_nm;
  }
  begin_sheet(
      canvas, options,
      fmt::format("{}   \u00B7   {}   \u00B7   {:.1f} mm of rapids", counted(holes, "hole or slot", "holes and slots"),
                  counted(plan.tools.size(), "tool"), rapids / nanometres_per_mm));
  const Area area{sheet::margin, 100, options.width - 2 * sheet::margin, options.height - 190.0};
  const PlanView view = view_of(plan, park, link, area);
  draw_rapids(canvas, view, plan, park, link);
  for (std::size_t i = 0; i < plan.tools.size(); ++i) {
    const DrillTool& tool = plan.tools[i];
    for (const DrillTarget& target : tool.targets) draw_target(canvas, view, target, tool.diameter, colour_of_tool(i));
  }
  constexpr std::size_t most_named = 6;
  Legend legend(canvas, {sheet::margin, options.height - 40.0});
  for (std::size_t i = 0; i < std::min(most_named, plan.tools.size()); ++i) {
    const DrillTool& tool = plan.tools[i];
    legend.dot(6, colour_of_tool(i),
               fmt::format("{} {:.4g} mm: {}", tool.is_mill ? "Mill" : "Drill", to_mm(tool.diameter).value(),
                           tool.holes + tool.slots));
  }
  legend.line(rapids_pen, "Rapids");
  return canvas.finish();
}

}  // namespace passo
