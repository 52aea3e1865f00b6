#include "svg_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "curve_chords.hpp"
#include "svg_words.hpp"
#include <fmt/format.h>

namespace passo {

void SvgFigureReader::refuse(const SvgElement& element, std::string code, std::string message, std::string expected) {
  diagnostics_.add({.code = std::move(code),
                    .file = name_,
                    .place = place_of(element),
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = ""});
}

double SvgFigureReader::length(const SvgElement& element, std::string_view attribute, double whole, double otherwise) {
  const std::string_view text = element.property(attribute);
  if (text.empty() || text == "auto") return otherwise;
  const std::optional<double> value = svg_length(text, whole, inch_);
  if (value) return *value;
  refuse(element, "svg.length", fmt::format("'{}' is not a valid length ({})", text.substr(0, 40), attribute),
         "a number, with or without px, mm, cm, in, pt, pc or %");
  return otherwise;
}

void SvgFigureReader::add(DrawnPath path) {
  if (path.points.size() >= 2) figure_->paths.push_back(std::move(path));
}

bool SvgFigureReader::is_shape(std::string_view element) {
  constexpr std::string_view shapes[] = {"path", "rect", "circle", "ellipse", "line", "polyline", "polygon"};
  return std::ranges::find(shapes, element) != std::end(shapes);
}

void SvgFigureReader::read(const SvgElement& element, const SvgSpace& space, SvgFigure& figure) {
  figure_ = &figure;
  const std::string& name = element.name;
  const double diagonal = std::hypot(space.view.width, space.view.height) / std::numbers::sqrt2;
  const auto x = [&](const char* attribute) { return length(element, attribute, space.view.width); };
  const auto y = [&](const char* attribute) { return length(element, attribute, space.view.height); };
  if (name == "path") {
    read_path(element, space);
  } else if (name == "rect") {
    read_rect(element, space);
  } else if (name == "circle") {
    const double radius = length(element, "r", diagonal);
    read_ellipse(element, space, {x("cx"), y("cy")}, radius, radius);
  } else if (name == "ellipse") {
    const double rx = length(element, "rx", space.view.width, -1);
    const double ry = length(element, "ry", space.view.height, rx);
    read_ellipse(element, space, {x("cx"), y("cy")}, rx < 0 ? ry : rx, ry);
  } else if (name == "line") {
    DrawnPath path{.layer = space.layer, .line = element.line};
    if (put(path, element, space, {x("x1"), y("y1")}) && put(path, element, space, {x("x2"), y("y2")})) {
      add(std::move(path));
    }
  } else if (name == "polyline" || name == "polygon") {
    read_points(element, space);
  }
}

bool SvgFigureReader::put(DrawnPath& path, const SvgElement& element, const SvgSpace& space, SvgSpot spot,
                          double bulge) {
  if (!builder_.has_room_for(1, place_of(element), "")) return false;
  const auto at = builder_.point(Mm(space.transform.x(spot.x, spot.y)), Mm(space.transform.y(spot.x, spot.y)),
                                 place_of(element), "");
  if (at) path.points.push_back({*at, bulge});
  return at.has_value();
}

// Continues from the end of the path. A circle that is not stretched remains a circle.
void SvgFigureReader::put_arc(DrawnPath& path, const SvgElement& element, const SvgSpace& space, const SvgArc& arc) {
  const double a = std::hypot(arc.major.x, arc.major.y);
  const double b = std::hypot(arc.minor.x, arc.minor.y);
  const double scale = space.transform.uniform_scale();
  const bool is_circle = std::abs(a - b) <= 1e-9 * (a + b) && scale > 0;
  const double largest = std::max(a, b) * space.transform.largest_scale();
  const double share = std::clamp(tolerance_ / std::max(largest, 1e-9), 1e-9, 0.5);
  const double most = is_circle ? std::numbers::pi * 1.0001 : 2 * std::acos(1 - share);
  const auto parts = static_cast<std::size_t>(std::max(1.0, std::ceil(std::abs(arc.sweep) / most)));
  // With Y up, a positive angle of SVG is clockwise; mirroring reverses it again.
  double bulge = 0;
  if (is_circle)
    bulge = std::tan(arc.sweep / static_cast<double>(parts) / 4) * (space.transform.is_mirrored() ? -1 : 1);
  if (!builder_.has_room_for(parts, place_of(element), "")) return;
  for (std::size_t i = 1; i <= parts; ++i) {
    if (!path.points.empty()) path.points.back().bulge = bulge;
    if (!put(path, element, space, arc.at(arc.start + arc.sweep * static_cast<double>(i) / static_cast<double>(parts))))
      return;
  }
}

void SvgFigureReader::put_curve(DrawnPath& path, const SvgElement& element, const SvgSpace& space, SvgSpot from,
                                const SvgPiece& piece) {
  std::vector<SvgSpot> points = {from};
  points.insert(points.end(), piece.control.begin(), piece.control.end());
  points.push_back(piece.end);
  const auto take = [&](double x, double y) { return put(path, element, space, {x, y}); };
  const double scale = space.transform.largest_scale();
  if (for_chords(std::span<const SvgSpot>(points), scale, tolerance_, take)) return;
  refuse(element, "svg.path", "this curve is too large", "curves of at most a few metres");
}

void SvgFigureReader::read_ellipse(const SvgElement& element, const SvgSpace& space, SvgSpot middle, double rx,
                                   double ry) {
  if (!(rx > 0 && ry > 0)) return;
  const double scale = space.transform.uniform_scale();
  if (rx == ry && scale > 0) {
    const auto at = builder_.point(Mm(space.transform.x(middle.x, middle.y)), Mm(space.transform.y(middle.x, middle.y)),
                                   place_of(element), "");
    const auto diameter = builder_.length(Mm(2 * rx * scale), place_of(element), "");
    if (at && diameter && builder_.has_room_for(1, place_of(element), "")) {
      figure_->holes.push_back({*at, *diameter, space.layer, element.line});
    }
    return;
  }
  DrawnPath path{.is_closed = true, .layer = space.layer, .line = element.line};
  put_arc(path, element, space, {middle, {rx, 0}, {0, ry}, 0, 2 * std::numbers::pi});
  add(std::move(path));
}

void SvgFigureReader::read_rect(const SvgElement& element, const SvgSpace& space) {
  const double x = length(element, "x", space.view.width);
  const double y = length(element, "y", space.view.height);
  const double width = length(element, "width", space.view.width);
  const double height = length(element, "height", space.view.height);
  if (!(width > 0 && height > 0)) return;
  double rx = length(element, "rx", space.view.width, -1);
  double ry = length(element, "ry", space.view.height, -1);
  if (rx < 0) rx = ry;
  if (ry < 0) ry = rx;
  rx = std::clamp(rx, 0.0, width / 2);
  ry = std::clamp(ry, 0.0, height / 2);
  DrawnPath path{.is_closed = true, .layer = space.layer, .line = element.line};
  const bool is_round = rx > 0 && ry > 0;
  // For each corner: the centre of its arc, and the angle at which the arc begins.
  const std::array<SvgSpot, 4> corners = {{{x + width, y}, {x + width, y + height}, {x, y + height}, {x, y}}};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!is_round) {
      put(path, element, space, corners[i]);
      continue;
    }
    const double start = (static_cast<double>(i) - 1) * std::numbers::pi / 2;
    const SvgSpot centre{corners[i].x + (i == 0 || i == 1 ? -rx : rx), corners[i].y + (i == 0 || i == 3 ? ry : -ry)};
    const SvgArc arc{centre, {rx, 0}, {0, ry}, start, std::numbers::pi / 2};
    put(path, element, space, arc.at(start));
    put_arc(path, element, space, arc);
  }
  // The side between two arcs may have no length.
  std::vector<PathPoint> points;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const bool is_again =
        path.points[i].at == path.points[(i + 1) % path.points.size()].at && path.points[i].bulge == 0;
    if (!is_again) points.push_back(path.points[i]);
  }
  path.points = std::move(points);
  add(std::move(path));
}

void SvgFigureReader::read_points(const SvgElement& element, const SvgSpace& space) {
  DrawnPath path{.is_closed = element.name == "polygon", .layer = space.layer, .line = element.line};
  SvgWords words(element.attribute("points"));
  while (!words.at_end()) {
    const std::optional<double> x = words.number();
    const std::optional<double> y = x ? words.number() : std::nullopt;
    if (!y) {
      refuse(element, "svg.path", "these points are not pairs of numbers", "x,y x,y ...");
      return;
    }
    if (!put(path, element, space, {*x, *y})) return;
  }
  add(std::move(path));
}

void SvgFigureReader::read_path(const SvgElement& element, const SvgSpace& space) {
  const std::string_view data = element.attribute("d");
  std::vector<SvgSubpath> subpaths;
  if (const auto flaw = read_svg_path(data, most_drawn, subpaths)) {
    const std::size_t from = flaw->place < 20 ? 0 : flaw->place - 20;
    refuse(element, "svg.path",
           fmt::format("the path data is wrong at character {}: '{}'", flaw->place + 1, data.substr(from, 40)),
           flaw->expected);
    return;
  }
  for (const SvgSubpath& subpath : subpaths) read_subpath(element, space, subpath);
}

void SvgFigureReader::read_subpath(const SvgElement& element, const SvgSpace& space, const SvgSubpath& subpath) {
  DrawnPath path{.is_closed = subpath.is_closed, .layer = space.layer, .line = element.line};
  if (!put(path, element, space, subpath.start)) return;
  SvgSpot at = subpath.start;
  for (const SvgPiece& piece : subpath.pieces) {
    if (piece.arc) {
      put_arc(path, element, space, *piece.arc);
    } else if (!piece.control.empty()) {
      put_curve(path, element, space, at, piece);
    } else {
      put(path, element, space, piece.end);
    }
    at = piece.end;
  }
  if (path.is_closed && path.points.size() > 2 && path.points.back().at == path.points.front().at)
    path.points.pop_back();
  add(std::move(path));
}

}  // namespace passo
