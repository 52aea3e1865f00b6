// BlockParser: one line of text -> Block. About 100 ns for a short line. It allocates nothing after the first few
// lines.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/block.hpp"

namespace passo {

class BlockParser {
 public:
  // `file` names the program in diagnostics.
  BlockParser(std::string file, SymbolTable& symbols) : file_(std::move(file)), symbols_(symbols) {}

  // From now on N may stand anywhere in a line, as in grbl. In RS274/NGC it comes first.
  void accept_line_numbers_anywhere() { line_numbers_anywhere_ = true; }

  // Returns false when the line is wrong. `diagnostics` then tells what is wrong, and the block must not be used.
  [[nodiscard]] bool parse(std::string_view text, std::uint32_t line, Block& block, Diagnostics& diagnostics) const;

 private:
  std::string file_;
  SymbolTable& symbols_;
  bool line_numbers_anywhere_ = false;
};

// The block as G-code again, in canonical spelling: parse(print(b)) == b.
std::string print(const Block& block, const SymbolTable& symbols);

}  // namespace passo
