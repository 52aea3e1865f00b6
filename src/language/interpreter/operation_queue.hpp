// OperationQueue: the operations that the executor has generated and that have not been pulled yet.
//
// A FIFO without heap allocation. Cutter compensation may *hold* it: later operations then stay in the queue until the
// end of the held move is known (release()). A few operations overtake the held ones (push_ahead()). The text of a line
// and its axis words are lost when the next line is read, so held operations get copies.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "passo/interpreter/operation.hpp"

namespace passo {

class OperationQueue {
 public:
  // The maximum number of operations of a block.
  static constexpr std::size_t most_of_a_block = 64;
  static constexpr std::size_t capacity = 256;  // a power of two
  static constexpr std::size_t most_held = capacity - most_of_a_block;

  // Returns true if no operation may be pulled.
  bool empty() const { return taken_ == ready_; }
  const Operation& front() const { return at(taken_); }
  void pop() {
    if (++taken_ == pushed_) taken_ = ready_ = pushed_ = 0;  // reuses the same few slots, which are in the cache
  }

  void push(const Operation& operation) {
    if (holding_) return push_held(operation);
    at(pushed_++) = operation;
    ready_ = pushed_;
  }
  // Pushes an operation before all held ones.
  void push_ahead(const Operation& operation);

  // Holds this operation and all later ones.
  void hold(const Operation& operation);
  bool holding() const { return holding_; }
  std::size_t held() const { return pushed_ - ready_; }
  Operation& held(std::size_t i) { return at(ready_ + i); }
  void release();
  // Returns whether the operations of another block fit.
  bool has_room() const { return pushed_ - taken_ <= most_held; }

 private:
  struct Texts {
    std::string line;
    std::string payload;  // text of a comment or similar operation
    AxisWords axis_words;
  };
  Operation& at(std::size_t i) { return operations_[i & (capacity - 1)]; }
  const Operation& at(std::size_t i) const { return operations_[i & (capacity - 1)]; }
  Texts& texts(std::size_t i) { return texts_[i & (capacity - 1)]; }
  void push_held(const Operation& operation);

  std::array<Operation, capacity> operations_{};
  std::vector<Texts> texts_;  // texts of the slots; allocated at the first hold
  std::size_t taken_ = 0;     // slot numbers increase without end; a mask gives the index
  std::size_t ready_ = 0;
  std::size_t pushed_ = 0;
  bool holding_ = false;
};

}  // namespace passo
