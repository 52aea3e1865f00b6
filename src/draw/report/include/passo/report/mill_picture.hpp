// A picture of a mill plan: the copper or the board, what each cutter mills, the rapids, and places to look at.
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
  const Region& face;                  // of the copper, or of the board
  std::string face_name = {};          // "Copper"
  const Region& warned;                // ground that stays though it should not
  std::vector<DrawnPoint> marks = {};  // a ring around each
  std::string mark_name = {};          // "Tab", "Gap"
  DrawnPoint park = {};                // where the rapids begin and end
  std::string warned_name = {};        // "Not reached"; empty: not in the legend
  std::optional<DrawnBox> sheet = {};  // the material
};

// Draws into `file`, which the caller commits.
Status<OutputError> draw_mill_plan(const MillScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
