// A picture of a mill plan: the copper or the board, the area milled by each cutter, the rapids, and points to inspect.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct MillScene {
  const MillPlan& plan;
  const Region& face;                     // the copper, or the board
  std::string face_name = {};             // "Copper"
  const Region& warned;                   // remaining material that should have been milled
  std::vector<DrawnPoint> marks = {};     // points to be marked by a ring
  std::string mark_name = {};             // "Tab", "Gap"
  DrawnPoint park = {};                   // where the rapids begin and end
  std::string warned_name = {};           // "Not reached"; empty: omitted from the legend
  std::optional<DrawnBox> sheet = {};     // the sheet of material
  std::optional<Nanometres> offcut = {};  // X from which the sheet stays whole
};

// Draws into `file`; the caller commits it.
Status<OutputError> draw_mill_plan(const MillScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
