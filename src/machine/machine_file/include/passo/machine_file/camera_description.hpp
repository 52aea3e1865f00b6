// CameraDescription: the table [camera] of a machine file: a camera that moves with the spindle and looks at the work.
//
// It is not a part of MachineDescription, because no stage of the pipeline needs it: only `passo serve` shows its
// picture.
#pragma once

#include <optional>
#include <string_view>

#include "passo/base/http_url.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct CameraDescription {
  HttpUrl stream;                        // MJPEG: multipart/x-mixed-replace, or a JPEG that is fetched again and again
  std::optional<HttpUrl> snapshot = {};  // a single JPEG; empty: a picture of the stream is taken instead
  // From the spindle's axis to the point under the cross-hair, in the directions of the machine's axes.
  Mm offset_x{0};
  Mm offset_y{0};
  int rotation = 0;          // of the picture for display, clockwise: 0, 90, 180 or 270 degrees
  bool is_mirrored = false;  // left and right are exchanged, before the rotation
};

// Returns the camera of the text of a machine file that parse_machine() accepts. Empty: the machine has none.
std::optional<CameraDescription> parse_camera(std::string_view machine_file);

// Returns the tool's position at which the tool is over the point that is now under the cross-hair; Z and the other
// axes are as in `tool`.
Point under_cross_hair(const CameraDescription& camera, const Point& tool);

}  // namespace passo
