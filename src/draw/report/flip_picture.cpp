#include "passo/report/flip_picture.hpp"

#include <algorithm>

#include "plan_view.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr Colour flip_board{0.89, 0.83, 0.66};
constexpr Colour flip_copper{0.85, 0.60, 0.25};
constexpr Colour first_hole{0.12, 0.40, 0.70};
constexpr Colour second_hole{0.80, 0.35, 0.10};
constexpr Colour axis_colour{0.75, 0.15, 0.30};

DrawnBox box_of_scene(const FlipScene& scene) {
  DrawnBox box{scene.holes[0], scene.holes[0]};
  for (const DrawnPoint& hole : scene.holes) {
    extend(box, {hole.x - scene.diameter, hole.y - scene.diameter});
    extend(box, {hole.x + scene.diameter, hole.y + scene.diameter});
  }
  for (const Region* const region : {&scene.face, &scene.front, &scene.back}) {
    const std::optional<DrawnBox> of_one = bounds(*region);
    if (!of_one) continue;
    for (const Mirror& mirror : {Mirror{}, scene.mirror}) {
      extend(box, mirrored(of_one->least, mirror));
      extend(box, mirrored(of_one->most, mirror));
    }
  }
  return box;
}

class FlipDrawing {
 public:
  FlipDrawing(Canvas& canvas, const FlipScene& scene, const DrawnBox& box, const Area& area)
      : canvas_(canvas), scene_(scene), box_(box), area_(area), view_(box, area) {}

  void draw(const Region& copper, const Mirror& mirror, const char* words) {
    canvas_.text({area_.x + area_.width / 2, area_.y - 18}, words, sheet::caption, Align::centre);
    fill(mirrored(scene_.face, mirror), flip_board);
    fill(mirrored(copper, mirror), flip_copper);
    draw_axis();
    for (const std::size_t i : {0U, 1U}) draw_hole(i, mirrored(scene_.holes[i], mirror));
  }

 private:
  void fill(const Region& region, const Colour& colour) {
    for (const DrawnRing& ring : region.rings) {
      canvas_.move_to(view_.spot(ring.front()));
      for (std::size_t i = 1; i < ring.size(); ++i) canvas_.line_to(view_.spot(ring[i]));
      canvas_.line_to(view_.spot(ring.front()));
    }
    if (!region.empty()) canvas_.fill_path(colour);
  }
  void draw_axis() {
    const bool is_x = scene_.mirror.turned == Mirror::Turned::x;
    const Nanometres at = scene_.mirror.at;
    const DrawnPoint from = is_x ? DrawnPoint{at, box_.least.y} : DrawnPoint{box_.least.x, at};
    const DrawnPoint to = is_x ? DrawnPoint{at, box_.most.y} : DrawnPoint{box_.most.x, at};
    canvas_.line(view_.spot(from), view_.spot(to), {.colour = axis_colour, .width = 1.4, .dashes = {8, 5}});
    const Spot end = view_.spot(to);
    canvas_.text({end.x + (is_x ? 6 : 0), end.y - (is_x ? 0 : 10)},
                 fmt::format("{}{:.6g}", is_x ? "X" : "Y", to_mm(at).value()), {.size = 12, .colour = axis_colour},
                 is_x ? Align::left : Align::right);
  }
  void draw_hole(std::size_t index, DrawnPoint at) {
    constexpr double least = 7;  // a number fits in
    const double radius = std::max(least, view_.pixels(scene_.diameter) / 2);
    const Spot spot = view_.spot(at);
    canvas_.disc(spot, radius, index == 0 ? first_hole : second_hole);
    canvas_.text(spot, index == 0 ? "1" : "2", {.size = 11, .colour = sheet::paper, .bold = true}, Align::centre);
    canvas_.text({spot.x, spot.y + radius + 11},
                 fmt::format("X{:.6g} Y{:.6g}", to_mm(at.x).value(), to_mm(at.y).value()), sheet::label, Align::centre);
  }

  Canvas& canvas_;
  const FlipScene& scene_;
  const DrawnBox& box_;
  Area area_;
  PlanView view_;
};

}  // namespace

Status<OutputError> draw_flip(const FlipScene& scene, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const bool is_x = scene.mirror.turned == Mirror::Turned::x;
  begin_sheet(canvas, options,
              fmt::format("flipped {}, about {}{:.6g} mm", is_x ? "from left to right" : "from top to bottom",
                          is_x ? "X" : "Y", to_mm(scene.mirror.at).value()));
  const DrawnBox box = box_of_scene(scene);
  constexpr double gap = 40;
  constexpr double top = 140;
  const double width = (options.width - 2 * sheet::margin - gap) / 2;
  const double height = options.height - top - 60;
  FlipDrawing(canvas, scene, box, {sheet::margin, top, width, height}).draw(scene.front, {}, "Before: the front is up");
  FlipDrawing(canvas, scene, box, {sheet::margin + width + gap, top, width, height})
      .draw(scene.back, scene.mirror, "After: the back is up");
  return canvas.finish();
}

}  // namespace passo
