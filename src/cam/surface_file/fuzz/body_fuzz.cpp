// Any bytes as a body or a height map: they are refused with a reason, or all places are within bounds.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "kit/require.hpp"

#include "passo/surface_file/surface_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace passo;
  Diagnostics findings;
  const Surface body = read_surface("it", {reinterpret_cast<const char*>(data), size}, findings);
  test::require((body.triangles() == 0) == findings.any_error(), "neither read nor refused");
  if (body.triangles() == 0) return 0;
  const SurfacePoint low = body.low();
  const SurfacePoint high = body.high();
  test::require(std::isfinite(low.x + low.y + low.z + high.x + high.y + high.z), "no number");
  const double top = body.top((low.x + high.x) / 2, (low.y + high.y) / 2);
  test::require(top == Surface::nothing ||
                    (top >= low.z - 1e-6 * (1 + std::abs(low.z)) && top <= high.z + 1e-6 * (1 + std::abs(high.z))),
                "a place above or below the body");
  return 0;
}
