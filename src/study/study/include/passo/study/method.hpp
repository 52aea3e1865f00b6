// Method: an interpolator selected by name, for the command line, pictures and comparisons.
//
// A PulseSource calls the interpolator through virtual functions, whose cost does not matter here. The pipeline and the
// board use the interpolators directly.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/interpolate/pulse.hpp"
#include "passo/study/step_move.hpp"

namespace passo {

enum class MethodName : std::uint8_t {
  master_slave,
  lean,
  dda,
  slope_recalculated,
  slope_blocks,
  point_comparison,
  midpoint,
};
enum class EndJudging : std::uint8_t { coordinates, projection, total };

struct Method {
  MethodName name = MethodName::lean;
  bool half_loaded = false;                        // half-full accumulators, for DDA
  std::optional<std::uint8_t> register_bits = {};  // DDA of lines; empty: left-normalised, the minimum number of bits
  EndJudging end_judging = EndJudging::total;      // point comparison of lines; the pulses are the same for all
};

// Returns all names, in a fixed order: "master-slave", "lean", ….
const std::vector<std::string>& method_names();
// Also accepts "bresenham", the common name of `lean`, and for arcs of `midpoint`.
std::optional<MethodName> method_named(std::string_view name, bool arc = false);
// Returns e.g. "dda, half loaded".
std::string title(const Method& method);

class PulseSource {
 public:
  virtual ~PulseSource() = default;
  virtual bool done() const = 0;
  virtual Pulse next() = 0;
  // Writes the current decision variables, in the order of decision_names().
  virtual void decisions(std::vector<std::int64_t>& values) const = 0;
  virtual std::vector<std::string> decision_names() const = 0;
};

// Starts a method on a checked move. The error is the reason why the method does not support the move: "is for lines;
// an arc is cut by …".
Result<std::unique_ptr<PulseSource>, std::string> start(const Method& method, const StepMove& move);

// Returns every method that supports this move, with its variants.
std::vector<Method> methods_for(const StepMove& move);

}  // namespace passo
