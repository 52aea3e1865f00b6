// Functions shared by the commands that cut parts from drawings: profile, pocket and engrave.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cam_job.hpp"
#include <nlohmann/json.hpp>

#include "passo/cam/profile.hpp"

namespace passo {

// The lines of a command's files, in program coordinates.
struct PartDrawing {
  EdgeLoops loops;
  DrawnPoint least;  // lower left and upper right corner of the bounding box
  DrawnPoint most;
};

// Reads the files as one drawing. Returns nothing after errors, which it shows.
std::optional<Drawing> read_drawings(const CamMillArguments& arguments, const MillJob& job);
// Returns the drawing's lines, mirrored and moved as the job requires. Where open lines are kept, dots are open lines
// of one point: points without a diameter, and lines without a length. Elsewhere a note counts the points. Returns
// nothing after errors, which it shows.
std::optional<PartDrawing> part_of(Drawing drawing, const MillJob& job, Nanometres join, OpenRows open_rows);

// Checks that what is drawn lies on the sheet of material. Reports an error "profile.off-sheet" about `file`.
void check_sheet(const DrawnBox& sheet, const DrawnBox& box, const std::string& file, Diagnostics& findings);

// Converts --side.
ProfileSide side_of(const std::string& side);

// Returns one line, e.g. "drawn: X 0 to 10, Y 0 to 5 mm".
std::string size_words(const PartDrawing& part);

// Returns the numbers of open lines and dots, e.g. "2 open lines, 1 dot".
std::string open_lines(const ProfilePlan& plan);

// The results of a command, for the program, the picture and the summary.
struct PartResult {
  const MillPlan& mill;
  const Region& face;
  const Region& unreached;
  const std::vector<DrawnPoint>& tabs;
  std::string words;
  nlohmann::ordered_json json;            // null: for all but the last of several programs, whose summary is of all
  std::optional<Nanometres> offcut = {};  // X from which the sheet stays whole
};
// Writes and prints everything. Returns an exit code.
int deliver(const CamMillArguments& arguments, const MillJob& job, const PartResult& result,
            const WorkProgress& progress);

}  // namespace passo
