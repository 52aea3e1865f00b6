// GerberText: the commands of a Gerber file one after the other, with their places. Private to cam/.
//
// A plain command ends with '*'. Extended commands stand between two '%', and each of them ends with '*' too. Line ends
// and other control characters are no part of a command, wherever they are. The text is not copied, unless a command
// goes over several lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct GerberCommand {
  std::string_view words;      // without '*', '%' and line ends; valid until the next command
  bool is_extended = false;    // it stands between two '%'
  bool is_last = true;         // of those between two '%'
  std::size_t begin = 0;       // byte of the file
  std::uint32_t line = 1;      // where it begins
  std::size_t line_begin = 0;  // byte of the file
};

class GerberText {
 public:
  explicit GerberText(std::string_view text);

  [[nodiscard]] bool next(GerberCommand& command);

  // The place of words.substr(at, length).
  SourcePlace place(const GerberCommand& command, std::size_t at, std::size_t length) const;
  // The line of that place, for the caret. Empty: it is too long to be shown.
  std::string_view line_of(const GerberCommand& command, std::size_t at) const;

 private:
  struct Spot {
    std::uint32_t line;
    std::size_t line_begin;
    std::size_t byte;
  };
  Spot spot(const GerberCommand& command, std::size_t at) const;
  void skip_blanks();
  void step();
  std::size_t end_of_command() const;

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1;
  std::size_t line_begin_ = 0;
  bool in_extended_ = false;
  std::string joined_;  // a command that goes over several lines
};

}  // namespace passo
