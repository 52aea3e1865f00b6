// What a Grbl 1.1 machine says, line by line.
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
  int detail = -1;                          // of Hold and Door: 0 is at rest
  std::optional<Point> machine_place = {};  // as it is written: mm, or inches with $13=1
  std::optional<Point> work_place = {};     // the same
  std::optional<Point> work_offset = {};    // the same
  std::optional<std::size_t> blocks_free = {};
  std::optional<std::size_t> bytes_free = {};
  std::string pins = {};  // the letters of the closed inputs

  bool rests() const { return state == "Idle" || (state == "Hold" && detail == 0); }
};

// Empty: the line is no report, or a broken one.
std::optional<GrblReport> read_grbl_report(std::string_view line);

// Numbers between commas, as many as there are axes. Empty: no numbers.
std::optional<Point> read_grbl_place(std::string_view text);

// The meaning of error:n and of ALARM:n, as a clause.
std::string_view words_of_grbl_error(int number);
std::string_view words_of_grbl_alarm(int number);

}  // namespace passo
