#include "curve_arguments.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "argument_units.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

template <class T>
using Parsed = Result<T, std::string>;
using Built = Result<AnyCurve, std::string>;

// How far a place may be from the curve on which it should lie. Programs and people round their numbers.
constexpr double rounding_mm = 0.01;

Parsed<Vector3> place_of(std::string_view option, const std::string& text, double z = 0) {
  if (text.empty()) return Failure{fmt::format("{} is missing: X,Y or X,Y,Z in mm", option)};
  const auto numbers = numbers_of(option, text, 2, 3, "X,Y or X,Y,Z in mm");
  if (!numbers) return Failure{numbers.error()};
  return Vector3{(*numbers)[0], (*numbers)[1], numbers->size() > 2 ? (*numbers)[2] : z};
}

template <class C>
Built built(const Result<C, CurveError>& curve) {
  if (!curve) return Failure{curve.error().message};
  return AnyCurve(*curve);
}

Point point_of(const Vector3& place) {
  Point point;
  point[Axis::x] = place.x;
  point[Axis::y] = place.y;
  point[Axis::z] = place.z;
  return point;
}

struct Ends {
  Vector3 from;
  Vector3 to;
};

// If the end has no Z, it is as high as the start.
Parsed<Ends> ends_of(const ChordsArguments& arguments) {
  const auto from = place_of("--from", arguments.from);
  if (!from) return Failure{from.error()};
  const auto to = place_of("--to", arguments.to, from->z);
  if (!to) return Failure{to.error()};
  return Ends{*from, *to};
}

Built line_of(const ChordsArguments& arguments) {
  const auto ends = ends_of(arguments);
  if (!ends) return Failure{ends.error()};
  return built(CurveInSpace::of(Curve::line(point_of(ends->from), point_of(ends->to))));
}

// An arc or a helix: X and Y turn about a centre, and Z grows in proportion to the angle.
Built arc_of(const ChordsArguments& arguments) {
  const auto ends = ends_of(arguments);
  if (!ends) return Failure{ends.error()};
  const auto centre = place_of("--center", arguments.center);
  if (!centre) return Failure{centre.error()};
  const Vector3 out = ends->from - *centre;
  const Vector3 end = ends->to - *centre;
  const double radius = std::hypot(out.x, out.y);
  const double end_radius = std::hypot(end.x, end.y);
  if (!(radius > 0)) return Failure{std::string("--from and --center are the same point, so the arc has no radius")};
  if (!(std::abs(radius - end_radius) <= rounding_mm)) {
    return Failure{fmt::format("--to is {:.6g} mm from --center, but --from is {:.6g} mm: an arc has one radius",
                               end_radius, radius)};
  }
  double turn = std::atan2(out.x * end.y - out.y * end.x, out.x * end.x + out.y * end.y);
  if (arguments.clockwise) turn = -turn;
  // If start and end are the same place, the arc is a full circle.
  if (turn <= 1e-12) turn += 2 * std::numbers::pi;
  turn += 2 * std::numbers::pi * (arguments.turns - 1);
  const Curve curve = Curve::arc(point_of(ends->from), point_of(ends->to), Axis::x, Axis::y, centre->x, centre->y,
                                 arguments.clockwise ? -turn : turn);
  return built(CurveInSpace::of(curve));
}

Built ellipse_of(const ChordsArguments& arguments) {
  const auto centre = place_of("--center", arguments.center);
  if (!centre) return Failure{centre.error()};
  if (arguments.radii.empty()) return Failure{std::string("--radii is missing: A,B in mm")};
  const auto radii = numbers_of("--radii", arguments.radii, 2, 2, "A,B in mm");
  if (!radii) return Failure{radii.error()};
  const auto angles =
      numbers_of("--angles", arguments.angles.empty() ? "0,360" : arguments.angles, 2, 2, "FROM,TO in degrees");
  if (!angles) return Failure{angles.error()};
  return built(Ellipse::flat(*centre, Mm((*radii)[0]), Mm((*radii)[1]), {arguments.rotate * radians_per_degree},
                             {(*angles)[0] * radians_per_degree},
                             {((*angles)[1] - (*angles)[0]) * radians_per_degree}));
}

// The distance of `place` from the parabola's axis. Fails if `place` is not on the parabola.
Parsed<Mm> across(std::string_view option, const Vector3& place, const Vector3& vertex, const Vector3& focus) {
  const double focal_length = std::hypot(focus.x - vertex.x, focus.y - vertex.y);
  const Vector3 axis = {(focus.x - vertex.x) / focal_length, (focus.y - vertex.y) / focal_length, 0};
  const Vector3 right = {axis.y, -axis.x, 0};
  const double beside = dot(place - vertex, right);
  const double up = beside * beside / (4 * focal_length);
  if (std::abs(dot(place - vertex, axis) - up) <= rounding_mm) return Mm(beside);
  const Vector3 there = vertex + right * beside + axis * up;
  return Failure{
      fmt::format("{} {:g},{:g} is not on the parabola; the point of the parabola at that height is {:.6g},{:.6g}",
                  option, place.x, place.y, there.x, there.y)};
}

Built parabola_of(const ChordsArguments& arguments) {
  const auto vertex = place_of("--vertex", arguments.vertex);
  if (!vertex) return Failure{vertex.error()};
  const auto focus = place_of("--focus", arguments.focus, vertex->z);
  if (!focus) return Failure{focus.error()};
  const auto ends = ends_of(arguments);
  if (!ends) return Failure{ends.error()};
  if (vertex->x == focus->x && vertex->y == focus->y) {
    return Failure{std::string("--vertex and --focus must be two different points")};
  }
  const auto from = across("--from", ends->from, *vertex, *focus);
  if (!from) return Failure{from.error()};
  const auto to = across("--to", ends->to, *vertex, *focus);
  if (!to) return Failure{to.error()};
  return built(parabola(*vertex, *focus, *from, *to));
}

Parsed<std::vector<Vector3>> control_of(const ChordsArguments& arguments) {
  std::vector<Vector3> control;
  for (const std::string& text : arguments.control) {
    const auto place = place_of("--control", text);
    if (!place) return Failure{place.error()};
    control.push_back(*place);
  }
  return control;
}

Built bezier_of(const ChordsArguments& arguments) {
  const auto ends = ends_of(arguments);
  if (!ends) return Failure{ends.error()};
  const auto control = control_of(arguments);
  if (!control) return Failure{control.error()};
  if (control->size() == 1) return built(QuadraticBezier::create({ends->from, (*control)[0], ends->to}));
  if (control->size() == 2) return built(CubicBezier::create({ends->from, (*control)[0], (*control)[1], ends->to}));
  return Failure{fmt::format(
      "a B\u00E9zier has one --control between --from and --to (quadratic) or two (cubic), not {}", control->size())};
}

Built nurbs_of(const ChordsArguments& arguments) {
  const auto control = control_of(arguments);
  if (!control) return Failure{control.error()};
  return built(Nurbs::create(
      {.degree = arguments.degree, .control = *control, .weights = arguments.weights, .knots = arguments.knots}));
}

struct Kind {
  std::string_view name;
  Built (*build)(const ChordsArguments& arguments);
  std::vector<std::string_view> options;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"line", line_of, {"--from", "--to"}},
      {"arc", arc_of, {"--from", "--to", "--center", "--cw", "--turns"}},
      {"helix", arc_of, {"--from", "--to", "--center", "--cw", "--turns"}},
      {"ellipse", ellipse_of, {"--center", "--radii", "--rotate", "--angles"}},
      {"parabola", parabola_of, {"--from", "--to", "--vertex", "--focus"}},
      {"bezier", bezier_of, {"--from", "--to", "--control"}},
      {"nurbs", nurbs_of, {"--control", "--degree", "--weights", "--knots"}},
  };
  return all;
}

// The first given option that this kind of curve does not have.
std::string_view foreign_option(const ChordsArguments& given, const Kind& kind) {
  const std::array<std::pair<std::string_view, bool>, 13> options = {{{"--from", !given.from.empty()},
                                                                      {"--to", !given.to.empty()},
                                                                      {"--center", !given.center.empty()},
                                                                      {"--cw", given.clockwise},
                                                                      {"--turns", given.turns != 1},
                                                                      {"--radii", !given.radii.empty()},
                                                                      {"--rotate", given.rotate != 0},
                                                                      {"--angles", !given.angles.empty()},
                                                                      {"--vertex", !given.vertex.empty()},
                                                                      {"--focus", !given.focus.empty()},
                                                                      {"--control", !given.control.empty()},
                                                                      {"--weights", !given.weights.empty()},
                                                                      {"--knots", !given.knots.empty()}}};
  for (const auto& [name, present] : options) {
    if (present && std::ranges::find(kind.options, name) == kind.options.end()) return name;
  }
  return {};
}

}  // namespace

Result<std::vector<double>, std::string> numbers_of(std::string_view option, std::string_view text, std::size_t least,
                                                    std::size_t most, std::string_view what) {
  std::vector<double> numbers;
  for (std::string_view rest = text;;) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    double number = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + comma, number);
    if (error != std::errc() || end != rest.data() + comma || !std::isfinite(number)) break;
    numbers.push_back(number);
    if (comma == rest.size()) {
      if (numbers.size() < least || numbers.size() > most) break;
      return numbers;
    }
    rest.remove_prefix(comma + 1);
  }
  return Failure{fmt::format("{}: expected {}, found '{}'", option, what, text)};
}

Result<AnyCurve, std::string> curve_of(const ChordsArguments& arguments) {
  const auto kind = std::ranges::find(kinds(), arguments.curve, &Kind::name);
  if (kind == kinds().end()) {
    std::vector<std::string_view> names;
    for (const Kind& one : kinds()) names.push_back(one.name);
    return Failure{fmt::format("--curve: '{}' is not one of {}", arguments.curve, fmt::join(names, ", "))};
  }
  const std::string_view foreign = foreign_option(arguments, *kind);
  if (!foreign.empty()) {
    return Failure{
        fmt::format("{} is not for --curve {}, which accepts {}", foreign, kind->name, fmt::join(kind->options, ", "))};
  }
  return kind->build(arguments);
}

}  // namespace passo
