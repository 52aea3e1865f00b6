// DxfGroups: reads the groups of a DXF file one by one. A group is a code, which determines the meaning of the value,
// and the value. Private to cam/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "text_lines.hpp"

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct DxfGroup {
  int code = 0;
  std::string_view text;   // value of a code with text
  double number = 0;       // value of a code with a number
  std::uint32_t line = 0;  // line of the value; 0 in a binary file
  bool is(int wanted_code, std::string_view wanted) const { return code == wanted_code && text == wanted; }
};

class DxfGroups {
 public:
  DxfGroups(const std::string& file, std::string_view text, Diagnostics& diagnostics);

  // Reads the next group. Returns false at the end, and after an error, which is reported in the diagnostics.
  [[nodiscard]] bool next(DxfGroup& group);
  bool has_failed() const { return has_failed_; }
  // Reports an error at a group of this file. `line` is the group's line; in a binary file any number.
  void refuse(std::uint32_t line, std::string code, std::string message, std::string expected);

 private:
  bool next_of_text(DxfGroup& group);
  bool next_binary(DxfGroup& group);
  bool read_binary_value(DxfGroup& group);
  bool read_bytes(std::size_t bytes, std::string_view& taken);
  bool is_cut_off();

  std::string file_;
  std::string_view text_;
  TextLines lines_;
  Diagnostics& diagnostics_;
  bool is_binary_ = false;
  bool has_short_codes_ = false;  // binary files of R12: codes of one byte
  bool has_failed_ = false;
  std::size_t at_ = 0;  // offset in a binary file
  std::string_view line_;
};

}  // namespace passo
