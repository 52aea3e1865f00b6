// Going to a known place: the park position, the homes of G28 and G30, or the work zero. Z always moves first: to the
// top of its travel. Then the other axes move. Only a home lowers Z again, at its end.
//
// The result is a small program in LinuxCNC's dialect, in machine coordinates. It is checked and run like any other
// program.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/base/sentence.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/parameter_file.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

enum class Destination : std::uint8_t { park, first_home, second_home, work_zero };

// Stable: "park", "g28", "g30", "zero".
std::string_view name_of(Destination destination);
// What the command does, as a clause.
std::string_view purpose_of(Destination destination);
std::span<const Destination> all_destinations();
std::optional<Destination> destination_named(std::string_view name);

// Returns the program. `saved`: the parameters with the homes; `frame`: the work coordinate system. The error tells why
// the machine cannot go there: no park position in the machine file, or a place outside the travel.
Result<std::string, Sentence> go_to_program(Destination destination, const MachineDescription& machine,
                                            const SavedParameters& saved, const Frame& frame);

// The same to X and Y of a place that is seen by the camera: Z to the top, then X and Y.
Result<std::string, Sentence> go_over_program(const Point& place, const MachineDescription& machine);

}  // namespace passo
