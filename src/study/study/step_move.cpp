#include "passo/study/step_move.hpp"

#include <cmath>

#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

constexpr std::int64_t longest = 2'147'483'647;

std::int64_t distance(const StepMove& move, std::size_t axis) {
  return move.to[axis] - move.from[axis];
}

double radius(const Place& place, const Place& centre) {
  return std::hypot(static_cast<double>(place[0] - centre[0]), static_cast<double>(place[1] - centre[1]));
}

Status<std::string> check_arc(const StepMove& move) {
  const Place& centre = move.arc->centre;
  if (move.axes() != 2 || centre.size() != 2)
    return Failure{std::string("is an arc, which needs two axes and a centre x,y")};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (const Place* place : {&move.from, &move.to}) {
      if (std::abs((*place)[axis] - centre[axis]) > longest) {
        return Failure{fmt::format("is farther than {} steps from its centre", longest)};
      }
    }
  }
  const double start = radius(move.from, centre);
  const double end = radius(move.to, centre);
  if (start == 0) return Failure{std::string("starts at its centre")};
  if (std::abs(end - start) >= 1) {
    return Failure{
        fmt::format("does not end on its circle: {:.6g} steps from the centre at its start, {:.6g} at its end; the "
                    "difference must be less than a step",
                    start, end)};
  }
  if (std::max(start, end) > static_cast<double>(longest - 1)) {
    return Failure{fmt::format("has a radius above {} steps", longest - 1)};
  }
  return Unit{};
}

}  // namespace

Status<std::string> check(const StepMove& move) {
  if (move.axes() == 0 || move.axes() > most_axes) {
    return Failure{fmt::format("has {}; expected one to {}", counted(move.axes(), "axis", "axes"), most_axes)};
  }
  if (move.from.size() != move.to.size()) {
    return Failure{
        fmt::format("starts with {} and ends with {}", counted(move.from.size(), "axis", "axes"), move.to.size())};
  }
  for (const Place* place : {&move.from, &move.to}) {
    for (const std::int64_t steps : *place) {
      if (std::abs(steps) > longest) return Failure{fmt::format("exceeds {} steps", longest)};
    }
  }
  if (move.arc) return check_arc(move);
  for (std::size_t axis = 0; axis < move.axes(); ++axis) {
    if (std::abs(distance(move, axis)) > longest) {
      return Failure{fmt::format("is {} steps long in {}; at most {} are possible", std::abs(distance(move, axis)),
                                 axis_name(axis), longest)};
    }
  }
  return Unit{};
}

LineDistances distances(const StepMove& move) {
  LineDistances found;
  for (std::size_t axis = 0; axis < move.axes(); ++axis) {
    found.all[axis] = static_cast<std::int32_t>(distance(move, axis));
  }
  return found;
}

ArcPoints arc_points(const StepMove& move) {
  ArcPoints found;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    found.start[axis] = static_cast<std::int32_t>(move.from[axis] - move.arc->centre[axis]);
    found.end[axis] = static_cast<std::int32_t>(move.to[axis] - move.arc->centre[axis]);
  }
  found.clockwise = move.arc->clockwise;
  return found;
}

std::string axis_name(std::size_t axis) {
  return std::string(1, "xyzabcuv"[axis]);
}

}  // namespace passo
