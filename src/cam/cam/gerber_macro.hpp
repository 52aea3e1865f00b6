// GerberMacro: an aperture of a Gerber file composed of primitives (AM). Private to cam/.
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
    GerberCommand place;  // source of the macro, without its text
  };
  std::string name;
  std::vector<Statement> statements;
};

// An error in a statement, and its position.
struct GerberMacroFault {
  const GerberMacro::Statement* statement = nullptr;
  std::size_t at = 0;  // position in the statement's text
  std::string message;
  std::string expected;
};

struct GerberMacroLimits {
  double nm_per_unit = 1e6;
  // Called before points are created: returns whether this many more points are allowed.
  std::function<bool(std::size_t points)> has_room_for;
  std::function<bool(const std::vector<DrawnRing>& rings)> can_unite;
};

// Returns the shape of the macro about the origin, with the arguments as $1, $2 ... Stops at the first error and
// appends it to `faults`.
Region shape_of(const GerberMacro& macro, const std::vector<double>& arguments, const GerberMacroLimits& limits,
                std::vector<GerberMacroFault>& faults);

}  // namespace passo
