// GerberNumbers: interprets the digits of a Gerber file: their unit and the position of the decimal point. Private to
// cam/.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "passo/cam/drawing.hpp"
#include "passo/cam/excellon.hpp"

namespace passo {

// The coordinate format from FS: "LAX24Y24".
struct GerberFormat {
  LeftOutZeros left_out = LeftOutZeros::leading;
  bool is_incremental = false;
  std::size_t whole_x = 2;
  std::size_t decimals_x = 4;
  std::size_t whole_y = 2;
  std::size_t decimals_y = 4;
};

// Reads the text after FS. Empty if it is not a valid format.
std::optional<GerberFormat> read_gerber_format(std::string_view words);

// Reads a decimal number. Empty if it is not one.
std::optional<double> read_gerber_decimal(std::string_view text);

class GerberNumbers {
 public:
  GerberFormat format;
  bool is_inch = true;

  // Reads a coordinate: sign and digits; also accepts a decimal point, although the format has none. Empty if it is not
  // a number, or exceeds farthest_drawn.
  std::optional<Nanometres> x(std::string_view text) const {
    return coordinate(text, format.whole_x, format.decimals_x);
  }
  std::optional<Nanometres> y(std::string_view text) const {
    return coordinate(text, format.whole_y, format.decimals_y);
  }
  // Reads a decimal number of units, such as a diameter. Empty in the same cases.
  std::optional<Nanometres> length(std::string_view text) const;

  double nm_per_unit() const { return is_inch ? 25.4e6 : 1e6; }

 private:
  std::optional<Nanometres> coordinate(std::string_view text, std::size_t whole, std::size_t decimals) const;
};

}  // namespace passo
