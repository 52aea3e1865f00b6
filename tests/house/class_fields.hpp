// How many fields the classes of a C++ text have. A reader of brackets and words, no compiler: enough for code that
// compiles.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct ClassFields {
  std::string name;  // "QueueUpdater::Motion"
  std::size_t line = 0;
  std::size_t fields = 0;  // of each object; static members are none

  bool operator==(const ClassFields&) const = default;
};

// Of classes and structs with a body, nested ones too, in the order in which they end. Those inside of functions are
// left out.
std::vector<ClassFields> class_fields(std::string_view text);

}  // namespace passo
