// Any bytes as a Gerber file: they are refused with places inside their lines, or the layer is within its limits, and
// its face is made of rings that enclose what they should.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "kit/require.hpp"

#include "passo/cam/gerber.hpp"

namespace passo {
namespace {

using test::require;

void check_within(DrawnPoint at) {
  const std::int64_t limit = farthest_of_region.count;
  require(std::abs(at.x.count) <= limit && std::abs(at.y.count) <= limit, "too far");
}

void check_layer(const GerberLayer& layer) {
  for (const DrawnRing& ring : layer.dark.rings) {
    require(ring.size() >= 3, "a ring of fewer than three points");
    for (const DrawnPoint& point : ring) check_within(point);
  }
  require(area_mm2(layer.dark) >= 0, "an area below 0");
  for (const GerberPad& pad : layer.pads) {
    require(pad.aperture < layer.apertures.size() && pad.net < layer.nets.size(), "a wrong pad");
  }
  require(layer.strokes.layers.size() == layer.apertures.size(), "a layer for each aperture");
  for (const DrawnPath& path : layer.strokes.paths) {
    require(path.points.size() >= 2 && path.layer < layer.strokes.layers.size(), "a wrong stroke");
    for (const PathPoint& point : path.points) require(std::isfinite(point.bulge), "a bulge that is not finite");
  }
}

void check_bytes(std::string_view bytes) {
  Diagnostics found;
  const GerberLayer layer = read_gerber("fuzz.gbr", bytes, found);
  for (const Diagnostic& finding : found.all()) {
    require(!finding.code.empty() && !finding.message.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
  check_layer(layer);
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::check_bytes({reinterpret_cast<const char*>(data), size});
  return 0;
}
