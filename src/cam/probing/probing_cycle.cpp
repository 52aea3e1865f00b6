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
    {"system", part<&C::system>, 1, 9, true, has_system, "work system that gets the result: 1 is G54, 9 is G59.3"},
    {"ball", part<&C::ball>, 0, 100, false, has_ball, "diameter of the probe's ball, mm"},
    {"reach", part<&C::touch, &C::Touch::reach>, 0.1, 1000, false, touches_twice, "how far a touch looks, mm"},
    {"fast", part<&C::touch, &C::Touch::fast>, 1, 10000, false, all,
     "speed of the first touch, of a map the only one, mm/min"},
    {"slow", part<&C::touch, &C::Touch::slow>, 1, 10000, false, touches_twice, "speed of the second touch, mm/min"},
    {"back", part<&C::touch, &C::Touch::back>, 0.01, 100, false, touches_twice, "between the two touches, mm"},
    {"clearance", part<&C::clearance>, 0.1, 1000, false, all, "how far the probe goes off what it has touched, mm"},
    {"depth", part<&C::depth>, 0.01, 1000, false, of({Kind::corner, Kind::boss, Kind::map}),
     "how far below the top the sides are touched; of a map: how far below Z0 it looks, mm"},
    {"height", part<&C::height>, -1000, 1000, false, of({Kind::surface}), "the work's Z of what is touched, mm"},
    {"inside", part<&C::inside>, 0.1, 1000, false, of({Kind::corner}),
     "how far from the corner the second side is touched, mm"},
    {"size_x", part<&C::size_x>, 0.01, 10000, false, of({Kind::boss, Kind::map}), "width along X, mm"},
    {"size_y", part<&C::size_y>, 0.01, 10000, false, of({Kind::boss, Kind::map}), "width along Y, mm"},
    {"along", part<&C::along>, 0.1, 10000, false, of({Kind::angle}), "between the two places touched, mm"},
    {"x", part<&C::x>, -far, far, false, of({Kind::tool, Kind::bores, Kind::map}),
     "in work coordinates the lower left corner of a map, or the first bore; the tool probe's place in the machine, "
     "mm"},
    {"y", part<&C::y>, -far, far, false, of({Kind::tool, Kind::bores, Kind::map}), "the same along Y, mm"},
    {"second_x", part<&C::second_x>, -far, far, false, of({Kind::bores}), "the second bore in work coordinates, mm"},
    {"second_y", part<&C::second_y>, -far, far, false, of({Kind::bores}), "the same along Y, mm"},
    {"fit", part<&C::fit>, 0.001, 1000, false, of({Kind::bores}),
     "how much nearer or farther apart the bores may be than they should, mm"},
    {"columns", part<&C::columns>, 2, 200, true, of({Kind::map}), "places along X"},
    {"rows", part<&C::rows>, 2, 200, true, of({Kind::map}), "places along Y"},
    {"tool", part<&C::tool, &C::MeasuredTool::number>, 1, 99999, true, of({Kind::tool}), "number of the tool"},
    {"travel_z", part<&C::tool, &C::MeasuredTool::travel_z>, -far, far, false, of({Kind::tool}),
     "the machine's Z at which nothing is in the way, mm"},
    {"zero_z", part<&C::tool, &C::MeasuredTool::zero_z>, -far, far, false, of({Kind::tool}),
     "the machine's Z at which a tool of length 0 touches, mm"},
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
    case Kind::surface: return "finds the top of the work, and makes it Z0";
    case Kind::edge: return "finds an edge of the work, and makes it X0 or Y0";
    case Kind::corner: return "finds a corner of the work and its top, and makes them X0 Y0 Z0";
    case Kind::bore: return "finds the middle of a bore, and makes it X0 Y0";
    case Kind::boss: return "finds the middle of a boss, and makes it X0 Y0";
    case Kind::tool: return "measures a tool on a fixed probe, and writes its length into the tool table";
    case Kind::angle: return "finds the angle of an edge, and turns the work system by it";
    case Kind::bores: return "finds two bores, and moves and turns the work system so that they lie as in the program";
    case Kind::map: return "finds the heights of a surface at the places of a grid";
  }
  return "";
}

Result<std::string, std::string> probing_program(const ProbingCycle& cycle) {
  if (std::string wrong = wrong_value(cycle); !wrong.empty()) return Failure{std::move(wrong)};
  const bool has_way = cycle.kind == Kind::edge || cycle.kind == Kind::angle;
  if (has_way && !way_of(cycle.side)) {
    return Failure{
        fmt::format("side: expected the way of the touch, x+, x-, y+ or y-, not '{}'", cycle.side.substr(0, 40))};
  }
  if (cycle.kind == Kind::corner && !corner_of(cycle.side)) {
    return Failure{fmt::format("side: expected a corner, front-left, front-right, back-left or back-right, not '{}'",
                               cycle.side.substr(0, 40))};
  }
  if (cycle.kind == Kind::boss && !(cycle.clearance > cycle.ball / 2))
    return Failure{std::string("clearance: expected more than half of the ball")};
  const double apart = std::hypot(cycle.second_x - cycle.x, cycle.second_y - cycle.y);
  if (cycle.kind == Kind::bores && !(apart > cycle.fit))
    return Failure{std::string("second_x, second_y: expected another place than that of the first bore")};
  return cycle_text(cycle);
}

}  // namespace passo
