// PathBuilder's check that the machine can go where the program sends it.
#include <algorithm>

#include "path_sentences.hpp"
#include <fmt/format.h>

#include "passo/path/path_builder.hpp"

namespace passo {
namespace {

// A move to exactly the limit may be beyond the limit by rounding. That is no excursion.
constexpr double slack = 1e-6;

// A length of a message, in the program's units: three decimals of a millimetre, four of an inch. Degrees are degrees.
std::string in_units(double value, Axis axis, LengthUnits units) {
  const bool inches = units == LengthUnits::inch && !is_rotary(axis);
  return fmt::format("{:.{}f}", inches ? value / mm_per_inch : value, inches ? 4 : 3);
}

const char* unit_of(Axis axis, LengthUnits units) {
  if (is_rotary(axis)) return "degrees";
  return units == LengthUnits::inch ? "inches" : "mm";
}

// The place of the curve where `axis` reaches `reached`: an end, or where the axis turns back. There, an arc's other
// axis is level with the centre.
Point place_of(const Curve& curve, Axis axis, double reached) {
  if (curve.start()[axis] == reached) return curve.start();
  Point place = curve.end();
  if (place[axis] == reached || curve.shape() == Curve::Shape::line) return place;
  if (curve.shape() == Curve::Shape::cubic) {
    for (const Mm turn : curve.turning_points(axis)) {
      if (turn > Mm(0) && curve.at(turn)[axis] == reached) return curve.at(turn);
    }
    return place;
  }
  const Curve::ArcData& arc = curve.arc_data();
  place[arc.first] = arc.first_center;
  place[arc.second] = arc.second_center;
  place[axis] = reached;
  return place;
}

}  // namespace

bool PathBuilder::is_within_travel(const Box& box) const {
  for (const Axis axis : all_axes) {
    if (!options_.axes.has(axis)) continue;
    const TravelLimit& travel = options_.travel[axis];
    if (box.high[axis] > travel.high + slack || box.low[axis] < travel.low - slack) return false;
  }
  return true;
}

// Most arcs lie within the travel with their whole circles. Only another arc is measured exactly.
void PathBuilder::check_travel(const Curve& curve) {
  if (is_within_travel(curve.bounds())) {
    outside_ = {};
    return;
  }
  const Box box = curve.extents();
  for (const Axis axis : all_axes) {
    if (!options_.axes.has(axis)) continue;
    const TravelLimit& travel = options_.travel[axis];
    if (box.high[axis] > travel.high + slack) {
      check_side(axis, TravelEnd::high, box.high[axis], curve);
    } else {
      outside_.stays_within(axis, TravelEnd::high);
    }
    if (box.low[axis] < travel.low - slack) {
      check_side(axis, TravelEnd::low, box.low[axis], curve);
    } else {
      outside_.stays_within(axis, TravelEnd::low);
    }
  }
}

// The curve leaves the travel on this side. A new excursion is reported.
void PathBuilder::check_side(Axis axis, TravelEnd end, double reached, const Curve& curve) {
  const bool high_side = end == TravelEnd::high;
  const TravelLimit& travel = options_.travel[axis];
  const double limit = high_side ? travel.high : travel.low;
  const double end_beyond = high_side ? curve.end()[axis] - limit : limit - curve.end()[axis];
  if (!outside_.leaves(axis, end, end_beyond > slack)) return;
  const auto shown = [&](double value) { return in_units(value, axis, units_); };
  const std::string letter(1, letter_of(axis));
  const double work = frame_.work_from_machine(place_of(curve, axis, reached))[axis];
  const std::string far = shown(high_side ? reached - limit : limit - reached) + " " + unit_of(axis, units_);
  const bool inches = units_ == LengthUnits::inch;
  report(Severity::error, std::string(travel_exceeded),
         (high_side ? path_says::above_travel : path_says::below_travel)
             .with({{"axis", letter},
                    {"reached", shown(reached)},
                    {"work", shown(work)},
                    {"far", far},
                    {"end", shown(limit)}}),
         (inches ? path_says::within_travel_in_inches : path_says::within_travel)
             .with({{"axis", letter}, {"low", shown(travel.low)}, {"high", shown(travel.high)}}),
         axis);
}

// Each missing axis is reported once, because a program for a machine with more axes moves them in most of its lines.
void PathBuilder::check_axes(const Curve& curve) {
  for (const Axis axis : all_axes) {
    if (options_.axes.has(axis) || missing_.has(axis) || !curve.moves(axis)) continue;
    missing_.add(axis);
    std::string has;
    for (const Axis other : all_axes) {
      if (options_.axes.has(other)) has += letter_of(other);
    }
    report(Severity::error, "travel.no-such-axis",
           path_says::no_such_axis.with({{"axis", std::string(1, letter_of(axis))}}),
           path_says::these_axes.with({{"axes", has}}), axis);
  }
}

}  // namespace passo
