// What the commands that cut parts from drawings have in common: profile, pocket and engrave.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cam_job.hpp"

namespace passo {

// The lines of a command's files, where the program has them.
struct PartDrawing {
  EdgeLoops loops;
  DrawnPoint least;  // corners of the box around them
  DrawnPoint most;
};

// The files as one drawing. Findings are shown; then the answer is empty.
std::optional<Drawing> read_drawings(const CamMillArguments& arguments, const MillJob& job);
// The drawing's lines, turned over and moved as the job asks. Findings are shown; then the answer is empty.
std::optional<PartDrawing> part_of(Drawing drawing, const MillJob& job, Nanometres join, OpenRows open_rows);

// "drawn: X 0 to 10, Y 0 to 5 mm", a line.
std::string size_words(const PartDrawing& part);

// What a command has made, for the program, the picture and the summary.
struct PartResult {
  const MillPlan& mill;
  const Region& face;
  const Region& unreached;
  const std::vector<DrawnPoint>& tabs;
  std::string words;
  std::string json;
};
// Writes and prints it all. Returns an exit code.
int deliver(const CamMillArguments& arguments, const MillJob& job, const PartResult& result,
            const WorkProgress& progress);

}  // namespace passo
