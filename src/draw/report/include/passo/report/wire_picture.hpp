// A picture of a wire cut: both faces of the block, what stays there, what the wire melts, and where its ends go.
#pragma once

#include <optional>

#include "passo/cam/wire_cut.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct WireScene {
  const WirePlan& plan;
  std::optional<DrawnBox> block = {};  // a face of it
  bool has_four_axes = true;
};

// Draws into `file`, which the caller commits.
Status<OutputError> draw_wire_cut(const WireScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
