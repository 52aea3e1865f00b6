#include "passo/journal/path_fingerprint.hpp"

#include <variant>

namespace passo {

void PathFingerprint::add(const PathItem& item) {
  std::visit([this](const auto& one) { add(one); }, item);
}

void PathFingerprint::add(const Segment& segment) {
  const Curve& curve = segment.curve;
  for (const Point& point : {curve.start(), curve.at(curve.length() / 3), curve.end()}) {
    for (const Axis axis : all_axes) of_all_.add(point[axis]);
  }
  for (const double value : {curve.length().value(), segment.speed.value(), segment.tolerance.value(),
                             segment.merge.value(), segment.pitch.value()}) {
    of_all_.add(value);
  }
  of_all_.add(std::uint64_t{segment.rapid} + (static_cast<std::uint64_t>(segment.mode) << 8U));
  // Journals of programs without such outputs stay valid.
  if (segment.outputs == PathOutputs{}) return;
  of_all_.add(segment.outputs.power);
  of_all_.add(std::uint64_t{segment.outputs.switches.value_or(0)} +
              (std::uint64_t{segment.outputs.follows_speed} << 8U));
}

void PathFingerprint::add(const Action& action) {
  const OutputState& outputs = action.outputs;
  of_all_.add(static_cast<std::uint64_t>(action.kind) + (static_cast<std::uint64_t>(outputs.spindle) << 8U) +
              (std::uint64_t{outputs.mist} << 16U) + (std::uint64_t{outputs.flood} << 17U));
  of_all_.add(action.dwell.value());
  of_all_.add(outputs.revolutions_per_minute);
}

}  // namespace passo
