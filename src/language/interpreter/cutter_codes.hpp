// CutterCodes: cutter compensation, G40 to G42.1, and the restrictions while it is on. CutterCompensation generates the
// offset moves.
#pragma once

#include "code_family.hpp"

namespace passo {

class CutterCodes : private CodeFamily {
 public:
  explicit CutterCodes(BlockContext& block) : CodeFamily(block) {}

  // Checks whether the block is possible with compensation, before any of it is executed.
  bool check();
  bool set(CodeNumber code);
  bool report(CutterFault fault, Span span);
  // Applies compensation to a move of a cycle. The move begins at the programmed position, which is then set to its
  // end.
  bool follow(const OperationKind& what);

 private:
  bool start(CodeNumber code);
  bool from_words(CodeNumber code, CutterSetup& setup);
  bool from_table(CutterSetup& setup);
};

}  // namespace passo
