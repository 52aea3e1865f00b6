// Converts between the types of the library's interface and the inner types of the same meaning. Private to library/.
#pragma once

#include <utility>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/library/axes.hpp"
#include "passo/library/finding.hpp"
#include "passo/library/gcode.hpp"

namespace passo::v1 {

inline Position position_of(const passo::Point& point) {
  const auto& v = point.values;
  return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]};
}
inline passo::Point point_of(const Position& position) {
  passo::Point point;
  point.values = {position.x, position.y, position.z, position.a, position.b,
                  position.c, position.u, position.v, position.w};
  return point;
}
inline Axis outer(passo::Axis axis) {
  return static_cast<Axis>(axis);
}
inline passo::Axis inner(Axis axis) {
  return static_cast<passo::Axis>(axis);
}
static_assert(axis_count == passo::axis_count);
static_assert(static_cast<int>(Axis::w) == static_cast<int>(passo::Axis::w));

Finding finding_of(const passo::Diagnostic& diagnostic);
std::vector<Finding> findings_of(const passo::Diagnostics& diagnostics);
// Returns a finding of the library's own about a number, a piece or an option. `line`: 0 or the number of the piece.
Finding error_of(std::string code, std::string file, std::uint32_t line, std::string message, std::string expected);

// Returns the interpreter's options, after reading the files that they name. Errors of these files go to `diagnostics`.
passo::InterpreterOptions interpreter_options_of(const ReadOptions& options, passo::Diagnostics& diagnostics);

}  // namespace passo::v1
