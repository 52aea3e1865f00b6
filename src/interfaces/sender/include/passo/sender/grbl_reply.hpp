// The reports of a machine that speaks Grbl 1.1, and the parts that its lines consist of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/geometry/axes.hpp"

namespace passo {

// A status report: <Idle|MPos:0.000,0.000,0.000|Bf:15,128|FS:0,0|WCO:0.000,0.000,0.000|Pn:XP>
struct GrblReport {
  std::string state;                        // "Idle", "Run", "Hold", "Alarm" …
  int detail = -1;                          // of Hold and Door: 0 is at rest; of Alarm: its number
  std::optional<Point> machine_place = {};  // as it is written: mm, or inches with $13=1
  std::optional<Point> work_place = {};     // the same
  std::optional<Point> work_offset = {};    // the same
  std::optional<std::size_t> blocks_free = {};
  std::optional<std::size_t> bytes_free = {};
  std::string pins = {};  // the letters of the closed inputs

  // Nothing moves, and nothing will by itself.
  bool rests() const;
};

// The letters of the axes in the order in which Grbl tells them, if it does not tell the letters.
inline constexpr std::string_view grbl_axes = "XYZABCUVW";

// Empty: the line is no report, or a broken one.
std::optional<GrblReport> read_grbl_report(std::string_view line, std::string_view axes = grbl_axes);
// Whether a line is a report as Grbl had them before 1.1: <Idle,MPos:0.000,0.000,0.000,WPos:…>
bool is_report_of_old_grbl(std::string_view line);

// Numbers between commas, one of each letter in `axes`. Only X, Y and Z count: a sender moves no other axis of such a
// machine. Empty: no numbers.
std::optional<Point> read_grbl_place(std::string_view text, std::string_view axes = grbl_axes);

// Empty: the text is no number.
std::optional<double> read_grbl_number(std::string_view text);
// Takes what comes before the next `mark`, and the mark.
std::string_view next_grbl_field(std::string_view& text, char mark);

}  // namespace passo
