// What a C++ text declares at namespace scope: types and free functions. A reader of brackets and words, no compiler:
// enough for code that compiles.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct DeclaredName {
  enum class Kind { type, function };

  Kind kind = Kind::type;
  std::size_t line = 0;
  std::string scope;       // "passo::chip"
  std::string name;        // "Plane", "axes_of", "operator=="
  std::string parameters;  // of a function, without their names: "Plane, int"

  bool operator==(const DeclaredName&) const = default;
};

// Types with a body or another name for a type (`using`), and functions with a body or without. Left out is what no
// other file can mean: nested names, the insides of functions and of anonymous namespaces, and static functions.
std::vector<DeclaredName> declared_names(std::string_view text);

}  // namespace passo
