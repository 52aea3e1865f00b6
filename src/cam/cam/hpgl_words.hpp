// HpglWords: reads the commands of a plot one by one, with their parameters. Private to cam/.
//
// A command is two letters in either case. Its parameters are separated by commas or blanks; it ends with ';' or at the
// next command. Escape sequences for the plotter's serial port and for printers are skipped.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace passo {

struct HpglCommand {
  std::array<char, 2> letters = {};
  std::size_t place = 0;  // offset in the text

  bool is(std::string_view name) const { return letters[0] == name[0] && letters[1] == name[1]; }
  std::string_view name() const { return {letters.data(), 2}; }
};

class HpglWords {
 public:
  explicit HpglWords(std::string_view text) : text_(text) {}

  // Reads a command. Nothing at the end of the text, and if there is no command at place().
  std::optional<HpglCommand> command();
  // Reads the parameters of the command. Nothing if there is no number at place().
  std::optional<std::vector<double>> numbers();
  // Reads the text up to this character, and skips the character.
  std::string_view until(char end);
  // Reads the single character after a command, if the command does not end there.
  std::optional<char> character();
  void back() { --at_; }  // unreads the last character
  void skip_to_end_of_command();
  // Skips a comment in quotation marks, or up to the end of the command.
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
