#include "passo/report/foam_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "face_view.hpp"
#include "projection.hpp"
#include "sheet.hpp"
#include "stock_shading.hpp"
#include <fmt/format.h>

#include "passo/base/sensible_number.hpp"
#include "passo/stock/foam_skin.hpp"

namespace passo {
namespace {

constexpr Colour melted_colour{0.99, 0.99, 0.98};

// The largest pieces have colours of their own; crumbs share the last one.
const Colour& colour_of_piece(std::uint32_t piece) {
  static constexpr std::array<Colour, 6> colours = {{{0.93, 0.80, 0.62},
                                                     {0.62, 0.76, 0.88},
                                                     {0.70, 0.84, 0.66},
                                                     {0.84, 0.72, 0.86},
                                                     {0.90, 0.86, 0.58},
                                                     {0.72, 0.72, 0.72}}};
  return colours[std::min<std::size_t>(piece, colours.size() - 1)];
}

std::size_t number_of_cell(const FoamBlock& foam, std::size_t column, std::size_t row, std::size_t slice) {
  return (slice * foam.rows() + row) * foam.columns() + column;
}

Colour colour_of_cell(const FoamDrawing& drawing, std::size_t number) {
  if (drawing.difference != nullptr) {
    if (drawing.difference->of[number] == FoamDifference::Cell::left) return left_colour;
    if (drawing.difference->of[number] == FoamDifference::Cell::gouge) return gouge_colour;
  }
  const std::uint32_t piece = drawing.pieces.of[number];
  return piece == FoamPieces::none ? melted_colour : colour_of_piece(piece);
}

PixelMap face(const FoamDrawing& drawing, std::size_t slice, int width, int height) {
  const FoamBlock& foam = drawing.foam;
  PixelMap map{width, height, {}};
  map.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto cell = [](int place, int of, std::size_t cells) {
    return std::min(cells - 1, static_cast<std::size_t>((place + 0.5) / of * static_cast<double>(cells)));
  };
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t number =
          number_of_cell(foam, cell(x, width, foam.columns()), cell(y, height, foam.rows()), slice);
      map.pixels.push_back(pixel_of(colour_of_cell(drawing, number), 1));
    }
  }
  return map;
}

// The wire goes to the right, X to the back, and Y up.
Spot spot_of(const Projection& projection, const Vector3& place) {
  return projection.spot(place.z, place.x, place.y);
}

// Pixels with the depth of what they show: the nearest triangle counts.
class BodyView {
 public:
  BodyView(const FoamBlock& foam, const Projection& projection, const Area& area, int scale)
      : foam_(foam), projection_(projection), area_(area), scale_(scale) {
    map_.width = static_cast<int>(area.width) * scale;
    map_.height = static_cast<int>(area.height) * scale;
    const std::size_t pixels = static_cast<std::size_t>(map_.width) * static_cast<std::size_t>(map_.height);
    map_.pixels.assign(pixels, 0);
    near_.assign(pixels, -std::numeric_limits<float>::infinity());
  }

  void draw(const SkinTriangle& triangle, const Colour& colour) {
    std::array<Corner2, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = corner(triangle.corners[i]);
    const double area = cross_of(corners[0], corners[1], corners[2]);
    if (area == 0) return;
    const std::uint32_t pixel = pixel_of(colour, brightness(triangle));
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const int from_x = std::max(0, static_cast<int>(std::floor(left)));
    const int to_x = std::min(map_.width - 1, static_cast<int>(std::ceil(right)));
    const int from_y = std::max(0, static_cast<int>(std::floor(top)));
    const int to_y = std::min(map_.height - 1, static_cast<int>(std::ceil(bottom)));
    for (int y = from_y; y <= to_y; ++y) {
      for (int x = from_x; x <= to_x; ++x) {
        const Corner2 at{x + 0.5, y + 0.5, 0};
        const double a = cross_of(corners[1], corners[2], at) / area;
        const double b = cross_of(corners[2], corners[0], at) / area;
        const double c = 1 - a - b;
        constexpr double seam = -1e-6;
        if (a < seam || b < seam || c < seam) continue;
        const auto near = static_cast<float>(a * corners[0].near + b * corners[1].near + c * corners[2].near);
        const std::size_t place =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(map_.width) + static_cast<std::size_t>(x);
        if (near <= near_[place]) continue;
        near_[place] = near;
        map_.pixels[place] = pixel;
      }
    }
  }
  PixelMap take() { return std::move(map_); }

 private:
  struct Corner2 {
    double x = 0;
    double y = 0;
    double near = 0;
  };

  static double cross_of(const Corner2& a, const Corner2& b, const Corner2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  // Seen from the right, the front and above.
  Corner2 corner(const Vector3& place) const {
    const Spot spot = spot_of(projection_, place);
    return {(spot.x - area_.x) * scale_, (spot.y - area_.y) * scale_, place.z - place.x + place.y};
  }
  // Across a cell that the wire came near the distance from the melted edge falls outwards: smoother than triangles
  // are. On the faces of the block there is no such fall.
  Vector3 normal_of(const SkinTriangle& triangle) const {
    const auto near = [](std::size_t at, std::size_t count) {
      return std::pair(at > 0 ? at - 1 : at, std::min(at + 1, count - 1));
    };
    const Vector3 flat = cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
    const bool is_on_face = flat.x == 0 && flat.y == 0;
    if (is_on_face) return flat;
    const auto [left, right] = near(triangle.column, foam_.columns());
    const auto [below, above] = near(triangle.row, foam_.rows());
    const float* const row = foam_.clearance(triangle.row, triangle.slice);
    const Vector3 outwards{double{row[left]} - double{row[right]},
                           double{foam_.clearance(below, triangle.slice)[triangle.column]} -
                               double{foam_.clearance(above, triangle.slice)[triangle.column]},
                           0};
    return outwards == Vector3{} ? flat : outwards;
  }
  double brightness(const SkinTriangle& triangle) const {
    const Vector3 light = Vector3{-0.35, 0.80, 0.48};
    const Vector3 normal = normal_of(triangle);
    const double size = length(normal) * length(light);
    const double towards = size > 0 ? dot(normal, light) / size : 1;
    constexpr double dark = 0.55;
    return dark + (1.08 - dark) * std::max(0.0, towards);
  }

  const FoamBlock& foam_;
  const Projection& projection_;
  Area area_;
  int scale_;
  PixelMap map_;
  std::vector<float> near_;
};

// Which pieces the body shows.
std::vector<bool> shown_of(const FoamPieces& pieces) {
  std::vector<bool> shown;
  bool any = false;
  for (const FoamPieces::Piece& piece : pieces.pieces) {
    // Crumbs are nothing that was cut free.
    const bool is_free = !piece.at_side && 100 * piece.cells >= pieces.pieces.front().cells;
    shown.push_back(is_free);
    any |= is_free;
  }
  if (!any) shown.assign(shown.size(), true);
  return shown;
}

Projection projection_of(const FoamBlock& foam, const Area& area) {
  const StockBlock& block = foam.block();
  Box box;
  const auto set = [](Point& point, const Vector3& place) {
    point[Axis::x] = place.z;
    point[Axis::y] = place.x;
    point[Axis::z] = place.y;
  };
  set(box.low, block.low);
  set(box.high, block.high);
  Projection projection = Projection::isometric();
  projection.fit(box, area);
  return projection;
}

// The block as it was, around what is left.
void draw_edges(Canvas& canvas, const Projection& projection, const StockBlock& block) {
  const auto corner = [&](unsigned bits) {
    return spot_of(projection,
                   {(bits & 1U) != 0 ? block.high.x : block.low.x, (bits & 2U) != 0 ? block.high.y : block.low.y,
                    (bits & 4U) != 0 ? block.high.z : block.low.z});
  };
  for (unsigned bits = 0; bits < 8; ++bits) {
    for (const unsigned side : {1U, 2U, 4U}) {
      if ((bits & side) == 0)
        canvas.line(corner(bits), corner(bits | side), {.colour = {0.80, 0.81, 0.83}, .width = 1});
    }
  }
}

void draw_body(Canvas& canvas, const FoamDrawing& drawing, const Area& area, int scale) {
  const FoamBlock& foam = drawing.foam;
  const Projection projection = projection_of(foam, area);
  draw_edges(canvas, projection, foam.block());
  const std::vector<bool> shown = shown_of(drawing.pieces);
  BodyView view(foam, projection, area, scale);
  // Slots are a few cells wide: fewer cells would not show them.
  foam_skin(foam, 1, [&](const SkinTriangle& triangle) {
    const std::size_t number = number_of_cell(foam, triangle.column, triangle.row, triangle.slice);
    const std::uint32_t piece = drawing.pieces.of[number];
    if (piece != FoamPieces::none && shown[piece]) view.draw(triangle, colour_of_cell(drawing, number));
  });
  canvas.image(area, view.take());
}

void draw_legend(Canvas& canvas, const FoamDrawing& drawing, double height) {
  Legend legend(canvas, {sheet::margin, height - 30.0});
  constexpr std::size_t most = 5;
  for (std::uint32_t piece = 0; piece < std::min(most, drawing.pieces.pieces.size()); ++piece) {
    constexpr double mm3_a_cm3 = 1000;
    legend.patch(colour_of_piece(piece),
                 sensible_number(drawing.pieces.volume(piece, drawing.foam) / mm3_a_cm3, 4) + " cm\u00B3");
  }
  if (drawing.pieces.pieces.size() > most) legend.patch(colour_of_piece(most), "smaller pieces");
  if (drawing.difference == nullptr) return;
  legend.patch(left_colour, "foam left on the target");
  legend.patch(gouge_colour, "melted into the target");
}

}  // namespace

Status<OutputError> draw_foam(const FoamDrawing& drawing, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  begin_sheet(canvas, options);
  const FoamBlock& foam = drawing.foam;
  const double width = options.width;
  const double height = options.height;
  const int scale = options.format == PictureFormat::png ? options.pixels_per_unit : 2;
  constexpr double upper = 140;
  constexpr double lower = 70;
  constexpr double words = 92;  // a face's heading above it, and its scale below
  const double room = (height - upper - lower) / (drawing.has_two_faces ? 2 : 1) - words;
  const FaceExtent extent{foam.block().low.x, foam.block().low.y, static_cast<double>(foam.columns()) * foam.cell(),
                          static_cast<double>(foam.rows()) * foam.cell()};
  Area area = fitted(extent, {sheet::margin + 48, upper + 20, width * 0.46 - sheet::margin, room});
  const double right = area.right();
  for (const std::size_t slice : {std::size_t{0}, foam.slices() - 1}) {
    if (slice > 0 && !drawing.has_two_faces) break;
    canvas.text({area.right(), area.y - 16},
                !drawing.has_two_faces ? "Both faces"
                : slice == 0           ? "Left face"
                                       : "Right face",
                sheet::axis_title, Align::right);
    canvas.image(area,
                 face(drawing, slice, static_cast<int>(area.width) * scale, static_cast<int>(area.height) * scale));
    canvas.frame(area, sheet::edge);
    draw_scales(canvas, extent, area);
    area.y += room + words;
  }
  const double left = std::floor(right + 48);
  const Area body{left, upper - 20, std::floor(width - sheet::margin - left), std::floor(height - upper - lower)};
  draw_body(canvas, drawing, body, scale);
  draw_legend(canvas, drawing, height);
  return canvas.finish();
}

}  // namespace passo
