#include "passo/cam/design_board.hpp"

#include "design_readers.hpp"

#include "passo/cam/kicad_board.hpp"

namespace passo {

bool looks_like_design_board(std::string_view text) {
  return looks_like_kicad_board(text) || looks_like_eagle_board(text) || looks_like_easyeda_board(text);
}

DesignBoard read_design_board(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  if (looks_like_eagle_board(text)) return read_eagle_board(name, text, diagnostics);
  if (looks_like_easyeda_board(text)) return read_easyeda_board(name, text, diagnostics);
  return read_kicad_board(name, text, diagnostics);
}

}  // namespace passo
