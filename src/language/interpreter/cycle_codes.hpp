// CycleCodes: a family whose codes start a Cycle. BlockExecutor pulls the cycle's operations. The rest of the block
// waits until the cycle has given all of them.
#pragma once

#include "code_family.hpp"
#include "cycle.hpp"

namespace passo {

class CycleCodes : protected CodeFamily {
 public:
  // The cycle that was started last.
  virtual Cycle& cycle() = 0;
  // Called when the cycle has given its last operation. False: the cycle broke off, which is reported.
  virtual bool finish() { return true; }

 protected:
  explicit CycleCodes(BlockContext& block) : CodeFamily(block) {}
  ~CycleCodes() = default;

  // Checks that the cycle can feed: in units a minute or a revolution, along the programmed path.
  bool check_cycle(std::string_view name);
  bool check_uncompensated(std::string_view name);
  bool check_no_inverse_time(std::string_view name);
};

}  // namespace passo
