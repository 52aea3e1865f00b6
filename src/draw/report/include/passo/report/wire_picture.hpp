// A picture of a wire cut: both faces of the block, the remaining foam, the melted area, and the paths of the wire's
// ends.
#pragma once

#include <optional>

#include "passo/cam/wire_cut.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct WireScene {
  const WirePlan& plan;
  std::optional<DrawnBox> block = {};  // one face of the block
  bool has_four_axes = true;
};

// Draws into `file`; the caller commits it.
Status<OutputError> draw_wire_cut(const WireScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
