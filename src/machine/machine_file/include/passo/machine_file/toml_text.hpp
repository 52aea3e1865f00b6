// TomlText: edits values in the text of a machine file. Everything else remains unchanged, byte for byte: comments,
// order, spaces, line ends.
//
//   max_velocity_mm_s = 200     # 2400 rpm                   set("axis.X.max_velocity_mm_s", 85.5)
//   max_velocity_mm_s = 85.5    # 2400 rpm                   the comment stays in its column, if there is room
//
// A new key is written below the last key of its table. A new table is written at the end of the file.
//
// Invariant: the text is valid TOML. A failed change leaves the text unchanged. parse_machine() checks whether the file
// is still a valid machine file.
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
  // Numbers must be finite. A list of numbers is written on one line.
  using Setting = std::variant<double, bool, std::string, std::vector<double>>;

  // `text`: a file that parse_machine() has accepted. (The TOML library does not limit the depth of keys, so other
  // files would need a limit.)
  static Result<TomlText, TomlTextError> read(std::string text);

  // `path`: the key with its tables, "axis.X.max_velocity_mm_s". Its parts are letters, digits, '_' and '-'.
  Status<TomlTextError> set(std::string_view path, const Setting& setting);

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

  std::string text_;
};

}  // namespace passo
