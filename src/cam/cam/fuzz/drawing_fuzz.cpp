// Any bytes as a DXF drawing and as a drill file: they are refused with places inside their lines, or the drawing is
// within its limits; of small drawings the plan holds every hole, and the program has no number that is not finite.
#include <cstdint>
#include <string>
#include <string_view>

#include "drawing_checks.hpp"
#include "layer_checks.hpp"

#include "passo/cam/drill_plan.hpp"
#include "passo/cam/drill_program.hpp"
#include "passo/cam/dxf.hpp"
#include "passo/cam/excellon.hpp"

namespace passo {
namespace {

using test::check_drawing;
using test::check_findings;
using test::require;

void check_plan(const Drawing& drawing) {
  constexpr std::size_t few = 2000;
  if (drawing.holes.size() + drawing.paths.size() > few) return;
  DrillOptions options;
  options.mill = Nanometres{800'000};
  options.route_steps = 20'000;
  Diagnostics findings;
  const DrillPlan plan = plan_drilling({drawing}, options, findings);
  check_findings(findings);
  if (findings.any_error()) return;
  DrillProgramOptions program;
  program.peck = Nanometres{700'000};
  const std::string text = write_drill_program(plan, program);
  require(text.find("nan") == std::string::npos && text.find("inf") == std::string::npos, "a number not finite", text);
  require(text.ends_with("M2\n"), "no end", text);
}

void check_bytes(std::string_view bytes) {
  Diagnostics of_dxf;
  const Drawing dxf = read_dxf("fuzz.dxf", bytes, {.is_for_drilling = bytes.size() % 2 == 0}, of_dxf);
  check_findings(of_dxf);
  check_drawing(dxf);
  if (!of_dxf.any_error()) check_plan(dxf);
  Diagnostics of_drill;
  const Drawing drill = read_excellon("fuzz.drl", bytes, {}, of_drill);
  check_findings(of_drill);
  check_drawing(drill);
  if (!of_drill.any_error()) check_plan(drill);
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::check_bytes({reinterpret_cast<const char*>(data), size});
  return 0;
}
