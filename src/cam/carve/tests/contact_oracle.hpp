// An independent oracle for bodies: how deep a cutter is in a triangle, by exact contact with its face, its edges and
// its corners. It knows the cutter's shape only as a function of the distance, and searches for the deepest place.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "carved_moves.hpp"

#include "passo/geometry/surface.hpp"

namespace passo::test {

class ContactOracle {
 public:
  // `faces` in program coordinates.
  explicit ContactOracle(std::vector<SurfaceTriangle> faces) : faces_(std::move(faces)) {
    for (const SurfaceTriangle& face : faces_) {
      boxes_.push_back(box_of(face));
      const Box& box = boxes_.back();
      low_ = {std::min(low_[0], box.low[0]), std::min(low_[1], box.low[1])};
      high_ = {std::max(high_[0], box.high[0]), std::max(high_[1], box.high[1])};
    }
    cells_.resize(side * side);
    tops_.assign(side * side, -1e9);
    seen_.assign(faces_.size(), 0);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const Box& box = boxes_[i];
      each_cell(box.low[0], box.high[0], box.low[1], box.high[1], [&](std::size_t cell) {
        cells_[cell].push_back(i);
        tops_[cell] = std::max(tops_[cell], box.top);
      });
    }
  }

  // How deep the body stands in the cutter, at least 0.
  double depth(const OracleCutter& cutter, double x, double y, double z) {
    double highest = z;
    ++time_;
    const double r = cutter.radius;
    each_cell(x - r, x + r, y - r, y + r, [&](std::size_t cell) {
      if (tops_[cell] <= highest) return;
      for (const std::size_t i : cells_[cell]) {
        if (seen_[i] == time_) continue;
        seen_[i] = time_;
        lift(i, cutter, x, y, highest);
      }
    });
    return highest - z;
  }

 private:
  static constexpr std::size_t side = 40;
  struct Box {
    std::array<double, 2> low;
    std::array<double, 2> high;
    double top;
  };
  static Box box_of(const SurfaceTriangle& t) {
    const auto x = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto y = std::minmax({t[0].y, t[1].y, t[2].y});
    return {{x.first, y.first}, {x.second, y.second}, std::max({t[0].z, t[1].z, t[2].z})};
  }
  template <class Act>
  void each_cell(double x0, double x1, double y0, double y1, const Act& act) const {
    const auto cell = [&](double at, std::size_t axis) {
      const double size = std::max(1e-9, high_[axis] - low_[axis]) / side;
      return static_cast<std::size_t>(std::clamp((at - low_[axis]) / size, 0.0, side - 1.0));
    };
    for (std::size_t j = cell(y0, 1); j <= cell(y1, 1); ++j) {
      for (std::size_t i = cell(x0, 0); i <= cell(x1, 0); ++i) act(j * side + i);
    }
  }

  template <class F>
  static double largest(const F& f, double a, double b) {
    for (int i = 0; i < 36; ++i) {
      const double third = (b - a) / 3;
      const bool is_right = f(a + third) < f(b - third);
      a += is_right ? third : 0;
      b -= is_right ? 0 : third;
    }
    return std::max(f(a), f(b));
  }

  // Raises `highest` to the tip's height at which the cutter just touches.
  void lift(std::size_t face, const OracleCutter& cutter, double x, double y, double& highest) const {
    const SurfaceTriangle& t = faces_[face];
    const Box& box = boxes_[face];
    const double near =
        std::hypot(std::max({box.low[0] - x, x - box.high[0], 0.0}), std::max({box.low[1] - y, y - box.high[1], 0.0}));
    if (near > cutter.radius || box.top - cutter.height(near) <= highest) return;
    for (std::size_t i = 0; i < 3; ++i) lift_by_edge(t[i], t[(i + 1) % 3], cutter, x, y, highest);
    lift_by_face(t, cutter, x, y, highest);
  }

  static void lift_by_edge(const SurfacePoint& a, const SurfacePoint& b, const OracleCutter& cutter, double x, double y,
                           double& highest) {
    const double r = cutter.radius;
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double square = dx * dx + dy * dy;
    double first = 0;
    double last = 1;
    if (square > 0) {
      const double middle = ((x - a.x) * dx + (y - a.y) * dy) / square;
      const double out = std::hypot(a.x + middle * dx - x, a.y + middle * dy - y);
      if (out > r) return;
      const double half = std::sqrt((r * r - out * out) / square);
      first = std::max(0.0, middle - half);
      last = std::min(1.0, middle + half);
      if (first > last) return;
    } else if (std::hypot(a.x - x, a.y - y) > r) {
      return;
    }
    const auto tip = [&](double s) {
      const double away = std::min(r, std::hypot(a.x + dx * s - x, a.y + dy * s - y));
      return a.z + (b.z - a.z) * s - cutter.height(away);
    };
    highest = std::max(highest, largest(tip, first, last));
  }

  // Where a plane touches: uphill of the axis, as far out as the shape is as steep.
  static void lift_by_face(const SurfaceTriangle& t, const OracleCutter& cutter, double x, double y, double& highest) {
    const double ax = t[1].x - t[0].x;
    const double ay = t[1].y - t[0].y;
    const double bx = t[2].x - t[0].x;
    const double by = t[2].y - t[0].y;
    const double area = ax * by - bx * ay;
    if (std::abs(area) < 1e-12) return;
    const double gx = ((t[1].z - t[0].z) * by - (t[2].z - t[0].z) * ay) / area;
    const double gy = ((t[2].z - t[0].z) * ax - (t[1].z - t[0].z) * bx) / area;
    const double slope = std::hypot(gx, gy);
    double low = 0;
    double high = cutter.radius;
    for (int i = 0; i < 36; ++i) {
      const double third = (high - low) / 3;
      const auto rise = [&](double away) { return slope * away - cutter.height(away); };
      const bool is_outer = rise(low + third) < rise(high - third);
      low += is_outer ? third : 0;
      high -= is_outer ? 0 : third;
    }
    for (const double away : {0.0, (low + high) / 2, cutter.radius}) {
      const double px = x + (slope > 0 ? gx / slope * away : 0) - t[0].x;
      const double py = y + (slope > 0 ? gy / slope * away : 0) - t[0].y;
      const double u = (px * by - bx * py) / area;
      const double v = (ax * py - px * ay) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      highest = std::max(highest, t[0].z + gx * px + gy * py - cutter.height(away));
    }
  }

  std::vector<SurfaceTriangle> faces_;
  std::array<double, 2> low_{1e9, 1e9};
  std::array<double, 2> high_{-1e9, -1e9};
  std::vector<std::vector<std::size_t>> cells_;
  std::vector<double> tops_;
  std::vector<Box> boxes_;
  std::vector<std::size_t> seen_;  // for each face: the last place that it was looked at
  std::size_t time_ = 0;
};

}  // namespace passo::test
