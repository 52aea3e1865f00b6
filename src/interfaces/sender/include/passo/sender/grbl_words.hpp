// The numbers and states of machines that speak Grbl 1.1, in words.
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
  // Of the program; 0: none. From the first to the last line that it may be.
  std::uint32_t first_line = 0;
  std::uint32_t last_line = 0;
};

// The meaning of error:n and of ALARM:n, as a clause. Above Grbl's own numbers each firmware has others.
std::string_view words_of_grbl_error(std::string_view firmware, int number);
std::string_view words_of_grbl_alarm(std::string_view firmware, int number);

// Why a machine in this state takes no lines, and what to do. Empty: it takes them (Idle), or only some (Alarm).
std::optional<GrblFault> trouble_of_grbl_state(const GrblReport& report);

// What a machine in this state waits for, as a sentence without a full stop: somebody must act at the machine. Empty:
// it waits for nobody.
std::string_view words_of_grbl_wait(const GrblReport& report);

}  // namespace passo
