// Any bytes as an SVG drawing, as an airfoil and as an HPGL plot: they are rejected, or the drawing is within its
// limits.
#include <cstdint>
#include <string_view>

#include "drawing_checks.hpp"
#include "layer_checks.hpp"

#include "passo/cam/airfoil.hpp"
#include "passo/cam/hpgl.hpp"
#include "passo/cam/svg.hpp"

namespace {

void check_bytes(std::string_view bytes) {
  if (passo::looks_like_svg(bytes)) {
    passo::Diagnostics of_svg;
    const passo::Drawing svg = passo::read_svg("fuzz.svg", bytes, {}, of_svg);
    passo::test::check_findings(of_svg);
    passo::test::check_drawing(svg);
    return;
  }
  if (passo::looks_like_airfoil(bytes)) {
    passo::Diagnostics of_airfoil;
    const passo::Drawing section = passo::read_airfoil("fuzz.dat", bytes, passo::Mm(200), of_airfoil);
    passo::test::check_findings(of_airfoil);
    passo::test::check_drawing(section);
  }
  passo::Diagnostics of_plot;
  const passo::Drawing plot = passo::read_hpgl("fuzz.plt", bytes, {}, of_plot);
  passo::test::check_findings(of_plot);
  passo::test::check_drawing(plot);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_bytes({reinterpret_cast<const char*>(data), size});
  return 0;
}
