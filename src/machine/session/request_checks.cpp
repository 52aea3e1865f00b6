#include "passo/session/request_checks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/geometry/euclid.hpp"
#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {
namespace {

constexpr double highest_factor = 2;
constexpr double least_rapids = 0.05;

bool is_factor(const std::optional<double>& value, double highest) {
  return !value || (*value >= 0 && *value <= highest);
}

bool is_share(double value) {
  return value >= request::Jog::least_share && value <= 1;
}

}  // namespace

bool all_finite(const Point& point) {
  return std::ranges::all_of(all_axes, [&](Axis axis) { return std::isfinite(point[axis]); });
}

Refusal refusal_in(MachineState state, bool is_busy) {
  switch (state) {
    case MachineState::offline: return {RefusalReason::not_ready};
    case MachineState::alarm: return {RefusalReason::motors_stopped};
    case MachineState::fault: return {RefusalReason::board_lost};
    case MachineState::sleep: return {RefusalReason::asleep};
    case MachineState::door: return {RefusalReason::door_open};
    case MachineState::await_line: return {RefusalReason::outputs_left_on};
    default: return {is_busy ? RefusalReason::busy : RefusalReason::nothing_going_on};
  }
}

std::optional<Refusal> refusal_of(const request::Jog& jog) {
  const double speed = jog.way.speed.value();
  const bool good = std::isfinite(speed) && speed > 0 && all_finite(jog.way.direction) &&
                    std::isfinite(jog.way.distance.value()) && jog.way.distance >= Mm(0) &&
                    length_of(jog.way.direction) > 0;
  if (!good) return Refusal{RefusalReason::bad_jog};
  if (!is_share(jog.share)) return Refusal{RefusalReason::bad_share};
  if (jog.lease >= request::Jog::shortest_lease && jog.lease <= request::Jog::longest_lease) return {};
  return Refusal{RefusalReason::bad_lease};
}

std::optional<Refusal> refusal_of(const request::RenewKeepAlive& renew) {
  if (is_share(renew.share.value_or(1))) return {};
  return Refusal{RefusalReason::bad_share};
}

std::optional<Refusal> refusal_of(const request::Probe& probe, const MachineDescription& machine,
                                  const KnownPosition& position, Mm slack) {
  if (!all_finite(probe.target) || !(probe.speed > MmPerSecond(0)) || !std::isfinite(probe.speed.value())) {
    return Refusal{RefusalReason::bad_probe};
  }
  const bool leaves_travel = std::ranges::any_of(machine.axes, [&](const AxisDescription& axis) {
    const double place = probe.target[axis.axis];
    return place < axis.travel_low - slack.value() || place > axis.travel_high + slack.value();
  });
  if (position.trust == Trust::unknown || !leaves_travel) return {};
  return Refusal{RefusalReason::probe_leaves_travel};
}

std::optional<Refusal> refusal_of(const request::Override& change) {
  if (!is_factor(change.feed, highest_factor) || !is_factor(change.adaptive_feed, 1) ||
      !is_factor(change.spindle, highest_factor)) {
    return Refusal{RefusalReason::bad_override};
  }
  if (is_factor(change.rapids, 1) && change.rapids.value_or(1) >= least_rapids) return {};
  return Refusal{RefusalReason::bad_rapid_override};
}

Refusal refused_because(std::string code, std::string why) {
  return {RefusalReason::board_cannot, {{"why", std::move(why)}, {"why.code", std::move(code)}}};
}

Refusal refusal_of(const MachineAbilities& abilities, Ability ability) {
  const Sentence* const why = abilities.why_not(ability);
  return why != nullptr ? refused_because(why->code, why->text) : Refusal{RefusalReason::board_cannot};
}

std::optional<Refusal> refusal_of(const request::SwitchOutputs& wanted, const MachineDescription& machine) {
  const auto& plan = machine.tool_change;
  if (!plan || plan->way != ToolChangeWay::rack) return {};
  const bool opens = plan->rack.opens == ColletOutput::mist ? wanted.mist.has_value() : wanted.flood.has_value();
  if (!opens) return {};
  return refused_because("machine.collet-output", "this output opens the collet: only a tool change switches it");
}

}  // namespace passo
