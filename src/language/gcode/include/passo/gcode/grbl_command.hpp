// grbl_command_in: a line that is for Grbl itself, as files for its senders have them: "$H", "$X", "$32=1". In
// RS274/NGC
// `$` is a word, as in "$1 M3 S100", and such a line is none of these.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace passo {

struct GrblCommand {
  std::string message;   // what the line is
  std::string expected;  // what to do instead
};

std::optional<GrblCommand> grbl_command_in(std::string_view line);

}  // namespace passo
