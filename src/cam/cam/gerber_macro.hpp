// GerberMacro: an aperture of a Gerber file that is composed of primitives (AM). Private to cam/.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "gerber_text.hpp"

#include "passo/cam/region.hpp"

namespace passo {

struct GerberMacro {
  struct Statement {
    std::string words;
    GerberCommand place;  // without its words
  };
  std::string name;
  std::vector<Statement> statements;
};

// What is wrong in a statement, and where.
struct GerberMacroFault {
  const GerberMacro::Statement* statement = nullptr;
  std::size_t at = 0;  // in its words
  std::string message;
  std::string expected;
};

struct GerberMacroLimits {
  double nm_per_unit = 1e6;
  // Asked before points are made: whether so many more are still allowed.
  std::function<bool(std::size_t points)> has_room_for;
  std::function<bool(const std::vector<DrawnRing>& rings)> can_unite;
};

// The macro's shape about zero, with the arguments as $1, $2 ... Stops at the first fault, which is then in `faults`.
Region shape_of(const GerberMacro& macro, const std::vector<double>& arguments, const GerberMacroLimits& limits,
                std::vector<GerberMacroFault>& faults);

}  // namespace passo
