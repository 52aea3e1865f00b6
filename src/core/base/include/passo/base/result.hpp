// Result<T, E>: a value or the reason why there is none.
//
// For operations that fail with a single error (open a file, decode a frame). Errors in a user's file are collected as
// Diagnostics instead. A bug in Passo is an assertion failure.
#pragma once

#include <new>
#include <type_traits>
#include <utility>

namespace passo {

// Wraps the error on its way into a Result: `return Failure{WireError::bad_crc};`
template <class E>
struct Failure {
  E error;
};
template <class E>
Failure(E) -> Failure<E>;

template <class T, class E>
class [[nodiscard]] Result {
 public:
  Result(const T& value) : has_value_(true) { new (&value_) T(value); }        // NOLINT: implicit on purpose
  Result(T&& value) : has_value_(true) { new (&value_) T(std::move(value)); }  // NOLINT
  template <class F>
  Result(Failure<F> failure) : has_value_(false) {  // NOLINT
    new (&error_) E(std::move(failure.error));
  }
  Result(const Result& other) : has_value_(other.has_value_) { construct(other); }
  Result(Result&& other) noexcept : has_value_(other.has_value_) { construct(std::move(other)); }
  Result& operator=(Result other) noexcept {
    destroy();
    has_value_ = other.has_value_;
    construct(std::move(other));
    return *this;
  }
  ~Result() { destroy(); }

  bool has_value() const { return has_value_; }
  explicit operator bool() const { return has_value_; }

  // The caller has checked has_value(). Access to a missing value is a bug of the caller.
  T& value() { return value_; }
  const T& value() const { return value_; }
  T& operator*() { return value_; }
  const T& operator*() const { return value_; }
  T* operator->() { return &value_; }
  const T* operator->() const { return &value_; }
  const E& error() const { return error_; }

 private:
  template <class Other>
  void construct(Other&& other) {
    if (has_value_) {
      new (&value_) T(std::forward<Other>(other).value_);
    } else {
      new (&error_) E(std::forward<Other>(other).error_);
    }
  }
  void destroy() {
    if (has_value_) {
      value_.~T();
    } else {
      error_.~E();
    }
  }

  union {
    T value_;
    E error_;
  };
  bool has_value_;
};

// Success without a value, or the reason for failure.
struct Unit {};
template <class E>
using Status = Result<Unit, E>;

}  // namespace passo
