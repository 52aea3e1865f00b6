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
  // Faulty listings, see passo/study/faulty_listing.hpp. They are no methods: methods_for() leaves them out.
  listing_rounding,
  listing_shared_variable,
  listing_slope_blocks,
  listing_projection,
};
enum class EndJudging : std::uint8_t { coordinates, projection, total };

struct Method {
  MethodName name = MethodName::lean;
  bool half_loaded = false;                        // half-full accumulators, for DDA
  std::optional<std::uint8_t> register_bits = {};  // DDA of lines; empty: left-normalised, the minimum number of bits
  EndJudging end_judging = EndJudging::total;      // point comparison of lines; the pulses are the same for all
};

// Returns all names, in the order of MethodName: "master-slave", "lean", …, "listing:rounding", ….
const std::vector<std::string>& method_names();
// Also accepts "bresenham", the common name of `lean`, and for arcs of `midpoint`.
std::optional<MethodName> method_named(std::string_view name, bool arc = false);
// Returns the method that a faulty listing was meant to be; empty for a method.
std::optional<Method> right_method_of(const Method& method);
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

// Returns every method that supports this move, with its variants, without the faulty listings.
std::vector<Method> methods_for(const StepMove& move);

}  // namespace passo
