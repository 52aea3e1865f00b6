// Findings: errors and warnings with their places, and Outcome: a result, or why there is none.
//
// No function of the library throws because of its input. `std::bad_alloc` and `std::system_error` (no more threads)
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
  std::string file = {};      // the file, or the name given to a text
  std::uint32_t line = 0;     // from 1; 0: the file as a whole. In a Path: the number of the piece, from 1
  std::uint32_t column = 0;   // from 1, in characters; 0: the whole line
  std::uint32_t length = 0;   // in characters
  std::string message = {};   // what is wrong, with the value found
  std::string expected = {};  // the correct form, or how to correct the error; may be empty
  std::string text = {};      // the line of the file; may be empty
};

// Returns a finding as compilers write it: "part.ngc:3:5: error: no feed rate is set [gcode.missing-feed]", and the
// line of the file with a mark. Several lines, each with a line feed.
PASSO_EXPORTED std::string describe(const Finding& finding);

// A result with its warnings, or the errors because of which there is none.
template <class T>
class Outcome {
 public:
  Outcome(T value, std::vector<Finding> findings = {}) : value_(std::move(value)), findings_(std::move(findings)) {}
  explicit Outcome(std::vector<Finding> findings) : findings_(std::move(findings)) {}

  bool has_value() const { return value_.has_value(); }
  explicit operator bool() const { return has_value(); }
  // Without a value they throw std::bad_optional_access.
  T& value() { return value_.value(); }
  const T& value() const { return value_.value(); }
  // Without a value their behaviour is undefined.
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
