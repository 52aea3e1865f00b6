// OperationQueue: the operations that the executor has made and the interpreter's reader has not taken yet.
//
// First in, first out, without a heap. Cutter compensation may *hold* it: what is pushed from then on stays, in its
// place, until it is known where the held moves end (release()). A few operations overtake what is held
// (push_ahead()). The text of a line and its axis words are gone when the next one is read, so what is held gets
// copies.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "passo/interpreter/operation.hpp"

namespace passo {

class OperationQueue {
 public:
  // No block pushes more than this.
  static constexpr std::size_t most_of_a_block = 64;
  static constexpr std::size_t capacity = 256;  // a power of two
  static constexpr std::size_t most_held = capacity - most_of_a_block;

  // True: nothing may be taken.
  bool empty() const { return taken_ == ready_; }
  const Operation& front() const { return at(taken_); }
  void pop() {
    if (++taken_ == pushed_) taken_ = ready_ = pushed_ = 0;  // the same few slots again, which are in the cache
  }

  void push(const Operation& operation) {
    if (holding_) return push_held(operation);
    at(pushed_++) = operation;
    ready_ = pushed_;
  }
  // Pushes before everything that is held.
  void push_ahead(const Operation& operation);

  // Holds this operation and all that follow.
  void hold(const Operation& operation);
  bool holding() const { return holding_; }
  std::size_t held() const { return pushed_ - ready_; }
  Operation& held(std::size_t i) { return at(ready_ + i); }
  void release();
  // True: the operations of another block fit.
  bool has_room() const { return pushed_ - taken_ <= most_held; }

 private:
  struct Texts {
    std::string line;
    std::string payload;  // of a comment and its like
    AxisWords axis_words;
  };
  Operation& at(std::size_t i) { return operations_[i & (capacity - 1)]; }
  const Operation& at(std::size_t i) const { return operations_[i & (capacity - 1)]; }
  Texts& texts(std::size_t i) { return texts_[i & (capacity - 1)]; }
  void push_held(const Operation& operation);

  std::array<Operation, capacity> operations_{};
  std::vector<Texts> texts_;  // of the slots; made when something is held for the first time
  std::size_t taken_ = 0;     // slots are numbered on and on; a mask gives their place
  std::size_t ready_ = 0;
  std::size_t pushed_ = 0;
  bool holding_ = false;
};

}  // namespace passo
