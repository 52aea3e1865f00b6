#include "passo/study/method.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/interpolate/arcs.hpp"
#include "passo/interpolate/bresenham_line.hpp"
#include "passo/interpolate/dda.hpp"
#include "passo/interpolate/master_slave.hpp"
#include "passo/interpolate/point_comparison_line.hpp"
#include "passo/interpolate/slope_blocks.hpp"
#include "passo/interpolate/slope_recalculated.hpp"
#include "passo/study/faulty_listing.hpp"

namespace passo {
namespace {

// What a student wants to see of each interpolator beside its pulses: the names and values of its variables.
using Names = std::vector<std::string>;
using Values = std::vector<std::int64_t>;

Names per_axis(std::string_view what, std::size_t axes) {
  Names names;
  for (std::size_t axis = 0; axis < axes; ++axis) names.push_back(fmt::format("{}_{}", what, axis_name(axis)));
  return names;
}

Names names_of(const MasterSlave<most_axes>&, std::size_t axes) {
  Names names = per_axis("reached", axes);
  for (const std::string& middle : per_axis("middle", axes)) names.push_back(middle);
  return names;
}
void values_of(const MasterSlave<most_axes>& line, std::size_t axes, Values& values) {
  for (std::uint8_t axis = 0; axis < axes; ++axis) values.push_back(line.reached(axis));
  for (std::uint8_t axis = 0; axis < axes; ++axis) values.push_back(line.middle(axis));
}

Names names_of(const BresenhamLine<most_axes>&, std::size_t axes) {
  return per_axis("decision", axes);
}
void values_of(const BresenhamLine<most_axes>& line, std::size_t axes, Values& values) {
  for (std::uint8_t axis = 0; axis < axes; ++axis) values.push_back(line.decision(axis));
}

Names names_of(const Dda<most_axes>&, std::size_t axes) {
  return per_axis("accumulator", axes);
}
void values_of(const Dda<most_axes>& line, std::size_t axes, Values& values) {
  for (std::uint8_t axis = 0; axis < axes; ++axis) values.push_back(line.accumulator(axis));
}

Names names_of(const SlopeRecalculated<>&, std::size_t) {
  return {"excess"};
}
void values_of(const SlopeRecalculated<>& line, std::size_t, Values& values) {
  values.push_back(line.excess());
}

Names names_of(const SlopeBlocks<>&, std::size_t) {
  return {"plain", "blocks"};
}
void values_of(const SlopeBlocks<>& line, std::size_t, Values& values) {
  values.push_back(line.plain());
  values.push_back(line.blocks());
}

// For point comparison, and for all arcs.
template <class Interpolator>
Names names_of(const Interpolator&, std::size_t) {
  return {"deviation"};
}
template <class Interpolator>
void values_of(const Interpolator& interpolator, std::size_t, Values& values) {
  values.push_back(interpolator.deviation());
}

Names names_of(const DdaArc<>&, std::size_t) {
  return {"deviation", "accumulator_x", "accumulator_y"};
}
void values_of(const DdaArc<>& arc, std::size_t, Values& values) {
  values.push_back(arc.deviation());
  for (std::uint8_t axis = 0; axis < 2; ++axis) values.push_back(arc.accumulator(axis));
}

template <class Interpolator>
class Source : public PulseSource {
 public:
  Source(const Interpolator& interpolator, std::size_t axes) : interpolator_(interpolator), axes_(axes) {}
  bool done() const override { return interpolator_.done(); }
  Pulse next() override { return interpolator_.next(); }
  void decisions(Values& values) const override {
    values.clear();
    values_of(interpolator_, axes_, values);
  }
  Names decision_names() const override { return names_of(interpolator_, axes_); }

 private:
  Interpolator interpolator_;
  std::size_t axes_;
};

using Started = Result<std::unique_ptr<PulseSource>, std::string>;

template <class Interpolator>
Started source(const Interpolator& interpolator, const StepMove& move) {
  return std::unique_ptr<PulseSource>(std::make_unique<Source<Interpolator>>(interpolator, move.axes()));
}

Started start_arc(const Method& method, const StepMove& move) {
  const ArcPoints arc = arc_points(move);
  const DdaLoad load = method.half_loaded ? DdaLoad::half : DdaLoad::zero;
  switch (method.name) {
    case MethodName::point_comparison: return source(PointComparisonArc<>(arc), move);
    case MethodName::midpoint: return source(MidpointArc<>(arc), move);
    case MethodName::dda: return source(DdaArc<>(arc, load), move);
    default: return Failure{std::string("is for lines; arcs are for point-comparison, dda and midpoint")};
  }
}

Started start_two_axes(const Method& method, const StepMove& move) {
  if (move.axes() != 2) return Failure{fmt::format("is for two axes, but the move has {}", move.axes())};
  const LineDistances all = distances(move);
  const std::int32_t two[2] = {all.all[0], all.all[1]};
  if (method.name == MethodName::slope_recalculated) return source(SlopeRecalculated<>(two), move);
  if (method.name == MethodName::slope_blocks) return source(SlopeBlocks<>(two), move);
  switch (method.end_judging) {
    case EndJudging::coordinates: return source(PointComparisonLine<std::uint32_t, EndByCoordinates>(two), move);
    case EndJudging::projection: return source(PointComparisonLine<std::uint32_t, EndByProjection>(two), move);
    case EndJudging::total: break;
  }
  return source(PointComparisonLine<>(two), move);
}

Started start_dda(const Method& method, const StepMove& move) {
  const LineDistances all = distances(move);
  const std::uint8_t fewest = fewest_bits(Line<most_axes, std::uint32_t>(all.all).longest);
  const std::uint8_t bits = method.register_bits.value_or(fewest);
  if (bits < fewest || bits > Dda<most_axes>::most_bits) {
    return Failure{
        fmt::format("needs registers of {} to {} bits for this move, not {}", fewest, Dda<most_axes>::most_bits, bits)};
  }
  return source(Dda<most_axes>(all.all, method.half_loaded ? DdaLoad::half : DdaLoad::zero, bits), move);
}

}  // namespace

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = {"master-slave",
                                                 "lean",
                                                 "dda",
                                                 "slope-recalculated",
                                                 "slope-blocks",
                                                 "point-comparison",
                                                 "midpoint",
                                                 "listing:rounding",
                                                 "listing:shared-variable",
                                                 "listing:slope-blocks",
                                                 "listing:projection"};
  return names;
}

std::optional<MethodName> method_named(std::string_view name, bool arc) {
  if (name == "bresenham") return arc ? MethodName::midpoint : MethodName::lean;
  const auto found = std::ranges::find(method_names(), name);
  if (found == method_names().end()) return std::nullopt;
  return static_cast<MethodName>(found - method_names().begin());
}

std::optional<Method> right_method_of(const Method& method) {
  switch (method.name) {
    case MethodName::listing_rounding:
    case MethodName::listing_shared_variable: return Method{.name = MethodName::lean};
    case MethodName::listing_slope_blocks: return Method{.name = MethodName::slope_blocks};
    case MethodName::listing_projection: return Method{.name = MethodName::point_comparison};
    default: return std::nullopt;
  }
}

std::string title(const Method& method) {
  std::string text = method_names()[static_cast<std::size_t>(method.name)];
  if (method.half_loaded) text += ", half loaded";
  if (method.register_bits) text += ", " + counted(*method.register_bits, "bit");
  return text;
}

Result<std::unique_ptr<PulseSource>, std::string> start(const Method& method, const StepMove& move) {
  if (move.arc) return start_arc(method, move);
  if (right_method_of(method)) return start_listing(method, move);
  switch (method.name) {
    case MethodName::master_slave: return source(MasterSlave<most_axes>(distances(move).all), move);
    case MethodName::lean: return source(BresenhamLine<most_axes>(distances(move).all), move);
    case MethodName::dda: return start_dda(method, move);
    case MethodName::midpoint: return Failure{std::string("is for arcs, so it needs a centre")};
    default: return start_two_axes(method, move);
  }
}

std::vector<Method> methods_for(const StepMove& move) {
  std::vector<Method> found;
  for (std::size_t name = 0; name < method_names().size(); ++name) {
    Method method{.name = static_cast<MethodName>(name)};
    if (right_method_of(method) || !start(method, move)) continue;
    found.push_back(method);
    if (method.name != MethodName::dda) continue;
    method.half_loaded = true;
    found.push_back(method);
  }
  return found;
}

}  // namespace passo
