#include "passo/report/drill_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sheet.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::array<Colour, 6> tool_colours = {{{0.12, 0.40, 0.70},
                                                 {0.80, 0.35, 0.10},
                                                 {0.18, 0.55, 0.34},
                                                 {0.55, 0.30, 0.65},
                                                 {0.70, 0.55, 0.05},
                                                 {0.75, 0.15, 0.30}}};
const Pen rapid_pen{.colour = {0.62, 0.66, 0.71}, .width = 0.9};

const Colour& colour_of(std::size_t tool) {
  return tool_colours[tool % tool_colours.size()];
}

// From places of the plan to places of the paper.
class PlanView {
 public:
  PlanView(const DrillPlan& plan, DrawnPoint park, const Area& area) : area_(area) {
    take(park);
    for (const DrillTool& tool : plan.tools) {
      for (const DrillTarget& target : tool.targets) {
        for (const PathPoint& point : target.points) take(point.at);
      }
    }
    constexpr double air = 2e6;  // nm, around the outermost holes
    low_.x -= air;
    low_.y -= air;
    const double width = high_.x + air - low_.x;
    const double height = high_.y + air - low_.y;
    pixels_ = std::min(area.width / width, area.height / height);
    area_.x += (area.width - width * pixels_) / 2;
    area_.y += (area.height - height * pixels_) / 2;
    area_.height = height * pixels_;
  }

  Spot spot(DrawnPoint at) const {
    return {area_.x + (static_cast<double>(at.x.count) - low_.x) * pixels_,
            area_.bottom() - (static_cast<double>(at.y.count) - low_.y) * pixels_};
  }
  double pixels(Nanometres length) const { return static_cast<double>(length.count) * pixels_; }

 private:
  void take(DrawnPoint at) {
    const Spot place{static_cast<double>(at.x.count), static_cast<double>(at.y.count)};
    low_ = {std::min(low_.x, place.x), std::min(low_.y, place.y)};
    high_ = {std::max(high_.x, place.x), std::max(high_.y, place.y)};
  }

  Area area_;
  Spot low_{1e300, 1e300};
  Spot high_{-1e300, -1e300};
  double pixels_ = 1;
};

void draw_rapids(Canvas& canvas, const PlanView& view, const DrillPlan& plan, DrawnPoint park) {
  for (const DrillTool& tool : plan.tools) {
    canvas.move_to(view.spot(park));
    for (const DrillTarget& target : tool.targets) canvas.line_to(view.spot(target.points.front().at));
    canvas.line_to(view.spot(park));
    canvas.stroke(rapid_pen);
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
    const double sweep = 4 * std::atan(target.points[i].bulge);
    for (int k = 1; k <= (sweep == 0 ? 1 : pieces); ++k) {
      const double share = sweep == 0 ? 1 : static_cast<double>(k) / pieces;
      const double factor = sweep == 0 ? 1 : std::sin(sweep * share / 2) / std::sin(sweep / 2);
      const double lean = -sweep * (1 - share) / 2;
      const auto dx = static_cast<double>(to.x.count - from.x.count);
      const auto dy = static_cast<double>(to.y.count - from.y.count);
      canvas.line_to(view.spot({{from.x.count + std::llround(factor * (dx * std::cos(lean) - dy * std::sin(lean)))},
                                {from.y.count + std::llround(factor * (dx * std::sin(lean) + dy * std::cos(lean)))}}));
    }
  }
  canvas.stroke({.colour = colour, .width = std::max(least, view.pixels(diameter))});
}

}  // namespace

Status<OutputError> draw_drill_plan(const DrillPlan& plan, DrawnPoint park, const PictureOptions& options,
                                    OutputFile& file) {
  Canvas canvas(options, file);
  std::size_t holes = 0;
  double rapids = 0;
  for (const DrillTool& tool : plan.tools) {
    holes += tool.targets.size();
    rapids += tool.rapids_after_nm;
  }
  begin_sheet(canvas, options,
              fmt::format("{} holes and slots   \u00B7   {} tools   \u00B7   {:.1f} mm of rapids", holes,
                          plan.tools.size(), rapids / nanometres_per_mm));
  const Area area{sheet::margin, 100, options.width - 2 * sheet::margin, options.height - 190.0};
  const PlanView view(plan, park, area);
  draw_rapids(canvas, view, plan, park);
  for (std::size_t i = 0; i < plan.tools.size(); ++i) {
    const DrillTool& tool = plan.tools[i];
    for (const DrillTarget& target : tool.targets) draw_target(canvas, view, target, tool.diameter, colour_of(i));
  }
  constexpr std::size_t most_named = 6;
  Legend legend(canvas, {sheet::margin, options.height - 40.0});
  for (std::size_t i = 0; i < std::min(most_named, plan.tools.size()); ++i) {
    const DrillTool& tool = plan.tools[i];
    legend.dot(6, colour_of(i),
               fmt::format("{} {:.4g} mm: {}", tool.is_mill ? "Mill" : "Drill", to_mm(tool.diameter).value(),
                           tool.holes + tool.slots));
  }
  legend.line(rapid_pen, "Rapids");
  return canvas.finish();
}

}  // namespace passo
