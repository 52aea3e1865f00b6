#include "passo/report/stock_picture.hpp"

#include <algorithm>
#include <cmath>

#include "face_view.hpp"
#include "sheet.hpp"
#include "stock_shading.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using namespace sheet;

// A bar of colours from `low` to `high`, with words at its ends and below.
template <class ColourAt>
void draw_bar(Canvas& canvas, const Area& area, const std::string& low, const std::string& high,
              const std::string& words, const ColourAt& colour_at) {
  constexpr int pieces = 100;
  for (int i = 0; i < pieces; ++i) {
    const double share = (i + 0.5) / pieces;
    // Each piece reaches to the end, and the next one covers it: so there are no seams.
    const double from = area.width * i / pieces;
    canvas.fill({area.x + from, area.y, area.width - from, area.height}, colour_at(share));
  }
  canvas.frame(area, edge);
  canvas.text({area.x, area.bottom() + 14}, low, label);
  canvas.text({area.right(), area.bottom() + 14}, high, label, Align::right);
  canvas.text({area.x + area.width / 2, area.bottom() + 14}, words, label, Align::centre);
}

void draw_legend(Canvas& canvas, const StockDrawing& drawing, const StockShading& shading, const Area& area) {
  if (drawing.target == nullptr) {
    draw_bar(canvas, area, "0", fmt::format("{:.3g} mm", shading.deepest()), "depth below the top",
             [&](double share) { return shading.colour_of_depth(share * shading.deepest()); });
    return;
  }
  const double gap = 12;
  const double third = (area.width - 2 * gap) / 3;
  const auto bar = [&](int place, double largest, double sign, const std::string& words) {
    const Area here{area.x + place * (third + gap), area.y, third, area.height};
    draw_bar(canvas, here, words, fmt::format("{:.3g} mm", largest), "",
             [&](double share) { return shading.colour_of_difference(sign * share * largest); });
  };
  bar(0, shading.largest_gouge(), -1, "gouges");
  const Area even{area.x + third + gap, area.y, third, area.height};
  canvas.fill(even, even_colour);
  canvas.frame(even, edge);
  canvas.text({even.x + third / 2, area.bottom() + 14}, fmt::format("within {:.3g} mm", drawing.tolerance.value()),
              label, Align::centre);
  bar(2, shading.largest_left(), 1, "material left");
}

Box box_of(const HeightField& field) {
  Box box;
  const auto set = [](Point& point, const Vector3& place) {
    point[Axis::x] = place.x;
    point[Axis::y] = place.y;
    point[Axis::z] = place.z;
  };
  set(box.low, field.block().low);
  set(box.high, {field.block().low.x + static_cast<double>(field.columns()) * field.cell(),
                 field.block().low.y + static_cast<double>(field.rows()) * field.cell(), field.top()});
  return box;
}

}  // namespace

Status<OutputError> draw_stock(const StockDrawing& drawing, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  begin_sheet(canvas, options);
  const StockShading shading(drawing);
  constexpr double upper = 132;
  constexpr double lower = 64;
  const double width = options.width;
  const double height = options.height;
  const int scale = options.format == PictureFormat::png ? options.pixels_per_unit : 2;

  const FaceExtent face{drawing.field.block().low.x, drawing.field.block().low.y,
                        static_cast<double>(drawing.field.columns()) * drawing.field.cell(),
                        static_cast<double>(drawing.field.rows()) * drawing.field.cell()};
  const Area above = fitted(face, {margin + 48, upper, width * 0.52 - margin, height - upper - lower});
  canvas.image(above,
               shading.from_above(static_cast<int>(above.width) * scale, static_cast<int>(above.height) * scale));
  canvas.frame(above, edge);
  draw_scales(canvas, face, above);

  const double left = above.right() + 48;
  const Area body{std::floor(left), upper, std::floor(width - margin - left), height - upper - lower - 70};
  Projection projection = Projection::isometric();
  projection.fit(box_of(drawing.field), body);
  canvas.image(body, shading.as_body(projection, body, scale));
  const double bar_width = std::min(body.width, 520.0);
  draw_legend(canvas, drawing, shading, {body.x + (body.width - bar_width) / 2, height - lower - 34, bar_width, 14});
  return canvas.finish();
}

}  // namespace passo
