// TextLines: reads the lines of a text one by one, with their numbers. Private to cam/.
//
// A line ends with LF, CR LF or CR, which is not part of the line.
#pragma once

#include <cstdint>
#include <string_view>

#include "passo/base/trimmed.hpp"

namespace passo {

class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  [[nodiscard]] bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find_first_of("\r\n");
    line = rest_.substr(0, end);
    const bool has_two = end != std::string_view::npos && rest_.substr(end, 2) == "\r\n";
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + (has_two ? 2 : 1));
    ++number_;
    return true;
  }
  // Returns the number of the line that next() returned last, from 1.
  std::uint32_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::uint32_t number_ = 0;
};

}  // namespace passo
