#include "passo/sender/grbl_words.hpp"

#include <fmt/format.h>

#include "passo/sender/grbl_firmware.hpp"

namespace passo {

std::string_view words_of_grbl_error(std::string_view firmware, int number) {
  const std::string_view words = meaning_of_grbl_error(firmware, number);
  return words.empty() ? "an error that Grbl 1.1 does not have" : words;
}

std::string_view words_of_grbl_alarm(std::string_view firmware, int number) {
  const std::string_view words = meaning_of_grbl_alarm(firmware, number);
  return words.empty() ? "an alarm that Grbl 1.1 does not have" : words;
}

std::optional<GrblFault> trouble_of_grbl_state(const GrblReport& report) {
  const std::string& state = report.state;
  if (state == "Idle" || state == "Alarm") return {};
  if (state == "Sleep") {
    return GrblFault{.code = "grbl.asleep",
                     .message =
                         "the machine is asleep: its motors are off, and it does not accept lines. Reset it with its "
                         "button or with Ctrl-X from another sender, then home it"};
  }
  if (state == "Check") {
    return GrblFault{.code = "grbl.check-mode",
                     .message =
                         "the machine is in check mode: it would accept all lines without moving. End check mode with "
                         "$C from another sender, or reset the machine"};
  }
  if (const std::string_view wait = words_of_grbl_wait(report); !wait.empty()) {
    return GrblFault{.code = "grbl.busy", .message = fmt::format("{}, or reset it", wait)};
  }
  if (state == "Run" || state == "Jog" || state == "Home") {
    return GrblFault{
        .code = "grbl.busy",
        .message = fmt::format(
            "the machine is already moving (state {}): wait until it stops, or stop it with the sender that moves it",
            state)};
  }
  return GrblFault{
      .code = "grbl.busy",
      .message = fmt::format(
          "the machine is in state {}, in which it may not accept lines: wait until it ends, or reset the machine",
          state)};
}

std::string_view words_of_grbl_wait(const GrblReport& report) {
  if (report.state == "Hold") {
    return "the machine is in a feed hold (state Hold): resume it with its cycle start button, or with the sender that "
           "holds it";
  }
  if (report.state == "Door") {
    return "the machine's safety door is open, or was opened (state Door): close it, and resume the machine with its "
           "cycle start button";
  }
  if (report.state == "Tool") {
    return "the machine waits for a tool change (state Tool): change the tool, and resume the machine with its cycle "
           "start button";
  }
  return {};
}

}  // namespace passo
