// Framing: a small program that shows where a job lies: it moves around the job's extents, or around their convex hull,
// at a height above the work. The spindle stays off.
//
// The program rises to the clearance height first (it never lowers the tool before it moves sideways), moves to the
// first corner, goes to the height, follows the outline at a feed rate, and rises again. Like a probing cycle it is
// G-code in LinuxCNC's dialect, in machine coordinates, and is checked and run like any other program.
//
// Lengths are millimetres, speeds mm/min.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "passo/activity/job_outline.hpp"
#include "passo/base/result.hpp"
#include "passo/base/sentence.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

struct Framing {
  static constexpr double usual_feed = 2000;

  bool hull = false;                     // the convex hull; otherwise the rectangle of the extents
  std::optional<double> height = {};     // work Z of the moves around the job; empty: the clearance height
  std::optional<double> clearance = {};  // work Z of the moves there and back; empty: the highest Z of the job
  std::optional<double> feed = {};       // empty: usual_feed
};

// A number of a framing, for command lines, APIs and their checks.
struct FramingField {
  std::string_view name;
  std::optional<double> Framing::*value = nullptr;
  double low = 0;
  double high = 0;
  std::string_view words = {};
};
std::span<const FramingField> framing_fields();

// Returns the program. `job`: the name of the framed program, for a comment. The error tells why it cannot run: a value
// out of its range, a program without feed moves, a machine without X and Y, or a height outside the travel.
Result<std::string, Sentence> framing_program(const JobOutline& outline, const Framing& framing,
                                              const MachineDescription& machine, std::string_view job);

}  // namespace passo
