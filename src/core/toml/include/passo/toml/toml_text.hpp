// TomlText: edits values in the text of a machine file or a job file. Everything else remains unchanged, byte for byte:
// comments, order, spaces, line ends.
//
//   max_velocity_mm_s = 200     # 2400 rpm                   set("axis.X.max_velocity_mm_s", 85.5)
//   max_velocity_mm_s = 85.5    # 2400 rpm                   the comment stays in its column, if there is room
//
// A new key is written below the last key of its table. A new table is written at the end of the file.
//
// Tables of a list, [[operation]], are numbered from 1: set("operation.2.depth", -4). They are inserted, copied, moved
// and removed as blocks of lines. A block consists of the head, the lines below it up to the last key with its tables
// [operation.…], and the comments directly above and below. Comments between blank lines stay where they are.
//
// Invariant: the text is valid TOML. A failed change leaves the text unchanged. After each change the text is parsed
// again: the change is there, and all other values are as before. Whether the file is a valid machine file or job file
// is checked by its reader.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

struct TomlTextError {
  std::string message;  // "axis.X is a table", "this is not TOML: ..."
};

class TomlText {
 public:
  static constexpr std::size_t most_parts = 16;  // of a path
  // Numbers must be finite. A list of numbers is written on one line.
  using Setting = std::variant<double, bool, std::string, std::vector<double>>;

  // `text`: a file that is_fit_for_parser(). (The TOML library does not limit the depth of keys.)
  static Result<TomlText, TomlTextError> read(std::string text);

  // `path`: the key with its tables, "axis.X.max_velocity_mm_s". Its parts are letters, digits, '_' and '-', and
  // there are at most `most_parts`.
  Status<TomlTextError> set(std::string_view path, const Setting& setting);

  // The same for any value, as TOML has it: "[[10, 0], [40, 0]]", on one line.
  Status<TomlTextError> set_words(std::string_view path, const std::string& words);
  // Removes a key with its value, and a comment on its line. A key that is not there is no error.
  Status<TomlTextError> remove(std::string_view path);

  struct NewKey {
    std::string key;
    std::string words;  // its value, as in set_words()
  };
  // `number`: that of the new table; one more than there are appends it.
  Status<TomlTextError> insert_table(std::string_view list, std::size_t number, const std::vector<NewKey>& keys);
  // The copy follows the table.
  Status<TomlTextError> copy_table(std::string_view list, std::size_t number);
  // `to`: the number that the table then has.
  Status<TomlTextError> move_table(std::string_view list, std::size_t number, std::size_t to);
  Status<TomlTextError> remove_table(std::string_view list, std::size_t number);
  // Removes a table with a head, [tool.3], with the tables below it, [tool.3.chip_load_mm], and the comments directly
  // above and below. One without a head must be written on one line. A table that is not there is an error.
  Status<TomlTextError> remove_table(std::string_view path);

  // A value as TOML has it. Empty: a number that is not finite.
  static std::string words_of(const Setting& setting);

  const std::string& text() const { return text_; }

  // All editable values with their paths, in the order of the file. Others, such as nested lists and dates, are
  // omitted.
  struct Value {
    std::string path;
    Setting setting;
  };
  std::vector<Value> values() const;

 private:
  explicit TomlText(std::string text) : text_(std::move(text)) {}

  // Takes over a text whose list has these tables of the present one, by their numbers; 0: a new one.
  Status<TomlTextError> take(std::string changed, std::string_view list, const std::vector<std::size_t>& numbers);

  std::string text_;
};

}  // namespace passo
