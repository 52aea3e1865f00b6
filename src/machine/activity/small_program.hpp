// SmallProgram: writes the small programs that move the machine to a known place. Private to activity/.
//
// The programs begin and end with '%'. So they do not end with M2, which may move the tool to the park position.
#pragma once

#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "passo/base/sentence.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

class SmallProgram {
 public:
  // `purpose`: the comment at the head.
  explicit SmallProgram(std::string_view purpose);

  template <class... T>
  void line(fmt::format_string<T...> words, T&&... values) {
    fmt::format_to(std::back_inserter(text_), words, std::forward<T>(values)...);
    text_ += '\n';
  }
  std::string finish();

 private:
  std::string text_;
};

// Returns why the axis cannot go there: outside its travel. Nothing: it can, or there is no such axis.
std::optional<Sentence> outside_travel(const MachineDescription& machine, Axis axis, double place);
// Returns the text as a comment of G-code can hold it: printable ASCII without parentheses, cut off if it is long.
std::string comment_of(std::string_view text);

}  // namespace passo
