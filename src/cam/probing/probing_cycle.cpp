#include "passo/probing/probing_cycle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "cycle_text.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using Kind = ProbingKind;

constexpr std::array kinds{Kind::surface, Kind::edge,  Kind::corner, Kind::bore, Kind::boss,
                           Kind::tool,    Kind::angle, Kind::bores,  Kind::map};

constexpr std::uint32_t of(std::initializer_list<Kind> some) {
  std::uint32_t bits = 0;
  for (const Kind kind : some) bits |= 1U << static_cast<unsigned>(kind);
  return bits;
}
constexpr std::uint32_t all = of(
    {Kind::surface, Kind::edge, Kind::corner, Kind::bore, Kind::boss, Kind::tool, Kind::angle, Kind::bores, Kind::map});
constexpr std::uint32_t touches_twice = all & ~of({Kind::map});
constexpr std::uint32_t has_system = all & ~of({Kind::tool});
constexpr std::uint32_t has_ball = of({Kind::edge, Kind::corner, Kind::bore, Kind::boss, Kind::bores});

using C = ProbingCycle;
// A number of a cycle, by the members that lead to it.
template <auto... members>
double& part(ProbingCycle& cycle) {
  return (cycle.*....*members);
}

constexpr double far = 1e5;  // mm
constexpr ProbingField fields[] = {
    {"system", part<&C::system>, 1, 9, true, has_system, "work offset that stores the result: 1 is G54, 9 is G59.3"},
    {"ball", part<&C::ball>, 0, 100, false, has_ball, "diameter of the probe's ball, mm"},
    {"reach", part<&C::touch, &C::Touch::reach>, 0.1, 1000, false, touches_twice, "largest length of a probe move, mm"},
    {"fast", part<&C::touch, &C::Touch::fast>, 1, 10000, false, all,
     "feed rate of the first touch (for a map the only one), mm/min"},
    {"slow", part<&C::touch, &C::Touch::slow>, 1, 10000, false, touches_twice, "feed rate of the second touch, mm/min"},
    {"back", part<&C::touch, &C::Touch::back>, 0.01, 100, false, touches_twice,
     "retract distance between the two touches, mm"},
    {"clearance", part<&C::clearance>, 0.1, 1000, false, all, "clearance from the touched surface after a touch, mm"},
    {"depth", part<&C::depth>, 0.01, 1000, false, of({Kind::corner, Kind::boss, Kind::map}),
     "depth below the top at which the sides are touched; for a map: search depth below Z0, mm"},
    {"height", part<&C::height>, -1000, 1000, false, of({Kind::surface}), "work Z of the touched surface, mm"},
    {"inside", part<&C::inside>, 0.1, 1000, false, of({Kind::corner}),
     "distance from the corner at which the second side is touched, mm"},
    {"size_x", part<&C::size_x>, 0.01, 10000, false, of({Kind::boss, Kind::map}), "width along X, mm"},
    {"size_y", part<&C::size_y>, 0.01, 10000, false, of({Kind::boss, Kind::map}), "width along Y, mm"},
    {"along", part<&C::along>, 0.1, 10000, false, of({Kind::angle}), "distance of the two touched points, mm"},
    {"x", part<&C::x>, -far, far, false, of({Kind::tool, Kind::bores, Kind::map}),
     "X of the lower left corner of a map or of the first bore, in work coordinates; X of the tool probe, in machine "
     "coordinates, mm"},
    {"y", part<&C::y>, -far, far, false, of({Kind::tool, Kind::bores, Kind::map}), "Y of the same point, mm"},
    {"second_x", part<&C::second_x>, -far, far, false, of({Kind::bores}),
     "X of the second bore in work coordinates, mm"},
    {"second_y", part<&C::second_y>, -far, far, false, of({Kind::bores}),
     "Y of the second bore in work coordinates, mm"},
    {"fit", part<&C::fit>, 0.001, 1000, false, of({Kind::bores}), "bore spacing tolerance, mm"},
    {"columns", part<&C::columns>, 2, 200, true, of({Kind::map}), "number of points along X"},
    {"rows", part<&C::rows>, 2, 200, true, of({Kind::map}), "number of points along Y"},
    {"tool", part<&C::tool, &C::MeasuredTool::number>, 1, 99999, true, of({Kind::tool}), "tool number"},
    {"travel_z", part<&C::tool, &C::MeasuredTool::travel_z>, -far, far, false, of({Kind::tool}),
     "clearance height: machine Z for moves to the tool probe, mm"},
    {"zero_z", part<&C::tool, &C::MeasuredTool::zero_z>, -far, far, false, of({Kind::tool}),
     "machine Z at which a tool of length 0 touches the tool probe, mm"},
};

// Empty: all values are in their ranges.
std::string wrong_value(ProbingCycle cycle) {
  for (const ProbingField& field : fields) {
    const double value = field.value(cycle);
    if (!field.is_of(cycle.kind)) continue;
    if (!(value >= field.low && value <= field.high))
      return fmt::format("{}: expected {:g} to {:g}, not {:g}", field.name, field.low, field.high, value);
    if (field.is_whole && value != std::floor(value))
      return fmt::format("{}: expected a whole number, not {:g}", field.name, value);
  }
  return {};
}

}  // namespace

std::span<const ProbingField> probing_fields() {
  return fields;
}

std::span<const ProbingKind> all_probing_kinds() {
  return kinds;
}

std::string_view name_of(ProbingKind kind) {
  switch (kind) {
    case Kind::surface: return "surface";
    case Kind::edge: return "edge";
    case Kind::corner: return "corner";
    case Kind::bore: return "bore";
    case Kind::boss: return "boss";
    case Kind::tool: return "tool";
    case Kind::angle: return "angle";
    case Kind::bores: return "bores";
    case Kind::map: return "map";
  }
  return "";
}

std::string_view purpose_of(ProbingKind kind) {
  switch (kind) {
    case Kind::surface: return "find the top of the work and set Z0 there";
    case Kind::edge: return "find an edge of the work and set X0 or Y0 there";
    case Kind::corner: return "find a corner of the work and its top, and set X0 Y0 Z0 there";
    case Kind::bore: return "find the centre of a bore and set X0 Y0 there";
    case Kind::boss: return "find the centre of a boss and set X0 Y0 there";
    case Kind::tool: return "measure a tool on a fixed probe and write its length to the tool table";
    case Kind::angle: return "find the angle of an edge and rotate the work coordinates by it";
    case Kind::bores: return "find two bores, and shift and rotate the work coordinates to match the program";
    case Kind::map: return "measure the height map of a surface";
  }
  return "";
}

Result<std::string, std::string> probing_program(const ProbingCycle& cycle) {
  if (std::string wrong = wrong_value(cycle); !wrong.empty()) return Failure{std::move(wrong)};
  const bool has_way = cycle.kind == Kind::edge || cycle.kind == Kind::angle;
  if (has_way && !way_of(cycle.side)) {
    return Failure{
        fmt::format("side: expected the probe direction, x+, x-, y+ or y-, not '{}'", cycle.side.substr(0, 40))};
  }
  if (cycle.kind == Kind::corner && !corner_of(cycle.side)) {
    return Failure{fmt::format("side: expected a corner, front-left, front-right, back-left or back-right, not '{}'",
                               cycle.side.substr(0, 40))};
  }
  if (cycle.kind == Kind::boss && !(cycle.clearance > cycle.ball / 2))
    return Failure{std::string("clearance: expected more than half of the ball's diameter")};
  const double apart = std::hypot(cycle.second_x - cycle.x, cycle.second_y - cycle.y);
  if (cycle.kind == Kind::bores && !(apart > cycle.fit))
    return Failure{std::string("second_x, second_y: expected another position than that of the first bore")};
  return cycle_text(cycle);
}

}  // namespace passo
