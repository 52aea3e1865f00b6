// Cycle: generates the operations of one block with a canned cycle: holes, passes of a thread, cuts of a lathe.
//
// A cycle is created from a plain struct with all its data (DrillingPlan, ThreadingPlan, LathePlan), independent of
// words and modal state. Memory is bounded, however long the cycle is: a cycle generates one step at a time (a hole, a
// peck or a pass), of at most `longest_step` operations.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

#include "passo/base/source.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/probe_outcome.hpp"

namespace passo {

class Cycle : public Source<Operation> {
 public:
  [[nodiscard]] bool next(Operation& operation) final {
    while (given_ == count_) {
      if (done_ || awaits()) return false;
      given_ = count_ = 0;
      done_ = !step();
    }
    operation.what = operations_[given_++];
    operation.source = source_;
    operation.file = operation.text = {};
    return true;
  }
  // Returns the tool position after the step of the last returned operation, in work coordinates.
  const Point& position() const { return position_; }
  // Whether the next step depends on the outcome of a probe move, so that next() returns false until apply().
  // `outcome`: null: it is unknown, as in a check.
  virtual bool awaits() const { return false; }
  virtual void apply(const ProbeOutcome* /*outcome*/) {}

 protected:
  static constexpr std::size_t longest_step = 20;
  Cycle(const Point& start, const OperationSource& source) : source_(source), position_(start) {}

  // Generates the operations of the next step. Returns false if there are no more steps.
  virtual bool step() = 0;

  void emit(const OperationKind& operation) {
    assert(count_ < longest_step);
    operations_[count_++] = operation;
  }
  void traverse(const Point& end) { emit(operation::StraightTraverse{position_ = end}); }
  void feed(const Point& end) { emit(operation::StraightFeed{position_ = end}); }

  OperationSource source_;
  Point position_;

 private:
  std::array<OperationKind, longest_step> operations_;
  std::size_t count_ = 0;
  std::size_t given_ = 0;
  bool done_ = false;
};

}  // namespace passo
