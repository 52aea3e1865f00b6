// OperatorText: lines that an operator adds to a program, e.g. for the tool change, with placeholders such as {tool}.
// Placeholders and words are checked when the text is read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/post_processor/controller_words.hpp"

namespace passo {

class OperatorText {
 public:
  // The values of the placeholders, by name.
  using Values = std::vector<std::pair<std::string_view, std::string>>;

  // The position of the text in the program.
  enum class Place : std::uint8_t { start, tool_change, end };

  // Reads the text of `file`. Errors are added to `findings`: unknown placeholders, and words that `controller` does
  // not know.
  static OperatorText read(std::string_view text, const std::string& file, Place place,
                           const ControllerWords& controller, Diagnostics& findings);

  bool empty() const { return lines_.empty(); }
  // Whether the text ends the program itself, by M2 or M30.
  bool ends_program() const { return ends_program_; }
  std::vector<std::string> lines_with(const Values& values) const;

 private:
  std::vector<std::string> lines_;
  bool ends_program_ = false;
};

// The names of the placeholders.
std::vector<std::string_view> placeholder_names();

}  // namespace passo
