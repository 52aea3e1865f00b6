// Any bytes as a machine file (TOML): either they are refused, with places inside their lines, or the description is
// whole and sound.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "kit/require.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {
namespace {

using test::require;

void check_description(const MachineDescription& machine) {
  require(!machine.axes.empty() && machine.axes.size() <= most_motors, "no axis, or too many");
  require(std::isfinite(machine.path_tolerance.value()) && machine.path_tolerance.value() > 0, "tolerance");
  for (const AxisDescription& axis : machine.axes) {
    require(std::isfinite(axis.steps_per_unit) && axis.steps_per_unit > 0, "steps");
    require(std::isfinite(axis.travel_low) && std::isfinite(axis.travel_high), "travel");
    require(axis.travel_low < axis.travel_high, "travel without room");
    require(std::isfinite(axis.velocity.value()) && axis.velocity.value() > 0, "velocity");
    require(std::isfinite(axis.acceleration.value()) && axis.acceleration.value() > 0, "acceleration");
    require(axis.highest_step_rate().value() <= machine.board.highest_event_rate.value() * (1 + 1e-9), "too fast");
  }
  require(!describe(machine).empty(), "nothing to say");
}

void check_machine(std::string_view text) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(text, "fuzz.toml", diagnostics, MachineUse::any_board);
  require(machine.has_value() == !diagnostics.any_error(), "refused without a word, or taken with an error");
  for (const Diagnostic& finding : diagnostics.all()) {
    require(finding.code.starts_with("machine.") && !finding.message.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
  if (machine) check_description(*machine);
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::check_machine({reinterpret_cast<const char*>(data), size});
  return 0;
}
