// Planner: segments -> phases. Look-ahead as far as braking needs, in bounded memory.
#pragma once

#include <memory>

#include "passo/base/source.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

struct MotionLimits {
  PerAxis<MmPerSecond> velocity;
  PerAxis<MmPerSecond2> acceleration;
};

class Planner final : public Source<MotionItem> {
 public:
  Planner(Source<PathItem>& path, const MotionLimits& limits);
  ~Planner() override;

  [[nodiscard]] bool next(MotionItem& item) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
