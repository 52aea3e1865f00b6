// CycleCodes: a family whose codes start a Cycle. BlockExecutor pulls the cycle's operations; what follows in the block
// waits until it has given all.
#pragma once

#include "code_family.hpp"
#include "cycle.hpp"

namespace passo {

class CycleCodes : protected CodeFamily {
 public:
  // The one that was started last.
  virtual Cycle& cycle() = 0;
  // It has given its last operation. False: it broke off, which is reported.
  virtual bool finish() { return true; }

 protected:
  explicit CycleCodes(BlockContext& block) : CodeFamily(block) {}
  ~CycleCodes() = default;

  // A cycle feeds at units a minute or a revolution, along the programmed path.
  bool check_cycle(std::string_view name);
  bool check_uncompensated(std::string_view name);
};

}  // namespace passo
