// DrawnSolid: what a part of examples/jobs should be, from the shapes of its drawing: an oracle for the stock that a
// job leaves. It shares no code with the readers, the planners or the simulation.
//
// It knows the SVG shapes rect, circle, polygon, line and path (M, L, H, V, C, Q and Z with absolute positions, h and
// a) and the DXF entities CIRCLE and LWPOLYLINE, in layers. It tells for a position how high the part is, and how far
// the walls are. Lengths are mm, Y points up.
#pragma once

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace passo::test {

struct FlatPoint {
  double x = 0;
  double y = 0;
};
using FlatRing = std::vector<FlatPoint>;

// The shapes of a layer. Open ones have no inside.
class DrawnShapes {
 public:
  void add_line(FlatPoint a, FlatPoint b) {
    outlines_.push_back({.ring = {a, b},
                         .low = {std::min(a.x, b.x), std::min(a.y, b.y)},
                         .high = {std::max(a.x, b.x), std::max(a.y, b.y)}});
  }
  FlatPoint low() const {
    FlatPoint low{1e9, 1e9};
    for (const Outline& one : outlines_) low = {std::min(low.x, one.low.x), std::min(low.y, one.low.y)};
    return low;
  }
  void add(FlatRing ring) {
    // An edge without a length has no direction.
    const auto is_same = [](FlatPoint a, FlatPoint b) { return std::hypot(a.x - b.x, a.y - b.y) < 1e-9; };
    ring.erase(std::unique(ring.begin(), ring.end(), is_same), ring.end());
    while (ring.size() > 1 && is_same(ring.front(), ring.back())) ring.pop_back();
    Outline outline{.ring = std::move(ring)};
    const std::size_t n = outline.ring.size();
    constexpr double least_turn = 15 * std::numbers::pi / 180;
    for (std::size_t i = 0; i < n; ++i) {
      const FlatPoint a = outline.ring[(i + n - 1) % n];
      const FlatPoint b = outline.ring[i];
      const FlatPoint c = outline.ring[(i + 1) % n];
      outline.low = {std::min(outline.low.x, b.x), std::min(outline.low.y, b.y)};
      outline.high = {std::max(outline.high.x, b.x), std::max(outline.high.y, b.y)};
      const double turn =
          std::remainder(std::atan2(c.y - b.y, c.x - b.x) - std::atan2(b.y - a.y, b.x - a.x), 2 * std::numbers::pi);
      if (std::abs(turn) > least_turn) corners_.push_back({b, std::tan(std::min(std::abs(turn), 3.1) / 2)});
    }
    outlines_.push_back(std::move(outline));
  }

  bool contains(FlatPoint at) const {
    bool inside = false;
    for (const Outline& outline : outlines_) {
      if (outline.beside(at) > 0) continue;
      outline.each_edge([&](FlatPoint a, FlatPoint b) {
        if ((a.y > at.y) == (b.y > at.y)) return;
        if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
      });
    }
    return inside;
  }
  // To the nearest edge; `most` if it is farther.
  double distance(FlatPoint at, double most) const {
    double best = most * most;
    for (const Outline& outline : outlines_) {
      const double beside = outline.beside(at);
      if (beside * beside >= best) continue;
      outline.each_edge([&](FlatPoint a, FlatPoint b) {
        const double dx = b.x - a.x;
        const double dy = b.y - a.y;
        const double square = dx * dx + dy * dy;
        const double t = square > 0 ? std::clamp(((at.x - a.x) * dx + (at.y - a.y) * dy) / square, 0.0, 1.0) : 0;
        const double x = at.x - a.x - t * dx;
        const double y = at.y - a.y - t * dy;
        best = std::min(best, x * x + y * y);
      });
    }
    return std::sqrt(best);
  }
  // Whether a cutter cannot reach the place, because it does not fit into a corner: where the direction turns by more
  // than 15 degrees.
  bool is_in_corner(FlatPoint at, double radius) const {
    return std::ranges::any_of(corners_, [&](const Corner& corner) {
      return std::hypot(at.x - corner.at.x, at.y - corner.at.y) < radius * corner.reach + 0.01;
    });
  }

 private:
  struct Outline {
    FlatRing ring;
    FlatPoint low{1e9, 1e9};
    FlatPoint high{-1e9, -1e9};

    // The distance from the bounding box.
    double beside(FlatPoint at) const {
      return std::hypot(std::max({low.x - at.x, 0.0, at.x - high.x}), std::max({low.y - at.y, 0.0, at.y - high.y}));
    }
    template <class Do>
    void each_edge(Do&& act) const {
      for (std::size_t i = 0; i < ring.size(); ++i) act(ring[i], ring[(i + 1) % ring.size()]);
    }
  };

  std::vector<Outline> outlines_;
  struct Corner {
    FlatPoint at;
    double reach = 0;  // from the corner to where a cutter of radius 1 touches its sides
  };

  std::vector<Corner> corners_;
};

// From `ring.back()` to `to`, as a DXF polyline goes: the bulge is the tangent of a quarter of the angle.
inline void add_bulge(FlatRing& ring, FlatPoint to, double bulge) {
  const FlatPoint from = ring.back();
  const double angle = 4 * std::atan(bulge);
  const int pieces = std::max(1, static_cast<int>(std::abs(angle) * 180 / std::numbers::pi));
  if (std::abs(bulge) > 1e-9) {
    const double half = std::tan(angle / 2);
    const FlatPoint centre{(from.x + to.x) / 2 - (to.y - from.y) / 2 / half,
                           (from.y + to.y) / 2 + (to.x - from.x) / 2 / half};
    for (int i = 1; i < pieces; ++i) {
      const double turn = angle * i / pieces;
      const double x = from.x - centre.x;
      const double y = from.y - centre.y;
      ring.push_back(
          {centre.x + x * std::cos(turn) - y * std::sin(turn), centre.y + x * std::sin(turn) + y * std::cos(turn)});
    }
  }
  ring.push_back(to);
}

// From `ring.back()`: a cubic Bézier curve.
inline void add_cubic(FlatRing& ring, FlatPoint b, FlatPoint c, FlatPoint e) {
  const FlatPoint a = ring.back();
  constexpr int pieces = 60;
  for (int i = 1; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const double s = 1 - t;
    const auto mix = [&](double p, double q, double r, double u) {
      return s * s * s * p + 3 * s * s * t * q + 3 * s * t * t * r + t * t * t * u;
    };
    ring.push_back({mix(a.x, b.x, c.x, e.x), mix(a.y, b.y, c.y, e.y)});
  }
}
// A quadratic one.
inline void add_quadratic(FlatRing& ring, FlatPoint control, FlatPoint e) {
  const FlatPoint a = ring.back();
  const auto mix = [](FlatPoint end, FlatPoint middle) {
    return FlatPoint{(end.x + 2 * middle.x) / 3, (end.y + 2 * middle.y) / 3};
  };
  add_cubic(ring, mix(a, control), mix(e, control), e);
}

// "M 1,2 L3,4 C 5,6 7,8 9,10 Z", with Y downwards from `height`.
inline FlatRing ring_of_path(const std::string& d, double height) {
  FlatRing ring;
  char command = 'M';
  const char* text = d.c_str();
  const auto point = [&] {
    FlatPoint at;
    int used = 0;
    if (std::sscanf(text, " %lf%*[, ]%lf%n", &at.x, &at.y, &used) != 2) throw std::runtime_error("unknown path: " + d);
    text += used;
    return FlatPoint{at.x, height - at.y};
  };
  const auto number = [&] {
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (end == text) throw std::runtime_error("unknown path: " + d);
    text = end;
    return value;
  };
  while (*text != 0) {
    if (std::isspace(static_cast<unsigned char>(*text)) != 0) {
      ++text;
    } else if (std::isalpha(static_cast<unsigned char>(*text)) != 0) {
      command = *text++;
    } else if (command == 'h') {
      ring.push_back({ring.back().x + number(), ring.back().y});
    } else if (command == 'H') {
      ring.push_back({number(), ring.back().y});
    } else if (command == 'V') {
      ring.push_back({ring.back().x, height - number()});
    } else if (command == 'a') {
      const FlatPoint radii = point();
      number();  // a circle has no rotation
      const bool is_large = number() != 0;
      const bool turns_clockwise = number() != 0;
      const FlatPoint way = point();
      const FlatPoint to{ring.back().x + way.x, ring.back().y + way.y - height};
      const double share = std::hypot(way.x, way.y - height) / 2 / radii.x;
      const double angle = 2 * std::asin(std::min(share, 1.0));
      const double bulge = std::tan((is_large ? 2 * std::numbers::pi - angle : angle) / 4);
      add_bulge(ring, to, turns_clockwise ? -bulge : bulge);
    } else if (command == 'C') {
      const FlatPoint b = point();
      const FlatPoint c = point();
      add_cubic(ring, b, c, point());
    } else if (command == 'Q') {
      const FlatPoint control = point();
      add_quadratic(ring, control, point());
    } else {
      ring.push_back(point());
    }
  }
  if (ring.size() > 1 && std::hypot(ring.back().x - ring.front().x, ring.back().y - ring.front().y) < 1e-6)
    ring.pop_back();
  return ring;
}

// The layers of a DXF drawing in mm.
inline std::map<std::string, DrawnShapes> read_dxf_shapes(const std::string& dxf) {
  std::map<std::string, DrawnShapes> layers;
  std::istringstream lines(dxf);
  std::string code;
  std::string value;
  std::string kind;
  std::string layer;
  std::vector<std::pair<FlatPoint, double>> corners;  // with their bulges
  double radius = 0;
  const auto finish = [&] {
    FlatRing ring;
    if (kind == "CIRCLE" && !corners.empty()) {
      const FlatPoint middle = corners.front().first;
      for (int i = 0; i < 360; ++i) {
        const double angle = i * std::numbers::pi / 180;
        ring.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
      }
    } else if (kind == "LWPOLYLINE" && !corners.empty()) {
      ring.push_back(corners.front().first);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        add_bulge(ring, corners[(i + 1) % corners.size()].first, corners[i].second);
      }
      ring.pop_back();
    }
    if (!ring.empty()) layers[layer].add(std::move(ring));
    corners.clear();
  };
  while (std::getline(lines, code) && std::getline(lines, value)) {
    const int group = std::atoi(code.c_str());
    const double number = std::atof(value.c_str());
    if (group == 0) {
      finish();
      kind = value;
    }
    if (group == 8) layer = value;
    if (group == 10) corners.push_back({{number, 0}, 0});
    if (group == 20 && !corners.empty()) corners.back().first.y = number;
    if (group == 42 && !corners.empty()) corners.back().second = number;
    if (group == 40) radius = number;
  }
  return layers;
}

// The layers of an SVG drawing whose units are mm.
inline std::map<std::string, DrawnShapes> read_shapes(const std::string& svg) {
  const auto attribute = [](std::string_view element, const std::string& name) -> std::string {
    const std::size_t at = element.find(" " + name + "=\"");
    if (at == std::string_view::npos) return "";
    const std::size_t begin = at + name.size() + 3;
    return std::string(element.substr(begin, element.find('"', begin) - begin));
  };
  const auto number = [&](std::string_view element, const char* name) {
    return std::atof(attribute(element, name).c_str());
  };
  std::map<std::string, DrawnShapes> layers;
  std::string layer;
  double height = 0;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::string_view element = std::string_view(svg).substr(at, svg.find('>', at) - at);
    FlatRing ring;
    const auto arc = [&](double x, double y, double r, double from, double to) {
      const int pieces = std::max(2, static_cast<int>(std::abs(to - from)));  // one per degree
      for (int i = 0; i <= pieces; ++i) {
        const double angle = (from + (to - from) * i / pieces) * std::numbers::pi / 180;
        ring.push_back({x + r * std::cos(angle), y + r * std::sin(angle)});
      }
    };
    if (element.starts_with("<svg")) {
      height = number(element, "height");
    } else if (element.starts_with("<g")) {
      layer = attribute(element, "inkscape:label");
    } else if (element.starts_with("<circle")) {
      arc(number(element, "cx"), height - number(element, "cy"), number(element, "r"), 0, 360);
      ring.pop_back();
    } else if (element.starts_with("<rect")) {
      const double r = number(element, "rx");
      const double left = number(element, "x");
      const double right = left + number(element, "width");
      const double top = height - number(element, "y");
      const double bottom = top - number(element, "height");
      if (r > 0) {
        arc(left + r, bottom + r, r, 180, 270);
        arc(right - r, bottom + r, r, 270, 360);
        arc(right - r, top - r, r, 0, 90);
        arc(left + r, top - r, r, 90, 180);
      } else {
        ring = {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
      }
    } else if (element.starts_with("<line")) {
      layers[layer].add_line({number(element, "x1"), height - number(element, "y1")},
                             {number(element, "x2"), height - number(element, "y2")});
    } else if (element.starts_with("<path")) {
      ring = ring_of_path(attribute(element, "d"), height);
    } else if (element.starts_with("<polygon")) {
      const std::string points = attribute(element, "points");
      const char* text = points.c_str();
      double x = 0;
      double y = 0;
      int used = 0;
      while (std::sscanf(text, "%lf,%lf%n", &x, &y, &used) == 2) {
        ring.push_back({x, height - y});
        text += used;
      }
    }
    if (!ring.empty()) layers[layer].add(std::move(ring));
  }
  return layers;
}

// A cut of the part, as it is meant.
struct DrawnCut {
  // pocket: the inside of the shapes down to `z`. around, within: a groove as wide as the cutter, outside or inside of
  // the shapes, through the stock except at tabs. outer_chamfer, inner_chamfer: of 45 degrees, as wide as `z`, on the
  // edges of the shapes, whose inside is the part, or a hole. around_with_bones: around, with dog-bones in the corners.
  // face: everything down to `z`. v_groove: along the edges, by a V-bit whose tip is at `z`. v_carved: the inside of
  // the shapes, by a V-bit that touches their edges. relief: between `surface` and `left` in a box; around it the
  // cutter reaches over by its radius.
  enum class Kind : std::uint8_t {
    pocket,
    around,
    within,
    outer_chamfer,
    inner_chamfer,
    around_with_bones,
    face,
    v_groove,
    v_carved,
    relief
  };
  Kind kind = Kind::pocket;
  std::string layer = {};
  double z = 0;
  double cutter = 0;    // diameter of the last cutter
  double angle = 60;    // v_groove, v_carved: degrees
  double tip = 0;       // v_groove: diameter of the tip
  FlatPoint low = {};   // relief
  FlatPoint high = {};  // relief
  std::function<double(FlatPoint)> surface = {};
  std::function<double(FlatPoint)> left = {};
};

class DrawnSolid {
 public:
  DrawnSolid(std::map<std::string, DrawnShapes> layers, std::vector<DrawnCut> cuts, double thickness, double tolerance)
      : layers_(std::move(layers)), cuts_(std::move(cuts)), thickness_(thickness), tolerance_(tolerance) {}

  struct Heights {
    double least = 0;          // what is lower was cut into
    double most = 0;           // what is higher was left
    double wall = 1e9;         // distance to the nearest wall
    bool may_be_left = false;  // near a corner that is too narrow for the cutter
  };
  Heights at(FlatPoint at) const;
  // Within the outline that is cut out.
  bool is_part(FlatPoint at) const {
    return std::ranges::any_of(cuts_, [&](const DrawnCut& cut) {
      return cut.kind == DrawnCut::Kind::around && layers_.at(cut.layer).contains(at);
    });
  }

 private:
  // Cuts without an inside. False: it is another one.
  bool at_line(const DrawnCut& cut, FlatPoint at, Heights& heights) const;

  std::map<std::string, DrawnShapes> layers_;
  std::vector<DrawnCut> cuts_;
  double thickness_;
  double tolerance_;
};

inline bool DrawnSolid::at_line(const DrawnCut& cut, FlatPoint at, Heights& heights) const {
  using enum DrawnCut::Kind;
  if (cut.kind == face) {
    heights.least = std::min(heights.least, cut.z);
    heights.most = std::min(heights.most, cut.z);
  } else if (cut.kind == relief) {
    const FlatPoint inside{std::clamp(at.x, cut.low.x, cut.high.x), std::clamp(at.y, cut.low.y, cut.high.y)};
    const double beside = std::hypot(at.x - inside.x, at.y - inside.y);
    if (beside > cut.cutter / 2) return true;
    if (beside == 0) heights.most = std::min(heights.most, cut.left(inside));
    heights.least = std::min(heights.least, cut.surface(inside));
  } else if (cut.kind == v_carved) {
    const DrawnShapes& shapes = layers_.at(cut.layer);
    if (!shapes.contains(at)) return true;
    const double steepness = 1 / std::tan(cut.angle * std::numbers::pi / 360);
    const double bottom = -steepness * shapes.distance(at, 10);
    heights.least = std::min(heights.least, bottom - steepness * tolerance_);
    heights.most = std::min(heights.most, bottom + steepness * tolerance_);
  } else if (cut.kind == v_groove) {
    const double steepness = 1 / std::tan(cut.angle * std::numbers::pi / 360);
    const double wall = layers_.at(cut.layer).distance(at, 10);
    const double bottom = cut.z + std::max(0.0, wall - cut.tip / 2) * steepness;
    if (bottom >= 0) return true;
    heights.least = std::min(heights.least, bottom - steepness * tolerance_);
    heights.most = std::min(heights.most, bottom + steepness * tolerance_);
  } else {
    return false;
  }
  return true;
}

inline DrawnSolid::Heights DrawnSolid::at(FlatPoint at) const {
  using enum DrawnCut::Kind;
  Heights heights;
  bool is_free = false;  // beside the part, where tabs and scrap are
  for (const DrawnCut& cut : cuts_) {
    if (at_line(cut, at, heights)) continue;
    const DrawnShapes& shapes = layers_.at(cut.layer);
    const bool inside = shapes.contains(at);
    const double wall = shapes.distance(at, std::max(cut.cutter, 2.0) + 1);
    heights.wall = std::min(heights.wall, wall);
    const bool is_round = cut.kind == outer_chamfer || cut.kind == inner_chamfer;
    if (is_round) {
      const bool is_part = inside == (cut.kind == outer_chamfer);
      // The flank goes on below the chamfer, beside the edge.
      if (!is_part) is_free = is_free || wall < 1;
      if (is_part && wall < cut.z) {
        heights.least = std::min(heights.least, wall - cut.z);
        heights.most = std::min(heights.most, wall - cut.z);
      }
      continue;
    }
    const bool has_bones = cut.kind == around_with_bones;
    // A bone of radius 1 reaches 1.42 from the corner along both walls.
    if (has_bones && shapes.is_in_corner(at, 1.45 * cut.cutter / 2)) heights.least = -1e9;
    const bool is_groove = cut.kind == around || cut.kind == within || has_bones;
    if (is_groove) {
      if (inside != (cut.kind == within)) continue;
      is_free = true;
      if (wall < cut.cutter - tolerance_) heights.most = std::min(heights.most, cut.z);
    } else if (inside) {
      heights.least = std::min(heights.least, cut.z);
      heights.most = std::min(heights.most, cut.z);
    }
    if (shapes.is_in_corner(at, cut.cutter / 2)) heights.may_be_left = true;
  }
  if (is_free) heights.least = -1e9;
  if (heights.least <= -thickness_) heights.least = -1e9;
  return heights;
}

}  // namespace passo::test
