#include "kicad_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

using std::numbers::pi;

double as_double(Nanometres length) {
  return static_cast<double>(length.count);
}

Nanometres half_of(Nanometres length) {
  return {length.count / 2};
}

// An arc by its middle: the angle there, between the ways to both ends, is half a turn less half of the sweep.
double bulge_by_middle(DrawnPoint from, DrawnPoint middle, DrawnPoint to) {
  const Offset a = offset_of({from.x - middle.x, from.y - middle.y});
  const Offset b = offset_of({to.x - middle.x, to.y - middle.y});
  const double cross = a.x * b.y - a.y * b.x;
  const double angle = std::atan2(std::abs(cross), a.x * b.x + a.y * b.y);
  const double bulge = std::tan((pi - angle) / 2);
  return cross > 0 ? -bulge : bulge;
}

// An arc of more than half a turn is two: the tangent of a quarter of its angle has no bounds.
void append_arc_points(DrawnPoint from, DrawnPoint middle, DrawnPoint to, std::vector<PathPoint>& points) {
  if (middle == from || middle == to) {
    points.push_back({from, 0});
    return;
  }
  const double bulge = bulge_by_middle(from, middle, to);
  if (from != to && std::abs(bulge) <= 1) {
    points.push_back({from, bulge});
    return;
  }
  // Of a whole turn, the middle lies across. Where the middle lies on the line beside both ends, nothing that can be
  // drawn is across.
  constexpr double most_bulge = 1e6;
  const double whole = 4 * std::atan(bulge);
  const double first = from == to ? 1 : std::tan(whole / 8);
  const bool is_flat = from != to && std::abs(bulge) > most_bulge;
  const DrawnPoint across = from == to || is_flat ? middle : point_along(from, to, bulge, 0.5);
  if (is_flat || std::max(std::abs(across.x.count), std::abs(across.y.count)) > farthest_drawn.count) {
    points.push_back({from, 0});
    return;
  }
  points.push_back({from, first});
  points.push_back({across, first});
}

void add_circle(KicadText& text, KicadItem item, const KicadFrame& frame, DrawnPath& path) {
  const DrawnPoint centre = kicad_point(text, item.find("center"));
  const auto radius = std::llround(distance_nm(centre, kicad_point(text, item.find("end"))));
  path.points = {{frame.placed({{centre.x.count + radius}, centre.y}), 1},
                 {frame.placed({{centre.x.count - radius}, centre.y}), 1}};
  path.is_closed = true;
}

// KiCad 6 and later tell start, middle and end; older ones the centre, the start, and an angle clockwise.
void add_arc(KicadText& text, KicadItem item, const KicadFrame& frame, DrawnPath& path) {
  const DrawnPoint start = kicad_point(text, item.find("start"));
  const DrawnPoint end = kicad_point(text, item.find("end"));
  if (const KicadItem mid = item.find("mid")) {
    append_arc_points(frame.placed(start), frame.placed(kicad_point(text, mid)), frame.placed(end), path.points);
    path.points.push_back({frame.placed(end), 0});
    return;
  }
  const KicadItem angle = item.find("angle");
  const double sweep = angle ? std::clamp(-text.number(angle, 0), -360.0, 360.0) / 180 * pi : 0;
  const auto at = [&](double share) {
    const Offset place = turned(offset_of({end.x - start.x, end.y - start.y}), sweep * share);
    return frame.placed(moved(rounded(place), start));
  };
  const double bulge = std::tan(sweep / 8);
  path.points = {{at(0), bulge}, {at(0.5), bulge}, {std::abs(sweep) > 2 * pi - 1e-9 ? at(0) : at(1), 0}};
}

void add_curve(KicadText& text, KicadItem item, const KicadFrame& frame, DrawnPath& path) {
  const std::vector<PathPoint> points = kicad_points(text, item.find("pts"));
  if (points.size() != 4) return;
  Offset p[4];
  for (std::size_t i = 0; i < 4; ++i) p[i] = offset_of(points[i].at);
  const auto bend = [&p](std::size_t i) {
    return std::hypot(p[i].x - 2 * p[i + 1].x + p[i + 2].x, p[i].y - 2 * p[i + 1].y + p[i + 2].y);
  };
  // The second derivative is at most 6 times the bend; a chord of 1/n is off by at most an eighth of it, over n².
  const double chords = std::sqrt(6.0 / 8 * std::max(bend(0), bend(1)) / static_cast<double>(gerber_tolerance.count));
  const double count = std::clamp(std::ceil(chords), 1.0, 2000.0);
  for (double i = 0; i <= count; ++i) {
    const double u = i / count;
    const double v = 1 - u;
    const double weights[] = {v * v * v, 3 * v * v * u, 3 * v * u * u, u * u * u};
    Offset sum;
    for (std::size_t k = 0; k < 4; ++k) sum = {sum.x + weights[k] * p[k].x, sum.y + weights[k] * p[k].y};
    path.points.push_back({frame.placed(rounded(sum)), 0});
  }
}

void add_rectangle(KicadText& text, KicadItem item, const KicadFrame& frame, DrawnPath& path) {
  const DrawnPoint a = kicad_point(text, item.find("start"));
  const DrawnPoint b = kicad_point(text, item.find("end"));
  for (const DrawnPoint& corner : DrawnRing{a, {b.x, a.y}, b, {a.x, b.y}})
    path.points.push_back({frame.placed(corner)});
  path.is_closed = true;
}

// A rectangle about zero; each corner is cut off by `chamfer`, or round. Bits of `chamfered`: 1 lower left, then
// counterclockwise.
DrawnRing rounded_rectangle_ring(Nanometres across, Nanometres up, double radius, double chamfer, unsigned chamfered) {
  DrawnRing ring;
  for (unsigned corner = 0; corner < 4; ++corner) {
    const double right = corner == 1 || corner == 2 ? 1 : -1;
    const double above = corner >= 2 ? 1 : -1;
    const bool is_cut = (chamfered >> corner & 1U) != 0;
    const double inset = is_cut ? chamfer : radius;
    const Offset centre{right * (as_double(across) / 2 - inset), above * (as_double(up) / 2 - inset)};
    const std::size_t chords = is_cut ? 1 : chords_of_arc(radius, pi / 2);
    for (std::size_t i = 0; i <= chords; ++i) {
      const double angle = pi + pi / 2 * (corner + static_cast<double>(i) / static_cast<double>(chords));
      ring.push_back(rounded({centre.x + inset * std::cos(angle), centre.y + inset * std::sin(angle)}));
    }
  }
  return ring;
}

// (rect_delta UP ACROSS): the left side is longer by UP, the lower side by ACROSS.
DrawnRing trapezoid_ring(KicadText& text, KicadItem shape, const KicadPad& pad) {
  const KicadItem delta = shape.find("rect_delta");
  const Nanometres a = delta ? half_of(text.length(delta, 0)) : Nanometres{};
  const Nanometres b = delta ? half_of(text.length(delta, 1)) : Nanometres{};
  const Nanometres x = half_of(pad.across);
  const Nanometres y = half_of(pad.up);
  const Nanometres none{};
  return hull_of({{{none - x - b, none - y - a}, {x + b, none - y + a}, {x - b, y - a}, {none - x + b, y + a}}});
}

unsigned chamfered_corners(KicadItem shape) {
  const KicadItem list = shape.find("chamfer");
  if (!list) return 0;
  constexpr std::string_view names[] = {"bottom_left", "bottom_right", "top_right", "top_left"};
  unsigned corners = 0;
  for (unsigned i = 0; i < 4; ++i) corners |= list.has(names[i]) ? 1U << i : 0U;
  return corners;
}

double share_of(KicadText& text, KicadItem shape, std::string_view name) {
  const KicadItem list = shape.find(name);
  return list ? std::clamp(text.number(list, 0), 0.0, 0.5) : 0;
}

}  // namespace

DrawnPoint KicadFrame::placed(DrawnPoint local) const {
  if (degrees != 0) local = rounded(turned(offset_of(local), degrees / 180 * pi));
  return moved(local, at);
}

DrawnRing KicadFrame::placed(DrawnRing ring) const {
  for (DrawnPoint& point : ring) point = placed(point);
  return ring;
}

DrawnPoint kicad_point(KicadText& text, KicadItem list) {
  if (!list) return {};
  const Nanometres x = text.length(list, 0);
  return {x, {-text.length(list, 1).count}};
}

KicadFrame kicad_frame(KicadText& text, KicadItem item, const KicadFrame& around) {
  const KicadItem at = item.find("at");
  if (!at) {
    text.refuse(item, "kicad.no-place", fmt::format("({} ...) has no position", item.name()), "(at X Y)");
    return {};
  }
  return {around.placed(kicad_point(text, at)), at.word(2) ? std::fmod(text.number(at, 2), 360.0) : 0};
}

std::vector<PathPoint> kicad_points(KicadText& text, KicadItem pts) {
  std::vector<PathPoint> points;
  if (!pts) return points;
  for (KicadItem item = pts.first(); item; item = item.next()) {
    if (item.is("xy")) points.push_back({kicad_point(text, item), 0});
    if (!item.is("arc")) continue;
    const DrawnPoint end = kicad_point(text, item.find("end"));
    append_arc_points(kicad_point(text, item.find("start")), kicad_point(text, item.find("mid")), end, points);
    points.push_back({end, 0});
  }
  return points;
}

std::optional<KicadGraphic> kicad_graphic(KicadText& text, KicadItem item, const KicadFrame& frame, bool fills) {
  std::string_view shape = item.name();
  if (shape.starts_with("gr_") || shape.starts_with("fp_")) shape.remove_prefix(3);
  KicadGraphic graphic;
  DrawnPath& path = graphic.path;
  const KicadItem stroke = item.find("stroke");
  if (const KicadItem width = (stroke ? stroke : item).find("width")) path.width = text.length(width, 0);
  path.width = std::max(path.width, {});
  const bool is_face = shape == "poly" || shape == "circle" || shape == "rect";
  if (shape == "line" || shape == "segment") {
    path.points = {{frame.placed(kicad_point(text, item.find("start"))), 0},
                   {frame.placed(kicad_point(text, item.find("end"))), 0}};
  } else if (shape == "arc") {
    add_arc(text, item, frame, path);
  } else if (shape == "circle") {
    add_circle(text, item, frame, path);
  } else if (shape == "rect") {
    add_rectangle(text, item, frame, path);
  } else if (shape == "poly") {
    path.points = kicad_points(text, item.find("pts"));
    for (PathPoint& point : path.points) point.at = frame.placed(point.at);
    path.is_closed = true;
  } else if (shape == "curve" || shape == "bezier") {
    add_curve(text, item, frame, path);
  } else {
    return std::nullopt;
  }
  if (path.points.size() < 2) return std::nullopt;
  path.line = text.line_of(item);
  // Before KiCad 6 nothing said what is filled: polygons are, and what has no line.
  const KicadItem fill = item.find("fill");
  const std::string_view word = fill ? fill.text(0) : std::string_view();
  const bool says_so = word == "solid" || word == "yes";
  graphic.is_filled = is_face && (fill ? says_so : (shape == "poly" ? fills : path.width.count == 0));
  return graphic;
}

std::vector<DrawnRing> kicad_stroke(const DrawnPath& path) {
  const DrawnRing disc = disc_ring({}, as_double(path.width));
  DrawnRing points = chords_of_path(path.points, path.is_closed, gerber_tolerance);
  if (path.is_closed) points.push_back(points.front());
  std::vector<DrawnRing> rings;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (i > 0 && points[i] == points[i + 1]) continue;
    rings.push_back(convex_swept(disc, points[i], points[i + 1]));
  }
  return rings;
}

std::vector<Region> kicad_stroke_regions(std::span<const DrawnPath> paths) {
  std::vector<Region> regions;
  for (const DrawnPath& path : paths) {
    for (DrawnRing& ring : kicad_stroke(path)) {
      if (ring.size() >= 3) regions.push_back({{std::move(ring)}});
    }
  }
  return regions;
}

std::size_t kicad_stroke_points(const DrawnPath& path) {
  std::size_t chords = 1;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    chords += chords_on(path.points[i].at, path.points[i + 1].at, path.points[i].bulge, gerber_tolerance);
  }
  if (path.is_closed) chords *= 2;  // a circle's second half
  return chords * (2 + 4 * chords_of_arc(as_double(path.width) / 2, pi / 2));
}

KicadItem kicad_layer_of_padstack(KicadItem item, std::string_view layer) {
  const KicadItem stack = item.find("padstack");
  if (!stack) return {};
  for (KicadItem list = stack.first(); list; list = list.next()) {
    if (!list.is("layer")) continue;
    const std::string_view name = list.text(0);
    if (name == layer || (name == "Inner" && layer.starts_with("In"))) return list;
  }
  return {};
}

KicadPad kicad_pad(KicadText& text, KicadItem item, std::string_view layer) {
  const KicadItem own = kicad_layer_of_padstack(item, layer);
  const KicadItem from = own ? own : item;
  const KicadItem own_shape = own ? own.find("shape") : KicadItem();
  const std::string_view shape = own_shape ? own_shape.text(0) : item.text(2);
  KicadPad pad;
  KicadItem size = from.find("size");
  if (!size) size = item.find("size");
  if (!size) {
    text.refuse(item, "kicad.bad-pad", "the pad has no size", "(size ACROSS UP)");
    return pad;
  }
  pad.across = std::max(text.length(size, 0), {});
  pad.up = size.word(1) ? std::max(text.length(size, 1), {}) : pad.across;
  pad.is_round = shape == "circle" || shape == "oval";
  const KicadItem options = from.find("options");
  const bool is_custom = shape == "custom";
  const KicadItem anchor = is_custom && options ? options.find("anchor") : KicadItem();
  const bool is_rectangle = shape == "rect" || (is_custom && !(anchor && anchor.text(0) == "circle"));
  const double across = as_double(pad.across);
  const double up = as_double(pad.up);
  const double least = std::min(across, up);
  if (least <= 0) return pad;
  if (is_rectangle) {
    pad.rings.push_back(rectangle_ring({}, across, up));
  } else if (shape == "circle" || is_custom) {
    pad.rings.push_back(disc_ring({}, across));
  } else if (shape == "oval") {
    pad.rings.push_back(across == up ? disc_ring({}, across) : obround_ring(across, up));
  } else if (shape == "trapezoid") {
    pad.rings.push_back(trapezoid_ring(text, from, pad));
  } else if (shape == "roundrect" || shape == "chamfered_rect") {
    pad.rings.push_back(rounded_rectangle_ring(pad.across, pad.up, share_of(text, from, "roundrect_rratio") * least,
                                               share_of(text, from, "chamfer_ratio") * least, chamfered_corners(from)));
  } else {
    text.refuse(item, "kicad.bad-pad", fmt::format("'{}' is not a pad shape", shape),
                "circle, rect, oval, trapezoid, roundrect or custom");
  }
  if (const KicadItem primitives = is_custom ? from.find("primitives") : KicadItem()) {
    for (KicadItem one = primitives.first(); one; one = one.next()) {
      if (!one.node().is_list || one.is("gr_bbox") || one.is("gr_vector")) continue;
      if (const auto graphic = kicad_graphic(text, one, {}, true)) pad.primitives.push_back(*graphic);
    }
  }
  return pad;
}

KicadDrill kicad_drill(KicadText& text, KicadItem pad) {
  KicadDrill drill;
  const KicadItem list = pad.find("drill");
  if (!list) return drill;
  const std::size_t first = list.text(0) == "oval" ? 1 : 0;
  if (list.word(first)) drill.across = drill.up = std::max(text.length(list, first), {});
  if (list.word(first + 1)) drill.up = std::max(text.length(list, first + 1), {});
  if (drill.up.count == 0) drill.across = {};
  drill.offset = kicad_point(text, list.find("offset"));
  return drill;
}

}  // namespace passo
