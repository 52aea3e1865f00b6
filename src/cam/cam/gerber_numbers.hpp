// GerberNumbers: what the digits of a Gerber file mean: their unit, and where the decimal point is. Private to cam/.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "passo/cam/drawing.hpp"
#include "passo/cam/excellon.hpp"

namespace passo {

// FS, the format of coordinates: "LAX24Y24".
struct GerberFormat {
  LeftOutZeros left_out = LeftOutZeros::leading;
  bool is_incremental = false;
  std::size_t whole_x = 2;
  std::size_t decimals_x = 4;
  std::size_t whole_y = 2;
  std::size_t decimals_y = 4;
};

// What stands behind FS. Empty: it is no format.
std::optional<GerberFormat> read_gerber_format(std::string_view words);

// A decimal number. Empty: it is none.
std::optional<double> read_gerber_decimal(std::string_view text);

class GerberNumbers {
 public:
  GerberFormat format;
  bool is_inch = true;

  // Sign and digits; a decimal point is read too, though the format has none. Empty: no number, or farther than
  // farthest_drawn.
  std::optional<Nanometres> x(std::string_view text) const {
    return coordinate(text, format.whole_x, format.decimals_x);
  }
  std::optional<Nanometres> y(std::string_view text) const {
    return coordinate(text, format.whole_y, format.decimals_y);
  }
  // A decimal number of units, as a diameter. Empty as above.
  std::optional<Nanometres> length(std::string_view text) const;

  double nm_per_unit() const { return is_inch ? 25.4e6 : 1e6; }

 private:
  std::optional<Nanometres> coordinate(std::string_view text, std::size_t whole, std::size_t decimals) const;
};

}  // namespace passo
