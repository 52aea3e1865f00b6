// Any bytes as a board of EAGLE or EasyEDA: they are rejected with a position inside a line, or each layer and the
// drills are within their limits.
#include <cstdint>
#include <string_view>

#include "layer_checks.hpp"

#include "passo/cam/design_board.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::Diagnostics found;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!passo::looks_like_design_board(bytes)) return 0;
  const passo::DesignBoard board = passo::read_design_board("fuzz.brd", bytes, found);
  passo::test::check_findings(found);
  passo::test::check_board(board);
  return 0;
}
