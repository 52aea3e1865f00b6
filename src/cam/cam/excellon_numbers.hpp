// ExcellonNumbers: interprets the digits of a drill file: their unit and the position of the decimal point. Private to
// cam/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/excellon.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The size of a tool that a comment states.
struct CommentedTool {
  std::int64_t number = 0;
  Mm diameter = Mm(0);
};

class ExcellonNumbers {
 public:
  // Examines the whole text for what its header does not state. Appends each guess to `notes`.
  ExcellonNumbers(std::string_view text, const ExcellonOptions& options, std::vector<std::string>& notes);

  // Reads a unit command, e.g. "METRIC,LZ,000.000", "INCH,TZ" or "M71,TZ". Returns false if the line is not a unit
  // command.
  bool read_units(std::string_view line);
  void use_inches(bool inches) { inch_ = known_.inch.value_or(inches); }

  // Reads a coordinate: sign, digits and an optional decimal point. Empty if it is not a number.
  std::optional<Mm> coordinate(std::string_view text) const;
  // Reads a comment such as Allegro's ";T01 Holesize 1. = 12.000000 Tolerance = +0.0/-0.0 PLATED MILS Quantity = 2".
  std::optional<CommentedTool> commented_tool(std::string_view comment) const;
  // Reads a diameter, which has a decimal point or is a whole number of units.
  std::optional<Mm> diameter(std::string_view text) const;

 private:
  struct Evidence {
    bool says_unit = false;
    bool comments_say_inch = false;  // a comment names the unit
    bool comments_say_mm = false;
    bool says_zeros = false;
    bool has_digits = false;      // true if some coordinate has no decimal point
    bool starts_with_0 = false;   // such a coordinate begins with 0, so leading zeros are kept
    bool ends_with_0 = false;     // such a coordinate ends with 0, so trailing zeros are kept
    double largest_tool = 0;      // maximum tool diameter, in the file's unit
    std::size_t most_digits = 0;  // maximum number of digits in a coordinate
  };
  Evidence scan_evidence(std::string_view text);
  static void scan_coordinates(std::string_view line, Evidence& evidence);
  // Reads a format stated in a comment: ";FORMAT={2:4/ absolute / inch / suppress leading zeros}".
  void read_comment(std::string_view comment, Evidence& evidence);
  void guess(const Evidence& evidence, std::vector<std::string>& notes);

  std::size_t whole_digits() const { return whole_digits_ != 0 ? whole_digits_ : (inch_ ? 2 : 3); }
  std::size_t decimals() const { return whole_digits_ != 0 ? decimals_ : (inch_ ? 4 : 3); }

  ExcellonOptions known_;  // given by the user; overrides the file
  bool inch_ = false;
  LeftOutZeros zeros_ = LeftOutZeros::leading;
  std::size_t whole_digits_ = 0;  // 0: the usual format of the unit, 3.3 mm or 2.4 inch
  std::size_t decimals_ = 0;
};

}  // namespace passo
