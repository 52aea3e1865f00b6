#include "hook_codes.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "program_lines.hpp"
#include <fmt/format.h>

namespace passo {

std::int32_t HookCodes::begin_start() {
  return begin("hooks.at_start", block_.options.hooks.at_start, start_hook_number, 0);
}

std::int32_t HookCodes::begin_end(CodeNumber number) {
  if (number != code(2) && number != code(30)) return 0;
  return begin("hooks.at_end", block_.options.hooks.at_end, end_hook_number, number);
}

std::int32_t HookCodes::begin(const char* key, const std::string& lines, std::int32_t number, CodeNumber ending) {
  if (!are_allowed_ || lines.empty()) return 0;
  if (speaks_grbl()) {
    block_.ended = true;
    fail("gcode.hook", {}, fmt::format("{} of the machine file is in the LinuxCNC dialect", key),
         "a program in the LinuxCNC dialect");
    return 0;
  }
  call_ = Call{.key = key, .ending = ending, .before = lines_.before()};
  return number;
}

ModalSnapshot HookCodes::end() {
  const Call call = *std::exchange(call_, std::nullopt);
  ending_ = call.ending;
  ModalSnapshot modes = call.before.modes;
  modes.spindles = state_.spindles;
  modes.mist = state_.mist;
  modes.flood = state_.flood;
  const std::string fault = lines_.put_back(call.before, call.before.tool);
  if (fault.empty()) return modes;
  block_.ended = true;
  // The block is the last one of the hook.
  reporter_.error_at("gcode.hook", std::max<std::uint32_t>(block_.source.line, 1), {}, {},
                     fmt::format("{} of the machine file {}", call.key, fault),
                     "lines that leave offsets and tool as the program expects them");
  return modes;
}

bool HookCodes::check_stop(CodeNumber number) {
  if (!call_ || (number != code(2) && number != code(30))) return true;
  return fail("gcode.hook", words_.span(ModalGroup::stopping), "the program would end in a hook",
              fmt::format("{} without M2 and M30", call_->key));
}

}  // namespace passo
