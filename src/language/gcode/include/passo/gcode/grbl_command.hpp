// grbl_command_in: recognises Grbl system commands in files written for Grbl senders: "$H", "$X", "$32=1". In RS274/NGC
// `$` is a word, e.g. "$1 M3 S100"; such a line is not a system command.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace passo {

struct GrblCommand {
  std::string message;   // the error
  std::string expected;  // what to do instead
};

std::optional<GrblCommand> grbl_command_in(std::string_view line);

}  // namespace passo
