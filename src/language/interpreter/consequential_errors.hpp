// ConsequentialErrors: what failed lines would have set. An error about such a missing value is a consequence of the
// failed line, and is not reported.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "code_table.hpp"

namespace passo {

class ConsequentialErrors {
 public:
  // Adds everything that the failed `line` would have set.
  void scan(std::string_view line);

  // Returns whether an error with this code may be such a consequence.
  bool explain(std::string_view code) const;
  // Returns whether a failed line would have set this parameter, e.g. "#<name>".
  bool explain_parameter(std::string_view text) const { return names_.contains(normal(text)); }

  // The axes with an unknown position.
  LetterSet axes() const { return axes_; }
  void set_axes(LetterSet axes) { axes_ = axes; }

 private:
  static std::string normal(std::string_view name);
  std::size_t scan_parameter(std::string_view line, std::size_t at);

  LetterSet letters_;
  LetterSet axes_;
  std::set<std::string> names_;
};

}  // namespace passo
