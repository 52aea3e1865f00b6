#include "cycle_codes.hpp"

#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

}  // namespace

bool CycleCodes::check_cycle(std::string_view name) {
  return check_no_inverse_time(name) && check_uncompensated(name);
}

bool CycleCodes::check_no_inverse_time(std::string_view name) {
  if (!state_.modal.inverse_time()) return true;
  return fail("gcode.cycle-inverse-time", motion_span(), fmt::format("{} in inverse time mode (G93)", name),
              "G94 or G95 first");
}

bool CycleCodes::check_uncompensated(std::string_view name) {
  if (state_.modal[cutter_compensation] == code(40)) return true;
  return fail("gcode.cycle-compensation", motion_span(), fmt::format("{} while cutter compensation is on", name),
              "G40 first");
}

}  // namespace passo
