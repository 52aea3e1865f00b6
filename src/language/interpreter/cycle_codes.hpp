// CycleCodes: a family whose codes start a Cycle. BlockExecutor pulls the cycle's operations. The rest of the block
// waits until all of them were pulled.
#pragma once

#include "code_family.hpp"
#include "cycle.hpp"

namespace passo {

class CycleCodes : protected CodeFamily {
 public:
  // Returns the cycle that was started last.
  virtual Cycle& cycle() = 0;
  // Called after the cycle's last operation. Returns false if the cycle was aborted, which has been reported.
  virtual bool finish() { return true; }

 protected:
  explicit CycleCodes(BlockContext& block) : CodeFamily(block) {}
  ~CycleCodes() = default;

  // Checks that the cycle can feed: in units per minute or per revolution, along the programmed path.
  bool check_cycle(std::string_view name);
  bool check_uncompensated(std::string_view name);
  bool check_no_inverse_time(std::string_view name);
};

}  // namespace passo
