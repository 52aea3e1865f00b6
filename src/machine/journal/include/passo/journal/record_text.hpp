// The text format of a host's record files: words and numbers in lines, and a checksum at the end. RecordWords reads
// such a text; one invalid word makes the whole text invalid.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace passo {

// Number of hexadecimal digits in the checksum.
inline constexpr std::size_t record_check_size = 16;
std::string record_check(std::string_view text);
// Converts a file name so that it fits on one line.
std::string record_name(std::string_view name);

// Ends a record with a line that contains its checksum.
void end_record(std::string& text);
// The parts of a text that begins with a record of this title: the record's body, and the text after the record.
// Nothing: the record is incomplete, or has another title.
struct RecordParts {
  std::string_view body;
  std::string_view rest;
};
std::optional<RecordParts> read_record(std::string_view text, std::string_view title);

class RecordWords {
 public:
  explicit RecordWords(std::string_view text) : text_(text) {}

  template <class T>
  T number(int base = 10) {
    const std::string_view word = next();
    T value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
    require(end == word.data() + word.size() && error == std::errc());
    return value;
  }
  double real() {
    const std::string_view word = next();
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    require(end == word.data() + word.size() && error == std::errc() && std::isfinite(value));
    return value;
  }
  void expect(std::string_view word) { require(next() == word); }
  // Reads a name up to the end of the line, after one blank.
  std::string name();
  bool good() const { return good_; }
  bool at_end() const { return text_.find_first_not_of(" \n") == std::string_view::npos; }

 private:
  std::string_view next();
  void require(bool good) { good_ = good_ && good; }

  std::string_view text_;
  bool good_ = true;
};

}  // namespace passo
