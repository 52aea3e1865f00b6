// HpglWords: the commands of a plot one after the other, with their numbers. Private to cam/.
//
// A command is two letters, in either case. Its numbers are parted by commas or blanks; it ends with ';' or where the
// next one begins. Escapes for the plotter's line and for printers are skipped.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace passo {

struct HpglCommand {
  std::array<char, 2> letters = {};
  std::size_t place = 0;  // in the text

  bool is(std::string_view name) const { return letters[0] == name[0] && letters[1] == name[1]; }
  std::string_view name() const { return {letters.data(), 2}; }
};

class HpglWords {
 public:
  explicit HpglWords(std::string_view text) : text_(text) {}

  // Nothing: the text ends, or what stands at place() is no command.
  std::optional<HpglCommand> command();
  // The numbers of the command. Nothing: what stands at place() is no number.
  std::optional<std::vector<double>> numbers();
  // The text up to this character, which is taken, too.
  std::string_view until(char end);
  // The one character after a command, if it does not end there.
  std::optional<char> character();
  void back() { --at_; }  // the character that was taken last
  void skip_to_end_of_command();
  // In quotation marks, or up to the end of the command.
  void skip_comment();

  bool at_end() const { return at_ >= text_.size(); }
  std::size_t place() const { return at_; }

 private:
  void skip_escape();
  void skip_between();

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace passo
