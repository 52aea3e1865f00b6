// Any bytes as a Gerber file: they are refused with places inside their lines, or the layer is within its limits, and
// its face is made of rings that enclose what they should.
#include <cstdint>
#include <string_view>

#include "layer_checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::Diagnostics found;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  constexpr std::size_t few = passo::most_gerber_points / 500;
  const passo::GerberLayer layer = passo::read_gerber("fuzz.gbr", bytes, found, few);
  passo::test::check_findings(found);
  passo::test::check_layer(layer);
  return 0;
}
