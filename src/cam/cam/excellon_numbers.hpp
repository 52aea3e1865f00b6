// ExcellonNumbers: what the digits of a drill file mean: their unit, and where the decimal point is. Private to cam/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/excellon.hpp"
#include "passo/units/units.hpp"

namespace passo {

class ExcellonNumbers {
 public:
  // Looks at the whole text for what its header does not say. `notes` gets what was guessed.
  ExcellonNumbers(std::string_view text, const ExcellonOptions& options, std::vector<std::string>& notes);

  // "METRIC,LZ,000.000" or "INCH,TZ". False: the line is none of these.
  bool read_units(std::string_view line);
  void use_inches(bool inches) { inch_ = known_.inch.value_or(inches); }

  // Sign, digits and perhaps a decimal point. Empty: it is no number.
  std::optional<Mm> coordinate(std::string_view text) const;
  // A diameter always has its decimal point, or is a whole number of units.
  std::optional<Mm> diameter(std::string_view text) const;

 private:
  struct Evidence {
    bool says_unit = false;
    bool says_zeros = false;
    bool has_digits = false;      // a coordinate without a decimal point
    bool starts_with_0 = false;   // such a coordinate begins with 0, so leading zeros are kept
    bool ends_with_0 = false;     // such a coordinate ends with 0, so trailing zeros are kept
    double largest_tool = 0;      // diameter in the file's unit
    std::size_t most_digits = 0;  // in one coordinate
  };
  Evidence scan_evidence(std::string_view text);
  static void scan_coordinates(std::string_view line, Evidence& evidence);
  // A format that is stated in a comment: ";FORMAT={2:4/ absolute / inch / suppress leading zeros}".
  void read_comment(std::string_view comment, Evidence& evidence);
  void guess(const Evidence& evidence, std::vector<std::string>& notes);

  std::size_t whole_digits() const { return whole_digits_ != 0 ? whole_digits_ : (inch_ ? 2 : 3); }
  std::size_t decimals() const { return whole_digits_ != 0 ? decimals_ : (inch_ ? 4 : 3); }

  ExcellonOptions known_;  // by the user: stronger than the file
  bool inch_ = false;
  LeftOutZeros zeros_ = LeftOutZeros::leading;
  std::size_t whole_digits_ = 0;  // 0: the usual format of the unit, 3.3 mm or 2.4 inch
  std::size_t decimals_ = 0;
};

}  // namespace passo
