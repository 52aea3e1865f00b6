// CutterCodes: cutter compensation, G40 to G42.1, and what cannot be done while it is on. The moves beside the contour
// are made by CutterCompensation.
#pragma once

#include "code_family.hpp"

namespace passo {

class CutterCodes : private CodeFamily {
 public:
  explicit CutterCodes(BlockContext& block) : CodeFamily(block) {}

  // Checks that the block is possible with compensation, before anything of the block is done.
  bool check();
  bool set(CodeNumber code);
  bool report(CutterFault fault, Span span);
  // Leads the tool beside a move of a cycle. The move begins at the programmed position, which goes on to its end.
  bool follow(const OperationKind& what);

 private:
  bool start(CodeNumber code);
  bool from_words(CodeNumber code, CutterSetup& setup);
  bool from_table(CutterSetup& setup);
};

}  // namespace passo
