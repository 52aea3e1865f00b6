// SpindleCodes: the codes and words of spindles: S, M3, M4, M5, M19, G96, G97. `$` selects the spindle.
#pragma once

#include "code_family.hpp"

namespace passo {

class SpindleCodes : private CodeFamily {
 public:
  explicit SpindleCodes(BlockContext& block) : CodeFamily(block) {}

  bool set_mode(CodeNumber code);
  bool set_speed();
  bool turn(CodeNumber code);
  bool orient();
  void stop();  // Stops all spindles.
};

}  // namespace passo
