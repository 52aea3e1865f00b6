// ThreadingCodes: the words of the threading cycle G76. ThreadingCycle generates the passes.
#pragma once

#include <optional>

#include "cycle_codes.hpp"
#include "threading_cycle.hpp"

namespace passo {

class ThreadingCodes final : public CycleCodes {
 public:
  explicit ThreadingCodes(BlockContext& block) : CycleCodes(block) {}

  bool start();
  Cycle& cycle() override { return *cycle_; }

 private:
  bool check();
  bool check_words();
  bool check_thread(const ThreadingPlan& plan);

  std::optional<ThreadingCycle> cycle_;
};

}  // namespace passo
