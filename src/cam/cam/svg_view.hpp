// SvgView: a rectangle in which an SVG drawing, or a part of it, is drawn. Private to cam/.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "dxf_transform.hpp"

namespace passo {

struct SvgView {
  double width = 0;  // pixels; what 100 % is
  double height = 0;
};

// Returns the transform from a view box to a view of this size. `aspect`: preserveAspectRatio.
inline DxfTransform into_viewport(const std::array<double, 4>& box, const SvgView& port, std::string_view aspect) {
  double sx = port.width / box[2];
  double sy = port.height / box[3];
  double dx = 0;
  double dy = 0;
  if (!aspect.starts_with("none")) {
    const bool slices = aspect.find("slice") != std::string_view::npos;
    const double s = slices ? std::max(sx, sy) : std::min(sx, sy);
    const auto share = [&](const char* least, const char* most) {
      return aspect.find(least) != std::string_view::npos  ? 0.0
             : aspect.find(most) != std::string_view::npos ? 1.0
                                                           : 0.5;
    };
    sx = sy = s;
    dx = (port.width - s * box[2]) * share("xMin", "xMax");
    dy = (port.height - s * box[3]) * share("YMin", "YMax");
  }
  return {.xx = sx, .yy = sy, .dx = dx - sx * box[0], .dy = dy - sy * box[1]};
}

}  // namespace passo
