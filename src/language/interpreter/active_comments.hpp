// ActiveComments: executes the comments of a block that have an effect: (MSG,…), (DEBUG,…), (PRINT,…), (LOG,…),
// (ABORT,…).
#pragma once

#include <string>

#include "code_family.hpp"

#include "passo/gcode/block.hpp"
#include "passo/gcode/symbols.hpp"

namespace passo {

class ActiveComments : private CodeFamily {
 public:
  ActiveComments(BlockContext& block, SymbolTable& symbols) : CodeFamily(block), symbols_(symbols) {}

  bool obey(const Block& block);

 private:
  bool obey(const BlockComment& comment);

  SymbolTable& symbols_;
  std::string text_;  // text of the comment with the parameters filled in
};

}  // namespace passo
