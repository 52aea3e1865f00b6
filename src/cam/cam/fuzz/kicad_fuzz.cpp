// Any bytes as a board of KiCad: they are refused with places inside their lines, or each layer and the drills are
// within their limits.
#include <cstdint>
#include <string_view>

#include "layer_checks.hpp"

#include "passo/cam/kicad_board.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::Diagnostics found;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const passo::DesignBoard board = passo::read_kicad_board("fuzz.kicad_pcb", bytes, found);
  passo::test::check_findings(found);
  passo::test::check_board(board);
  return 0;
}
