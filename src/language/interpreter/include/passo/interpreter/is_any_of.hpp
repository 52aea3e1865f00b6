// is_any_of<Kind...>(operation): whether an operation is one of these kinds.
#pragma once

#include <variant>

#include "passo/interpreter/operation.hpp"

namespace passo {

template <class... Kinds>
bool is_any_of(const Operation& operation) {
  return (std::holds_alternative<Kinds>(operation.what) || ...);
}

}  // namespace passo
