// The error numbers and states of Grbl 1.1 machines as text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/sender/grbl_reply.hpp"

namespace passo {

// `code` is stable; the message is a sentence without a full stop.
struct GrblFault {
  std::string code;
  std::string message;
  // The range of program lines; 0: none.
  std::uint32_t first_line = 0;
  std::uint32_t last_line = 0;
};

// Return the meaning of error:n and of ALARM:n, as a clause. Numbers above Grbl's own depend on the firmware.
std::string_view words_of_grbl_error(std::string_view firmware, int number);
std::string_view words_of_grbl_alarm(std::string_view firmware, int number);

// Returns why a machine in this state accepts no lines, and what to do. Empty: it accepts them (Idle), or only some
// (Alarm).
std::optional<GrblFault> trouble_of_grbl_state(const GrblReport& report);

// Returns what the operator must do at a machine in this state, as a sentence without a full stop. Empty: nothing.
std::string_view words_of_grbl_wait(const GrblReport& report);

}  // namespace passo
