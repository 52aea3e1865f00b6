#include "passo/activity/go_to.hpp"

#include <algorithm>
#include <array>

#include "small_program.hpp"

#include "passo/interpreter/saved_offsets.hpp"

namespace passo {
namespace {

using enum Destination;

struct DestinationRow {
  Destination destination;
  std::string_view name;
  std::string_view purpose;
};
constexpr DestinationRow destination_rows[] = {
    {park, "park", "move to the park position of the machine file, Z first"},
    {first_home, "g28", "move to the stored position of G28, Z to the top first"},
    {second_home, "g30", "move to the stored position of G30, Z to the top first"},
    {work_zero, "zero", "move above the work zero: Z to the top, then X0 Y0"},
};
constexpr std::array destinations{park, first_home, second_home, work_zero};

constexpr std::string_view purpose_of_cross_hair =
    "move the tool over the point under the camera's cross-hair, Z first";
constexpr SentenceRow no_park{"goto.no-park", "the machine file has no park position: the table [park] with place_mm"};

const DestinationRow& row_of(Destination destination) {
  return *std::ranges::find(destination_rows, destination, &DestinationRow::destination);
}

// Where the axes go, and whether Z is lowered at the end.
struct Way {
  Point place;
  AxisSet axes;
  bool lowers = false;
};

// A home that was never stored is machine zero, which may be at the table: Z stays up there.
Way home_way(const Point& place, AxisSet axes) {
  return {.place = place, .axes = axes, .lowers = place != Point()};
}

// The axes X and Y of the machine.
AxisSet plane_of(const MachineDescription& machine) {
  AxisSet plane;
  for (const AxisDescription& axis : machine.axes) {
    if (axis.axis == Axis::x || axis.axis == Axis::y) plane.add(axis.axis);
  }
  return plane;
}

Way way_of(Destination destination, const MachineDescription& machine, const SavedParameters& saved,
           const Frame& frame) {
  const AxisSet plane = plane_of(machine);
  AxisSet all;
  for (const AxisDescription& axis : machine.axes) {
    if (axis.axis != Axis::z) all.add(axis.axis);
  }
  switch (destination) {
    case park: return {.place = *machine.park.place, .axes = plane};
    case first_home: return home_way(saved_point(saved, home_parameter(1)), all);
    case second_home: return home_way(saved_point(saved, home_parameter(2)), all);
    case work_zero: break;
  }
  return {.place = frame.machine_from_work({}), .axes = plane};
}

Result<std::string, Sentence> program_of(const Way& way, const MachineDescription& machine, std::string_view purpose) {
  const std::optional<double> top = machine.top_of_travel();
  std::string words;
  for (const AxisDescription& axis : machine.axes) {
    if (!way.axes.has(axis.axis)) continue;
    if (auto outside = outside_travel(machine, axis.axis, way.place[axis.axis])) return Failure{std::move(*outside)};
    words += fmt::format(" {}{:.4f}", letter_of(axis.axis), way.place[axis.axis]);
  }
  SmallProgram program(purpose);
  if (top) program.line("G53 G0 Z{:.4f}", *top);
  if (!words.empty()) program.line("G53 G0{}", words);
  if (!top || !way.lowers) return program.finish();
  const double z = way.place[Axis::z];
  if (auto outside = outside_travel(machine, Axis::z, z)) return Failure{std::move(*outside)};
  program.line("G53 G0 Z{:.4f}", z);
  return program.finish();
}

}  // namespace

std::string_view name_of(Destination destination) {
  return row_of(destination).name;
}

std::string_view purpose_of(Destination destination) {
  return row_of(destination).purpose;
}

std::span<const Destination> all_destinations() {
  return destinations;
}

std::optional<Destination> destination_named(std::string_view name) {
  const auto* const found = std::ranges::find(destination_rows, name, &DestinationRow::name);
  return found == std::end(destination_rows) ? std::nullopt : std::optional(found->destination);
}

Result<std::string, Sentence> go_to_program(Destination destination, const MachineDescription& machine,
                                            const SavedParameters& saved, const Frame& frame) {
  if (destination == park && !machine.park.place) return Failure{no_park.with()};
  return program_of(way_of(destination, machine, saved, frame), machine, purpose_of(destination));
}

Result<std::string, Sentence> go_over_program(const Point& place, const MachineDescription& machine) {
  return program_of({.place = place, .axes = plane_of(machine)}, machine, purpose_of_cross_hair);
}

}  // namespace passo
