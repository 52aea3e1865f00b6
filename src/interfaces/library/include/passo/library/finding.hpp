// Finding: an error or a warning with its place. Outcome: a result, or the errors that prevented it.
//
// No function of the library throws because of wrong input. `std::bad_alloc` and `std::system_error` (no more threads)
// are possible.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "passo/library/version.hpp"

namespace passo::v1 {

enum class Severity : std::uint8_t { warning, error };

// One error or warning.
struct Finding {
  Severity severity = Severity::error;
  std::string code = {};      // "gcode.missing-feed"; never changes once published
  std::string file = {};      // the file, or the name that the caller gave to a text
  std::uint32_t line = 0;     // from 1; 0: the file as a whole. For a Path: the number of the piece, from 1
  std::uint32_t column = 0;   // from 1, in characters; 0: the whole line
  std::uint32_t length = 0;   // in characters
  std::string message = {};   // what is wrong, with the value found
  std::string expected = {};  // the correct form, or how to correct the error; may be empty
  std::string text = {};      // the line of the file; may be empty
};

// Returns a finding in the style of compilers: "part.ngc:3:5: error: no feed rate is set [gcode.missing-feed]", then
// the line of the file with a mark below the error. The text has several lines, each with a line feed at its end.
PASSO_EXPORTED std::string describe(const Finding& finding);

// A result with its warnings, or the errors that prevented it.
template <class T>
class Outcome {
 public:
  Outcome(T value, std::vector<Finding> findings = {}) : value_(std::move(value)), findings_(std::move(findings)) {}
  explicit Outcome(std::vector<Finding> findings) : findings_(std::move(findings)) {}

  bool has_value() const { return value_.has_value(); }
  explicit operator bool() const { return has_value(); }
  // If there is no value, these throw std::bad_optional_access.
  T& value() { return value_.value(); }
  const T& value() const { return value_.value(); }
  // If there is no value, the behaviour of these is undefined.
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }

  const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::optional<T> value_ = {};
  std::vector<Finding> findings_ = {};
};

}  // namespace passo::v1
