#include "program_messages.hpp"

#include <cstdio>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "passo/report/summary.hpp"

namespace passo {
namespace {

// Control characters in a program must not reach the terminal.
std::string without_controls(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);  // "(MSG, text)"
  std::string shown(text);
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f) c = ' ';
  }
  return shown;
}

}  // namespace

void ProgramMessages::show(const Operation& operation, const std::function<void()>& before) {
  if (!wanted_ || shown_ > RunSummary::most_messages) return;
  const auto* message = std::get_if<operation::Message>(&operation.what);
  const auto* print = std::get_if<operation::Print>(&operation.what);
  if (message == nullptr && print == nullptr) return;
  if (before) before();
  if (++shown_ > RunSummary::most_messages) {
    fmt::print(stderr, "{}: note: the program has more than {} messages; the others are not shown\n", program_,
               RunSummary::most_messages);
    return;
  }
  const std::string_view file = operation.file.empty() ? std::string_view(program_) : operation.file;
  fmt::print(stderr, "{}:{}: {}: {}\n", file, operation.source.line, message != nullptr ? "message" : "print",
             without_controls(message != nullptr ? message->text : print->text));
}

}  // namespace passo
