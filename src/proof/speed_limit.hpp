// SpeedLimit: the acceleration that an axis may have at a speed, as the proof reads it: the constant, or a table of the
// machine's own function with straight lines between its points. It knows nothing of the planner's curve.
#pragma once

#include <vector>

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class SpeedLimit {
 public:
  explicit SpeedLimit(const ProvenAxis& axis);

  bool falls() const { return !table_.empty(); }
  double constant() const { return constant_; }  // 0: there is none
  double at(double speed) const;

 private:
  double constant_;
  double step_ = 0;  // of the speed, from one value of the table to the next
  std::vector<double> table_;
};

}  // namespace passo::proof
