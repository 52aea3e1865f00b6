// SpeedLimit: the acceleration limit of an axis at each speed, for the proof. It is a constant, or a table of the
// machine's own function with linear interpolation. Copies share the table. It shares no code with the planner's curve.
#pragma once

#include <memory>
#include <vector>

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class SpeedLimit {
 public:
  explicit SpeedLimit(const ProvenAxis& axis);

  bool falls() const { return table_ != nullptr; }
  double constant() const { return constant_; }  // 0: no limit
  double at(double speed) const;

 private:
  double constant_;
  double per_step_ = 0;                               // table entries for each mm/s
  std::shared_ptr<const std::vector<double>> table_;  // null: the limit is constant
};

// Those of all axes.
std::vector<SpeedLimit> speed_limits(const std::vector<ProvenAxis>& axes);

}  // namespace passo::proof
