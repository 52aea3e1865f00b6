// Method: an interpolator chosen by its name, for the command line, pictures and comparisons.
//
// A PulseSource hides the interpolator behind virtual calls, whose cost does not matter here. The pipeline and the
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
  bool half_loaded = false;                        // DDA
  std::optional<std::uint8_t> register_bits = {};  // DDA of lines; empty: left-normalised, the fewest possible
  EndJudging end_judging = EndJudging::total;      // point comparison of lines; the pulses are the same for all
};

// All names, in a fixed order: "master-slave", "lean", ….
const std::vector<std::string>& method_names();
// Also knows "bresenham", the name by which most people look for `lean`, and for arcs for `midpoint`.
std::optional<MethodName> method_named(std::string_view name, bool arc = false);
// For example "dda, half loaded".
std::string title(const Method& method);

class PulseSource {
 public:
  virtual ~PulseSource() = default;
  virtual bool done() const = 0;
  virtual Pulse next() = 0;
  // Writes the method's present decision variables, in the order of decision_names().
  virtual void decisions(std::vector<std::int64_t>& values) const = 0;
  virtual std::vector<std::string> decision_names() const = 0;
};

// Starts a method on a checked move, or says why the method does not take it: "is for lines; an arc is cut by …".
Result<std::unique_ptr<PulseSource>, std::string> start(const Method& method, const StepMove& move);

// Every method that takes this move, with its variants.
std::vector<Method> methods_for(const StepMove& move);

}  // namespace passo
