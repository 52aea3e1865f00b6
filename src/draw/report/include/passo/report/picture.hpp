// A picture of the path: an isometric view and a flat view side by side. Feed moves are coloured by actual speed, by
// depth, by tool, or by torque utilisation.
//
// Both formats show the same drawing. An SVG stays under 10 MB for any recording.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/path_recorder.hpp"

namespace passo {

enum class PictureFormat : std::uint8_t { svg, png };

// Returns the format for a file name that ends in ".svg" or ".png", in upper or lower case.
std::optional<PictureFormat> picture_format_of(std::string_view path);

enum class PathColour : std::uint8_t { speed, depth, tool, margin };

// The flat view. front: X to the right, Z up. side: Y to the right, Z up. lathe: Z to the right, X up. automatic: the
// top view; but front or side if nothing moves along Y or X (on a lathe: lathe).
enum class FlatView : std::uint8_t { automatic, top, front, side, lathe };

struct PictureOptions {
  PictureFormat format = PictureFormat::svg;
  std::string program;  // the title
  std::string machine;
  PathColour colour = PathColour::speed;
  FlatView view = FlatView::automatic;
  bool is_lathe = false;  // the machine has X and Z, and no Y
  bool rapids = true;     // false: only feed moves are drawn
  int width = 1600;
  int height = 900;
  int pixels_per_unit = 1;  // for PNG: 2 gives 3200 × 1800 pixels
};

// Draws into `file`; the caller commits it.
Status<OutputError> draw_picture(const PathRecorder& path, const PictureOptions& options, OutputFile& file);

// One of the two views with its legend, for a page that has its own title. `width` and `height` are those of the view.
enum class PictureView : std::uint8_t { isometric, flat };
Status<OutputError> draw_view(const PathRecorder& path, PictureView view, const PictureOptions& options,
                              OutputFile& file);

}  // namespace passo
