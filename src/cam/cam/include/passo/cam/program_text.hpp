// ProgramText: writes G-code line by line, with lengths in the program's units.
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
#include "passo/cam/safe_change.hpp"

namespace passo {

class ProgramText {
 public:
  explicit ProgramText(ProgramUnits units) : units_(units) {}

  template <class... T>
  void line(fmt::format_string<T...> words, T&&... values) {
    fmt::format_to(std::back_inserter(text_), words, std::forward<T>(values)...);
    text_ += '\n';
  }
  // Sets the plane and the units, and cancels compensation and cycles of an earlier program; for centimetres adds a
  // comment.
  void begin_modes();

  // Rises to the change height. Names and changes the tool there, if there are several, and starts the spindle.
  struct ToolChange {
    std::size_t number = 1;  // tool number, from 1
    bool is_only = false;    // whether this is the only tool
    std::string words = {};  // tool name for the operator
    std::optional<std::uint32_t> spindle = {};
    std::optional<DrawnPoint> park = {};  // empty: the tool is changed where it is
    SafeChange change = {};
  };
  void begin_tool(const ToolChange& change);
  // Moves the last tool up, switches coolant and spindle off, then moves to the park position, if there is one, and
  // ends the program. `height`: without a Z axis, none.
  void end(bool has_spindle, std::optional<DrawnPoint> park, std::optional<Nanometres> height);

  // Formats a length in the program's units, without trailing zeros.
  std::string number(Nanometres length) const;
  // Formats a position: "X1.5 Y2".
  std::string place(DrawnPoint at) const { return "X" + number(at.x) + " Y" + number(at.y); }
  const char* unit_name() const {
    return units_ == ProgramUnits::mm ? "mm" : units_ == ProgramUnits::cm ? "cm" : "inch";
  }
  std::string take() { return std::move(text_); }

 private:
  void stop_coolant();

  ProgramUnits units_;
  bool has_coolant_ = false;
  std::string text_;
};

// Makes a text safe for use in a G-code comment.
std::string in_comment(std::string_view text);

}  // namespace passo
