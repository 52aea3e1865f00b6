// What the commands of a plot draw: lines, arcs, polygons, packed lines.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "curve_chords.hpp"
#include "hpgl_plotter.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

constexpr double hpgl_degree = std::numbers::pi / 180;

}  // namespace

HpglSpot HpglPlotter::target(double x, double y, bool is_relative) const {
  if (!is_relative) return user(x, y);
  const HpglSpot way = user_way(x, y);
  return {pen_.at().x + way.x, pen_.at().y + way.y};
}

void HpglPlotter::go(HpglSpot to) {
  if (is_polygon_) {
    polygon_.back().push_back(to);
    if (polygon_.back().size() > most_drawn) is_polygon_ = false;
    pen_.move_to(to);
  } else if (is_down_) {
    pen_.line_to(to);
  } else {
    pen_.raise();
    pen_.move_to(to);
  }
  labels_.line_start = to;
}

void HpglPlotter::go_along(const Numbers& n) {
  // Without places the pen stays: a following place begins a line there.
  if (n.empty() && !is_down_) pen_.end_path();
  for (std::size_t i = 0; i + 1 < n.size() && !pen_.is_full(); i += 2) go(target(n[i], n[i + 1], is_relative_));
  if (n.size() % 2 != 0) {
    refuse(words_.place() - 1, "hpgl.numbers", "these positions have " + counted(n.size(), "number"),
           "X and Y for each point");
  }
}

void HpglPlotter::arc_about(HpglSpot centre, double sweep_degrees) {
  const double sweep = std::clamp(sweep_degrees, -360.0, 360.0) * hpgl_degree;
  const double sx = user_.xx;
  const double sy = user_.yy;
  const bool is_even = std::abs(std::abs(sx) - std::abs(sy)) <= 1e-9 * std::abs(sx);
  if (is_even && is_down_ && !is_polygon_) {
    pen_.arc(centre, sx * sy < 0 ? -sweep : sweep);
    labels_.line_start = pen_.at();
    return;
  }
  // Chords: the scaling makes an ellipse of the arc.
  const double ax = (pen_.at().x - centre.x) / sx;
  const double ay = (pen_.at().y - centre.y) / sy;
  const double largest = std::hypot(ax, ay) * std::max(std::abs(sx), std::abs(sy));
  const double step = 2 * std::acos(1 - std::clamp(pen_.tolerance() / std::max(largest, 1e-9), 1e-6, 0.5));
  const double parts = std::max(1.0, std::ceil(std::abs(sweep) / step));
  for (double i = is_down_ || is_polygon_ ? 1 : parts; i <= parts && !pen_.is_full(); ++i) {
    const double c = std::cos(sweep * i / parts);
    const double s = std::sin(sweep * i / parts);
    go({centre.x + (ax * c - ay * s) * sx, centre.y + (ax * s + ay * c) * sy});
  }
}

// The arc that begins at the pen and goes through two more places.
void HpglPlotter::arc_through(HpglSpot second, HpglSpot third) {
  const HpglSpot first = pen_.at();
  const double ax = second.x - first.x;
  const double ay = second.y - first.y;
  const double bx = third.x - first.x;
  const double by = third.y - first.y;
  const double twice = 2 * (ax * by - ay * bx);
  if (std::abs(twice) <= 1e-9 * (std::hypot(ax, ay) * std::hypot(bx, by) + 1e-9)) {
    go(second);
    go(third);
    return;
  }
  const double a = ax * ax + ay * ay;
  const double b = bx * bx + by * by;
  const HpglSpot centre{first.x + (by * a - ay * b) / twice, first.y + (ax * b - bx * a) / twice};
  double sweep =
      std::atan2(third.y - centre.y, third.x - centre.x) - std::atan2(first.y - centre.y, first.x - centre.x);
  if (twice > 0 && sweep < 0) sweep += 2 * std::numbers::pi;
  if (twice < 0 && sweep > 0) sweep -= 2 * std::numbers::pi;
  if (is_down_ && !is_polygon_) {
    pen_.arc(centre, sweep);
  } else {
    go(third);
  }
}

void HpglPlotter::circle(const Numbers& n) {
  const HpglSpot centre = pen_.at();
  const bool is_even = std::abs(std::abs(user_.xx) - std::abs(user_.yy)) <= 1e-9 * std::abs(user_.xx);
  if (is_even && !is_polygon_) {
    pen_.circle(n[0] * user_.xx);
    return;
  }
  const bool was_down = is_down_;
  if (!is_polygon_) pen_.move_to({centre.x + n[0] * user_.xx, centre.y});
  is_down_ = true;
  if (is_polygon_) go({centre.x + n[0] * user_.xx, centre.y});
  arc_about(centre, 360);
  is_down_ = was_down;
  if (!is_polygon_) pen_.move_to(centre);
}

// Along the corners and back to the first; the pen returns to where it was.
void HpglPlotter::polygon(const std::vector<HpglSpot>& corners) {
  if (corners.size() < 2) return;
  const HpglSpot start = pen_.at();
  pen_.move_to(corners.front());
  for (std::size_t i = 1; i <= corners.size(); ++i) pen_.line_to(corners[i % corners.size()]);
  pen_.move_to(start);
}

void HpglPlotter::rectangle(HpglSpot to) {
  const HpglSpot from = pen_.at();
  polygon({from, {to.x, from.y}, to, {from.x, to.y}});
}

void HpglPlotter::wedge(const Numbers& n) {
  const HpglSpot centre = pen_.at();
  const bool was_down = is_down_;
  const HpglSpot way = user_way(n[0] * std::cos(n[1] * hpgl_degree), n[0] * std::sin(n[1] * hpgl_degree));
  const HpglSpot start{centre.x + way.x, centre.y + way.y};
  const bool is_whole = std::abs(n[2]) >= 360;
  is_down_ = true;
  if (is_whole) {
    pen_.move_to(start);
  } else {
    pen_.move_to(centre);
    pen_.line_to(start);
  }
  arc_about(centre, n[2]);
  if (!is_whole) pen_.line_to(centre);
  pen_.move_to(centre);
  is_down_ = was_down;
}

void HpglPlotter::bezier(const Numbers& n, bool is_relative) {
  for (std::size_t i = 0; i + 5 < n.size() && !pen_.is_full(); i += 6) {
    const std::array<HpglSpot, 4> curve = {pen_.at(), target(n[i], n[i + 1], is_relative),
                                           target(n[i + 2], n[i + 3], is_relative),
                                           target(n[i + 4], n[i + 5], is_relative)};
    const auto take = [&](double x, double y) {
      go({x, y});
      return !pen_.is_full();
    };
    if (!is_down_ && !is_polygon_) {
      go(curve[3]);
    } else if (!for_chords(std::span<const HpglSpot>(curve), 1, pen_.tolerance(), take)) {
      refuse(words_.place(), "hpgl.numbers", "this curve is too large", "curves of at most a few metres");
    }
  }
}

void HpglPlotter::polygon_mode(const Numbers& n) {
  const int mode = n.empty() ? 0 : static_cast<int>(n[0]);
  if (mode == 0) {
    pen_.end_path();
    polygon_ = {{pen_.at()}};
    is_polygon_ = true;
  } else if (is_polygon_ && mode == 1) {
    polygon_.emplace_back();
  } else {
    is_polygon_ = false;
  }
}

void HpglPlotter::draw_polygon(const Numbers& /*n*/) {
  for (const std::vector<HpglSpot>& corners : polygon_) polygon(corners);
}

void HpglPlotter::tick_on_x(const Numbers& /*n*/) {
  const HpglSpot at = pen_.at();
  const double high = corners_[3] - corners_[1];
  pen_.move_to({at.x, at.y - ticks_[1] * high});
  pen_.line_to({at.x, at.y + ticks_[0] * high});
  pen_.move_to(at);
}

void HpglPlotter::tick_on_y(const Numbers& /*n*/) {
  const HpglSpot at = pen_.at();
  const double wide = corners_[2] - corners_[0];
  pen_.move_to({at.x - ticks_[1] * wide, at.y});
  pen_.line_to({at.x + ticks_[0] * wide, at.y});
  pen_.move_to(at);
}

// A number of a packed line: the lowest digit first. The last one is marked; the lowest bit is the sign.
std::optional<double> HpglPlotter::packed_number(bool is_base_32, double unit) {
  const int base = is_base_32 ? 32 : 64;
  double value = 0;
  double weight = 1;
  for (int digits = 0; digits < 20;) {
    const std::optional<char> next = words_.character();
    if (!next) return std::nullopt;
    const int code = is_base_32 ? static_cast<unsigned char>(*next) & 0x7F : static_cast<unsigned char>(*next);
    if (code <= ' ') continue;
    const int last_from = is_base_32 ? 95 : 191;
    const bool is_last = code >= last_from && code < last_from + base;
    if (!is_last && (code < 63 || code >= 63 + base)) return std::nullopt;
    value += weight * (is_last ? code - last_from : code - 63);
    weight *= base;
    ++digits;
    if (!is_last) continue;
    const bool is_below = std::fmod(value, 2) != 0;
    const double size = std::floor(value / 2) * unit;
    return size <= 1e9 ? std::optional(is_below ? -size : size) : std::nullopt;
  }
  return std::nullopt;
}

void HpglPlotter::packed_line() {
  bool is_base_32 = false;
  bool is_up = false;
  bool is_absolute = false;
  double unit = 1;
  const auto wrong = [&] {
    refuse(words_.place() - 1, "hpgl.packed", "this is not a number of an encoded polyline (PE)",
           "base 64 or base 32 digits");
  };
  while (const std::optional<char> next = words_.character()) {
    if (pen_.is_full()) return;
    if (*next == '7') {
      is_base_32 = true;
    } else if (*next == '<') {
      is_up = true;
    } else if (*next == '=') {
      is_absolute = true;
    } else if (*next == ':' || *next == '>') {
      const std::optional<double> value = packed_number(is_base_32, 1);
      if (!value) return wrong();
      if (*next == ':') {
        pen_.select_pen(static_cast<std::uint32_t>(std::clamp(*value, 0.0, 255.0)));
      } else {
        unit = std::pow(2.0, -std::clamp(*value, -26.0, 26.0));
      }
    } else if (static_cast<unsigned char>(*next) > ' ') {
      words_.back();
      const std::optional<double> x = packed_number(is_base_32, unit);
      const std::optional<double> y = x ? packed_number(is_base_32, unit) : std::nullopt;
      if (!y) return wrong();
      is_down_ = !is_up;
      go(target(*x, *y, !is_absolute));
      is_up = false;
      is_absolute = false;
    }
  }
  if (words_.at_end()) return;
  words_.skip_to_end_of_command();
}

}  // namespace passo
