#include "passo/report/wire_picture.hpp"

#include <algorithm>
#include <string>

#include "plan_view.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr Colour block_colour{0.93, 0.95, 0.98};
constexpr Colour stays_colour{0.93, 0.80, 0.62};
const Pen end_pen{.colour = {0.62, 0.66, 0.71}, .width = 1};

void trace_wire(Canvas& canvas, const PlanView& view, const std::vector<WirePlace>& way, bool is_left, const Pen& pen) {
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Spot spot = view.spot(is_left ? way[i].left : way[i].right);
    i == 0 ? canvas.move_to(spot) : canvas.line_to(spot);
  }
  canvas.stroke(pen);
}

// One face of the block.
void draw_face(Canvas& canvas, const PlanView& view, const WireScene& scene, bool is_left) {
  const WirePlan& plan = scene.plan;
  if (scene.block) {
    std::vector<Spot> corners;
    for (const DrawnPoint& corner : rectangle(*scene.block)) corners.push_back(view.spot(corner));
    canvas.fill(corners, block_colour);
  }
  for (const DrawnRing& ring : (is_left ? plan.left : plan.right).face.rings) {
    std::vector<Spot> polygon;
    for (const DrawnPoint& point : ring) polygon.push_back(view.spot(point));
    canvas.fill(polygon, stays_colour);
  }
  const std::vector<double>& kerfs = is_left ? plan.kerfs_left : plan.kerfs_right;
  const Colour& colour = colour_of_tool(is_left ? 0 : 1);
  const auto spot = [&](std::size_t i) { return view.spot(is_left ? plan.faces[i].left : plan.faces[i].right); };
  for (std::size_t i = 1; i < plan.faces.size();) {
    // Ways of one kerf are one stroke: where two strokes meet, their ends would show.
    const double kerf = kerfs[i];
    canvas.move_to(spot(i - 1));
    for (; i < plan.faces.size() && kerfs[i] == kerf; ++i) canvas.line_to(spot(i));
    canvas.stroke({.colour = colour, .width = std::max(0.6, view.pixels(to_nanometres(Mm(kerf)))), .opacity = 0.35});
  }
  if (scene.has_four_axes) trace_wire(canvas, view, plan.towers, is_left, end_pen);
  trace_wire(canvas, view, plan.faces, is_left, {.colour = colour, .width = 0.8});
}

DrawnBox box_of(const WireScene& scene) {
  DrawnBox box{scene.plan.faces.front().left, scene.plan.faces.front().left};
  if (scene.block) {
    extend(box, scene.block->least);
    extend(box, scene.block->most);
  }
  for (const std::vector<WirePlace>* way : {&scene.plan.faces, &scene.plan.towers}) {
    for (const WirePlace& at : *way) {
      extend(box, at.left);
      extend(box, at.right);
    }
  }
  return box;
}

}  // namespace

Status<OutputError> draw_wire_cut(const WireScene& scene, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const WirePlan& plan = scene.plan;
  double minutes = 0;
  for (const double time : plan.minutes) minutes += time;
  begin_sheet(canvas, options, fmt::format("{:.1f} min of cutting at the feed", minutes));
  const double top = 100;
  const double height = options.height - 190.0;
  const double half = scene.has_four_axes ? height / 2 - 14 : height;
  const DrawnBox box = box_of(scene);
  for (const bool is_left : {true, false}) {
    if (!is_left && !scene.has_four_axes) break;
    const Area area{sheet::margin, is_left ? top : top + height / 2 + 14, options.width - 2 * sheet::margin, half};
    draw_face(canvas, PlanView(box, area), scene, is_left);
    const char* const words = !scene.has_four_axes ? "X Y" : is_left ? "Left face, X Y" : "Right face, U V";
    canvas.text({sheet::margin, area.y + 4}, words, sheet::caption);
  }
  Legend legend(canvas, {sheet::margin, options.height - 40.0});
  if (scene.block) legend.patch(block_colour, "Block");
  legend.patch(stays_colour, "Drawn");
  const auto kerf_words = [](const WireSide& side) {
    return side.most_kerf - side.least_kerf < 0.005
               ? fmt::format("kerf {:.2f} mm", side.most_kerf)
               : fmt::format("kerf {:.2f} to {:.2f} mm", side.least_kerf, side.most_kerf);
  };
  if (!scene.has_four_axes) {
    legend.patch(colour_of_tool(0), kerf_words(plan.left));
  } else {
    legend.patch(colour_of_tool(0), "left " + kerf_words(plan.left));
    legend.patch(colour_of_tool(1), "right " + kerf_words(plan.right));
    legend.line(end_pen, "Ends of the wire");
  }
  return canvas.finish();
}

}  // namespace passo
