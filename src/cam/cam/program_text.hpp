// ProgramText: G-code as text, line by line, with lengths in the program's units. Private to cam/.
#pragma once

#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/cam/drawing.hpp"
#include "passo/cam/program_units.hpp"

namespace passo {

class ProgramText {
 public:
  explicit ProgramText(ProgramUnits units) : units_(units) {}

  template <class... T>
  void line(fmt::format_string<T...> words, T&&... values) {
    fmt::format_to(std::back_inserter(text_), words, std::forward<T>(values)...);
    text_ += '\n';
  }
  // Plane, units, and no compensation or cycle of an earlier program; for centimetres a comment.
  void begin_modes();

  // The tool is named and changed, where there are several, and the spindle turns.
  struct ToolChange {
    std::size_t number = 1;  // from 1
    bool is_only = false;    // there is no other tool
    std::string words = {};  // for the operator
    std::optional<std::uint32_t> spindle = {};
    DrawnPoint park = {};
    Nanometres clearance = {};
  };
  void begin_tool(const ToolChange& change);
  // The last tool goes to the park place.
  void end(bool has_spindle, DrawnPoint park);

  // A length in the program's units, without zeros at its end.
  std::string number(Nanometres length) const;
  // "X1.5 Y2".
  std::string place(DrawnPoint at) const { return "X" + number(at.x) + " Y" + number(at.y); }
  const char* unit_name() const {
    return units_ == ProgramUnits::mm ? "mm" : units_ == ProgramUnits::cm ? "cm" : "inch";
  }
  std::string take() { return std::move(text_); }

 private:
  ProgramUnits units_;
  std::string text_;
};

// Text that may stand in a comment of G-code.
std::string in_comment(std::string_view text);

}  // namespace passo
