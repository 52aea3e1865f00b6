// Any bytes as a font of outlines and as one of single lines: they are refused, or the letters are a drawing within its
// limits.
#include <cstdint>
#include <string_view>

#include "drawing_checks.hpp"
#include "layer_checks.hpp"

#include "passo/cam/lettering.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const passo::Lettering lettering{.text = "A\u00c4b fi\n\u0644\u0645"};
  passo::Diagnostics findings;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const passo::Drawing drawing = passo::letter(lettering, "font", bytes, findings);
  passo::test::check_findings(findings);
  passo::test::check_drawing(drawing);
  return 0;
}
