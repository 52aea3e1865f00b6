#include "passo/gcode/grbl_command.hpp"

#include <algorithm>
#include <iterator>

#include "characters.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

struct Known {
  std::string_view name;
  std::string_view what;
  std::string_view expected;
};
constexpr Known known[] = {
    {"H", "homes the machine",
     "the program without this line; home with passo home or from the sender before the program"},
    {"X", "clears an alarm of Grbl",
     "the program without this line; the operator clears an alarm after removing its cause"},
    {"J=", "jogs", "G0 or G1 in the program, or passo jog"},
    {"N", "is a startup line of Grbl", "its words in the program itself, if they are needed"},
    {"RST=", "resets Grbl settings", "the program without this line; reset them from the sender"},
};
constexpr std::string_view without = "the program without this line; send it from the sender";

// In upper case and without blanks, as Grbl reads a line. Comments are not taken out.
std::string as_grbl_reads(std::string_view line) {
  std::string text;
  for (const char c : line) {
    if (!is_blank(c) && c != '\r') text += to_upper(c);
  }
  return text;
}

}  // namespace

std::optional<GrblCommand> grbl_command_in(std::string_view line) {
  const std::string all = as_grbl_reads(line);
  if (!all.starts_with('$')) return std::nullopt;
  const std::string text = all.substr(0, all.find_first_of("(;"));
  const std::string_view after = std::string_view(text).substr(1);
  const auto* const end = std::ranges::find_if_not(after, is_digit);
  const std::string_view number(after.begin(), end);
  if (!number.empty() && end != after.end() && *end == '=') {
    return GrblCommand{
        fmt::format("${}= changes a Grbl setting, and cannot be part of a program", number),
        "the program without this line; change the setting from the sender (Grbl) or in the machine file (Passo)"};
  }
  const bool is_function = !after.empty() && is_letter(after.front()) && after.find('[') != std::string_view::npos;
  const bool is_report = after.empty() || after == "$" || after == "#";
  if (is_function || (!is_report && !is_letter(after.front()))) return std::nullopt;
  const auto* const found =
      std::ranges::find_if(known, [&](const Known& entry) { return after.starts_with(entry.name); });
  if (found == std::end(known)) {
    return GrblCommand{fmt::format("{} is a system command of Grbl, and cannot be part of a program", text),
                       std::string(without)};
  }
  return GrblCommand{
      fmt::format("${} {}: a system command of Grbl cannot be part of a program", found->name, found->what),
      std::string(found->expected)};
}

}  // namespace passo
