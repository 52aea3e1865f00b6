// Doubts: what lines that failed would have set. An error that only tells that this is missing is their consequence,
// and is not reported: nothing is wrong where it is found.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "code_table.hpp"

namespace passo {

class Doubts {
 public:
  // `line` failed. It would have set whatever it names.
  void scan(std::string_view line);

  // Whether an error of this code may be a consequence.
  bool explain(std::string_view code) const;
  // Whether a line that failed would have given a value to this parameter, as in "#<name>".
  bool explain_parameter(std::string_view text) const { return names_.contains(normal(text)); }

  // The axes whose places are not known.
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
