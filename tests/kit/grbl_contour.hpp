// GrblContour: a random program in the words that are sent to a Grbl machine, and the path that it leads along.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "passo/geometry/axes.hpp"

namespace passo::test {

struct GrblContour {
  std::vector<std::string> lines;
  std::vector<Point> points = {Point()};
};

// Random moves of 4 to 12 mm, at changing feeds and spindle speeds.
inline GrblContour random_grbl_contour(std::mt19937_64& random, int moves = 40) {
  GrblContour contour{.lines = {"M3S1000"}};
  const auto number = [&](int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); };
  Point place;
  for (int i = 0; i < moves; ++i) {
    const double angle = 0.001 * number(0, 6283);
    const double length = number(4, 12);
    place[Axis::x] += std::round(length * std::cos(angle) * 1e4) / 1e4;
    std::string line = i == 0 ? "G1F1500" : number(0, 9) == 0 ? fmt::format("F{}", number(6, 18) * 100) : "";
    line += fmt::format("X{:.4f}", place[Axis::x]);
    if (i == 0 || number(0, 4) != 0) {
      place[Axis::y] += std::round(length * std::sin(angle) * 1e4) / 1e4;
      line += fmt::format("Y{:.4f}", place[Axis::y]);
    }
    contour.lines.push_back(line);
    contour.points.push_back(place);
    if (number(0, 19) == 0) contour.lines.push_back(fmt::format("M3S{}", number(5, 20) * 100));
  }
  contour.lines.emplace_back("G4P0");
  return contour;
}

// Returns how far a place is from the path.
inline double beside(const GrblContour& contour, const Point& place) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < contour.points.size(); ++i) {
    const Point& from = contour.points[i - 1];
    const Point way = contour.points[i] - from;
    const Point to = place - from;
    const double length2 = way[Axis::x] * way[Axis::x] + way[Axis::y] * way[Axis::y];
    const double along = to[Axis::x] * way[Axis::x] + to[Axis::y] * way[Axis::y];
    const Point foot = from + way * std::clamp(length2 > 0 ? along / length2 : 0, 0.0, 1.0);
    nearest = std::min(
        nearest, std::hypot(place[Axis::x] - foot[Axis::x], place[Axis::y] - foot[Axis::y]) + std::abs(place[Axis::z]));
  }
  return nearest;
}

}  // namespace passo::test
