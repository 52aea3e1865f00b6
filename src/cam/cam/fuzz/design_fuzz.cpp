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
  for (const passo::DesignLayer& one : board.copper) passo::test::check_layer(one.layer);
  passo::test::check_layer(board.edge);
  for (const passo::DrawnHole& hole : board.drills.holes) {
    passo::test::check_within(hole.at);
    passo::test::require(hole.diameter.count > 0 && hole.layer < 2, "a wrong hole");
  }
  return 0;
}
