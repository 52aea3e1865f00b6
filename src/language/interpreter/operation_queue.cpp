#include "operation_queue.hpp"

#include <utility>
#include <variant>

namespace passo {
namespace {

// The text that an operation borrows, if it is of a kind that does.
std::string_view* borrowed_text(Operation& operation) {
  return std::visit(
      [](auto& what) -> std::string_view* {
        if constexpr (requires { what.text; }) {
          return &what.text;
        } else {
          return nullptr;
        }
      },
      operation.what);
}

}  // namespace

void OperationQueue::hold(const Operation& operation) {
  holding_ = true;
  if (texts_.empty()) texts_.resize(capacity);
  push_held(operation);
}

void OperationQueue::push_held(const Operation& operation) {
  Operation& kept = at(pushed_) = operation;
  Texts& copies = texts(pushed_++);
  copies.line.assign(operation.text);
  copies.axis_words = operation.axis_words == nullptr ? AxisWords{} : *operation.axis_words;
  if (const std::string_view* const payload = borrowed_text(kept)) copies.payload.assign(*payload);
}

void OperationQueue::push_ahead(const Operation& operation) {
  if (!holding_) return push(operation);
  for (std::size_t i = pushed_++; i > ready_; --i) {
    at(i) = at(i - 1);
    std::swap(texts(i), texts(i - 1));
  }
  at(ready_++) = operation;
}

void OperationQueue::release() {
  for (; ready_ != pushed_; ++ready_) {
    Operation& operation = at(ready_);
    operation.text = texts(ready_).line;
    operation.axis_words = &texts(ready_).axis_words;
    if (std::string_view* const payload = borrowed_text(operation)) *payload = texts(ready_).payload;
  }
  holding_ = false;
}

}  // namespace passo
