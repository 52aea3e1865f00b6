// GerberText: reads the commands of a Gerber file one by one, with their positions. Private to cam/.
//
// A plain command ends with '*'. Extended commands are enclosed in a pair of '%', and each of them ends with '*', too.
// Line ends and other control characters are ignored everywhere. The text is not copied unless a command spans several
// lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct GerberCommand {
  std::string_view words;      // without '*', '%' and line ends; valid until the next command
  bool is_extended = false;    // whether the command is enclosed in '%'
  bool is_last = true;         // whether this is the last command between two '%'
  std::size_t begin = 0;       // byte offset in the file
  std::uint32_t line = 1;      // first line of the command
  std::size_t line_begin = 0;  // byte offset of that line in the file
};

class GerberText {
 public:
  explicit GerberText(std::string_view text);

  [[nodiscard]] bool next(GerberCommand& command);

  // Returns the position of words.substr(at, length).
  SourceLocation place(const GerberCommand& command, std::size_t at, std::size_t length) const;
  // Returns the source line at that position, for the caret. Empty if the line is too long to be shown.
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
  std::string joined_;  // a command that spans several lines
};

}  // namespace passo
