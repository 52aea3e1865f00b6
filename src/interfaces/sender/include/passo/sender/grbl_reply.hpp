// Parses the reports of a Grbl 1.1 machine, and the fields of its lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/geometry/axes.hpp"

namespace passo {

// In percent.
struct GrblOverrides {
  int feed = 100;
  int rapids = 100;
  int spindle = 100;
  friend bool operator==(const GrblOverrides&, const GrblOverrides&) = default;
};

// A status report: <Idle|MPos:0.000,0.000,0.000|Bf:15,128|FS:0,0|WCO:0.000,0.000,0.000|Pn:XP>
struct GrblReport {
  std::string state;                        // "Idle", "Run", "Hold", "Alarm" …
  int detail = -1;                          // for Hold and Door: 0 means stopped; for Alarm: its number
  std::optional<Point> machine_place = {};  // as reported: mm, or inches with $13=1
  std::optional<Point> work_place = {};     // work position, as reported
  std::optional<Point> work_offset = {};    // work offset, as reported
  std::size_t values = 0;                   // numbers in its position: one for each axis
  std::optional<std::size_t> blocks_free = {};
  std::optional<std::size_t> bytes_free = {};
  std::optional<double> feed = {};   // its speed now, as reported: mm/min, or inches/min with $13=1
  std::optional<double> speed = {};  // of the spindle, rpm, with its override
  std::string pins = {};             // letters of the triggered inputs
  // Grbl reports these two now and then, and at once after a change; empty: not in this report.
  std::optional<GrblOverrides> overrides = {};
  std::optional<std::string> outputs = {};  // letters of those that are on: S or C spindle, F flood, M mist
  std::optional<double> file_share = {};    // of a file on the board that it runs, 0 to 1

  // Returns whether nothing moves, and nothing will start moving by itself.
  bool rests() const;
};

// The axis letters in Grbl's report order, if the machine does not report them.
inline constexpr std::string_view grbl_axes = "XYZABCUVW";

// Empty if the line is not a report, or is incomplete.
std::optional<GrblReport> read_grbl_report(std::string_view line, std::string_view axes = grbl_axes);
// Returns whether a line is a report of Grbl before version 1.1: <Idle,MPos:0.000,0.000,0.000,WPos:…>
bool is_report_of_old_grbl(std::string_view line);

// Parses comma-separated numbers, one for each letter in `axes`; ignores those without a letter of an axis. Of an axis
// with two motors, which some firmwares report twice, the first counts. Empty if there are no numbers.
std::optional<Point> read_grbl_place(std::string_view text, std::string_view axes = grbl_axes);

// Empty if the text is not a number.
std::optional<double> read_grbl_number(std::string_view text);
// Removes and returns the text up to the next `mark`; also removes the mark.
std::string_view next_grbl_field(std::string_view& text, char mark);

}  // namespace passo
