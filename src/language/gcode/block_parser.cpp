#include "passo/gcode/block_parser.hpp"

#include "line_parser.hpp"

namespace passo {

bool BlockParser::parse(std::string_view text, std::uint32_t line, Block& block, Diagnostics& diagnostics) const {
  block.clear();
  block.line = line;
  block.text = text;
  LineFault fault;
  if (LineParser(text, block, symbols_, fault, line_numbers_anywhere_).parse()) return true;

  Diagnostic diagnostic;
  diagnostic.code = fault.code;
  diagnostic.file = file_;
  diagnostic.place = {line, static_cast<std::uint32_t>(fault.offset + 1), static_cast<std::uint32_t>(fault.length)};
  diagnostic.message = std::move(fault.message);
  diagnostic.expected = std::move(fault.expected);
  diagnostic.text = text;
  diagnostics.add(std::move(diagnostic));
  return false;
}

}  // namespace passo
