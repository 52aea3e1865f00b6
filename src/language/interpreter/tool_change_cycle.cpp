#include "tool_change_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

// How far a slow touch goes below the one before.
constexpr double beyond_contact = 1;  // mm

}  // namespace

ToolChangeCycle::ToolChangeCycle(const ToolChangePlan& plan, const Start& start, const OperationSource& source)
    : Cycle(start.frame.work_from_machine(start.machine), source),
      plan_(plan),
      start_(start),
      frame_(start.frame),
      machine_(start.machine),
      known_(start.known),
      stage_(start.after_macro ? Stage::macro : Stage::leave) {}

void ToolChangeCycle::apply(const ProbeOutcome* outcome) {
  awaits_ = false;
  texts_.clear();  // all of them were pulled
  outcome_.reset();
  if (outcome != nullptr) {
    outcome_ = *outcome;
    machine_ = outcome->rest;
    position_ = frame_.work_from_machine(machine_);
  }
}

bool ToolChangeCycle::step() {
  switch (stage_) {
    case Stage::leave: leave(); break;
    case Stage::macro:
      calls_macro_ = !start_.after_macro;
      if (calls_macro_) return false;
      go_on_after_macro();
      break;
    case Stage::check_used: go_to_setter(); break;
    case Stage::unload: unload(); break;
    case Stage::ask: ask(); break;
    case Stage::load: load(); break;
    case Stage::place_plate: place_plate(); break;
    case Stage::seek: seek(); break;
    case Stage::latch: latch(); break;
    case Stage::judge: judge(); break;
    case Stage::go_back: go_back(); return false;
    case Stage::give_up: gave_up_ = true; return false;
  }
  return true;
}

// The spindle was switched off before. The dwell is the whole run-down time of the plan, because the duration of the
// move up is not known here.
void ToolChangeCycle::leave() {
  emit(operation::StartToolChange{});
  if (start_.mist) emit(operation::SetMist{false});
  if (start_.flood) emit(operation::SetFlood{false});
  rise();
  if (start_.spindle_turns && plan_.run_down > Seconds(0)) emit(operation::Dwell{plan_.run_down});
  used_ = plan_.wear.has_value() && known_.tool != 0 && known_.tool == start_.from;
  if (used_) {
    stage_ = Stage::check_used;
  } else {
    stage_ = start_.only_checks ? Stage::go_back : after_check();
  }
}

ToolChangeCycle::Stage ToolChangeCycle::after_check() const {
  if (plan_.way == ToolChangeWay::rack) return Stage::unload;
  const bool has_first = !known_.any_change && plan_.first != FirstTool::change && start_.to != 0;
  if (plan_.way == ToolChangeWay::macro && !has_first) return Stage::macro;
  return Stage::ask;
}

void ToolChangeCycle::go_on_after_macro() {
  if (has_macro_fault()) {
    rise();
    reason_ = start_.macro_fault;
    return give_up();
  }
  emit(operation::ChangeTool{start_.to, true});
  rise();
  if (start_.spindle_turns && plan_.run_down > Seconds(0)) emit(operation::Dwell{plan_.run_down});
  stage_ = plan_.measures && start_.to != 0 ? after_load() : Stage::go_back;
}

// Asks for the next tool. If the first one is said to be in the spindle, the operator confirms it: a wrong tool there
// would be measured, or trusted, like the right one.
void ToolChangeCycle::ask() {
  const bool is_first = !known_.any_change && reason_.empty();
  if (is_first && plan_.first != FirstTool::change && start_.to != 0) {
    say(fmt::format("check that tool {} is in the spindle{}, then continue", start_.to, remark()));
    emit(operation::ChangeTool{start_.to});
    stage_ = plan_.first == FirstTool::trusted || !plan_.measures ? Stage::go_back : after_load();
    return;
  }
  rise();
  if (plan_.change_at) go_across(*plan_.change_at);
  if (!reason_.empty()) say(std::exchange(reason_, {}));
  if (start_.to == 0) {
    say("take the tool out of the spindle, then continue");
  } else {
    say(fmt::format("put tool {} into the spindle{}, then continue", start_.to, remark()));
  }
  emit(operation::ChangeTool{start_.to});
  stage_ = start_.to == 0 || !plan_.measures ? Stage::go_back : after_load();
}

std::string ToolChangeCycle::remark() const {
  return start_.remark.empty() ? std::string() : fmt::format(" ({})", start_.remark);
}

ToolChangeCycle::Stage ToolChangeCycle::after_load() const {
  return plan_.way == ToolChangeWay::plate ? Stage::place_plate : Stage::check_used;
}

void ToolChangeCycle::place_plate() {
  go_across(setter());
  say("put the touch plate under the tool and connect it, then continue");
  emit(operation::ProgramStop{});
  stage_ = Stage::seek;
}

void ToolChangeCycle::go_to_setter() {
  rise();
  go_across(setter());
  stage_ = Stage::seek;
}

void ToolChangeCycle::seek() {
  probe_to(plan_.window_low, plan_.seek);
  stage_ = Stage::latch;
}

// The first touch was fast. The slow ones count.
void ToolChangeCycle::latch() {
  const double low = plan_.window_low;
  double contact = low;
  if (outcome_) {
    if (outcome_->refused)
      return not_measured(
          "the tool setter is closed already: clean it, check its wire, and make sure that nothing lies on it");
    if (!outcome_->touched) {
      if (used_)
        return report_used(
            fmt::format("tool {} touched nothing down to Z{:.3f}: it is broken or lost", start_.from, low));
      return not_measured(fmt::format(
          "tool {} touched nothing down to Z{:.3f}: clamp it lower, or check the tool setter", start_.to, low));
    }
    contact = outcome_->contact[Axis::z];
    if (contact > plan_.window_high) {
      return not_measured(
          fmt::format("contact at Z{:.3f}, above the end of the window at Z{:.3f}: clamp the tool higher, or "
                      "remove what lies on the tool setter",
                      contact, plan_.window_high));
    }
  }
  touched_ = contact;
  touches_.assign(1, contact);
  touch_slowly();
}

void ToolChangeCycle::touch_slowly() {
  go_to(with_z(touched_ + plan_.retract), plan_.seek);
  probe_to(touched_ - beyond_contact, plan_.latch);
  stage_ = Stage::judge;
}

void ToolChangeCycle::judge() {
  if (!record_slow_touch()) return;
  if (touches_.size() <= static_cast<std::size_t>(plan_.touches)) return touch_slowly();
  if (!do_touches_agree()) return;
  touched_ = std::accumulate(touches_.begin() + 1, touches_.end(), 0.0) / plan_.touches;
  rise();
  if (plan_.way == ToolChangeWay::plate) {
    say("remove the touch plate, then continue");
    emit(operation::ProgramStop{});
  }
  if (used_) return judge_used();
  known_.tool = start_.to;
  known_.contact = touched_;
  is_measured_ = outcome_.has_value();
  if (is_measured_ && !known_.reference) known_.reference = touched_;
  stage_ = Stage::go_back;
}

bool ToolChangeCycle::record_slow_touch() {
  if (outcome_) {
    if (outcome_->refused) {
      not_measured("the tool setter did not open again after the touch before: check it");
      return false;
    }
    if (!outcome_->touched) {
      not_measured(fmt::format("the tool touched at Z{:.3f}, but not a {} time: tighten it, and check the tool setter",
                               touched_, touches_.size() == 1 ? "second" : "further"));
      return false;
    }
    touched_ = outcome_->contact[Axis::z];
  }
  touches_.push_back(touched_);
  return true;
}

// A tool that slips in its collet, chips on it, or a setter that sticks: the touches then differ.
bool ToolChangeCycle::do_touches_agree() {
  const auto [low, high] = std::ranges::minmax_element(touches_);
  if (*high - *low <= plan_.agreement) return true;
  not_measured(
      fmt::format("{} touches differ by {:.3f} mm, more than {:g} mm: tighten the tool, clean its tip and the tool "
                  "setter, and check that the setter is fixed",
                  touches_.size(), *high - *low, plan_.agreement));
  return false;
}

void ToolChangeCycle::judge_used() {
  const double longer = outcome_ ? touched_ - known_.contact : 0;
  if (std::abs(longer) > *plan_.wear) {
    return report_used(
        fmt::format("tool {} is {:.3f} mm {} than before its use: it is {}", start_.from, std::abs(longer),
                    longer < 0 ? "shorter" : "longer",
                    longer < 0 ? "worn, broken or pushed in" : "pulled out of its collet, or chips stick to it"));
  }
  used_ = false;
  stage_ = start_.only_checks ? Stage::go_back : after_check();
}

// The work may be spoilt, so the operator has to look at it.
void ToolChangeCycle::report_used(std::string text) {
  rise();
  if (plan_.change_at) go_across(*plan_.change_at);
  say(std::move(text) + "; look at the work, then continue or stop the program");
  emit(operation::ProgramStop{});
  used_ = false;
  stage_ = start_.only_checks ? Stage::go_back : after_check();
}

void ToolChangeCycle::not_measured(std::string reason) {
  rise();
  reason_ = std::move(reason);
  if (++tries_ == most_tries) return give_up();
  if (!used_) {
    stage_ = Stage::ask;
    return;
  }
  say(std::exchange(reason_, {}));
  emit(operation::ProgramStop{});
  stage_ = Stage::check_used;
}

// An error ends the path where it is found. So the error has to wait until the tool is up: for a probe move of no
// length.
void ToolChangeCycle::give_up() {
  probe(position_);
  stage_ = Stage::give_up;
}

// From the rack, tool n is in pocket n. Nobody knows what is in the spindle before the first change.
void ToolChangeCycle::unload() {
  rise();
  if (!known_.any_change && plan_.first != FirstTool::change) {
    stage_ = Stage::ask;
    return;
  }
  if (!known_.any_change || (start_.from != 0 && !has_pocket(start_.from))) {
    if (plan_.change_at) go_across(*plan_.change_at);
    say("take the tool out of the spindle if there is one, then continue");
    emit(operation::ChangeTool{0});
  } else if (start_.from != 0) {
    put_away(start_.from);
  }
  stage_ = has_pocket(start_.to) ? Stage::load : Stage::ask;
}

void ToolChangeCycle::put_away(std::int32_t tool) {
  const ToolRack& rack = plan_.rack;
  const MachineXy at = pocket(tool);
  go_across({at.x + rack.entry.x, at.y + rack.entry.y});
  go_to(with_z(rack.z), rack.feed);
  go_to(with_xy(at), rack.feed);
  open_collet(true);
  rise();
  open_collet(false);
}

void ToolChangeCycle::load() {
  const ToolRack& rack = plan_.rack;
  const MachineXy at = pocket(start_.to);
  rise();
  go_across(at);
  open_collet(true);
  go_to(with_z(rack.z), rack.feed);
  open_collet(false);
  go_to(with_xy({at.x + rack.entry.x, at.y + rack.entry.y}), rack.feed);
  emit(operation::ChangeTool{start_.to, true});
  rise();
  stage_ = plan_.measures ? after_load() : Stage::go_back;
}

void ToolChangeCycle::open_collet(bool open) {
  if (plan_.rack.opens == ColletOutput::mist) {
    emit(operation::SetMist{open});
  } else {
    emit(operation::SetFlood{open});
  }
  if (plan_.rack.wait > Seconds(0)) emit(operation::Dwell{plan_.rack.wait});
}

void ToolChangeCycle::go_back() {
  rise();
  go_across({back()[Axis::x], back()[Axis::y]});
  if (start_.mist) emit(operation::SetMist{true});
  if (start_.flood) emit(operation::SetFlood{true});
  if (!start_.only_checks) known_.any_change = true;
  if (!is_measured_ && known_.tool != start_.to) known_.tool = 0;
}

bool ToolChangeCycle::has_pocket(std::int32_t tool) const {
  return tool >= 1 && tool <= plan_.rack.pockets;
}

MachineXy ToolChangeCycle::pocket(std::int32_t tool) const {
  const ToolRack& rack = plan_.rack;
  return {rack.first.x + rack.step.x * (tool - 1), rack.first.y + rack.step.y * (tool - 1)};
}

MachineXy ToolChangeCycle::setter() const {
  if (plan_.measure_at) return *plan_.measure_at;
  const Point& zero = frame_.work_zero();
  return {zero[Axis::x], zero[Axis::y]};
}

void ToolChangeCycle::say(std::string text) {
  emit(operation::Message{texts_.emplace_back(std::move(text))});
}

Point ToolChangeCycle::with_z(double z) const {
  Point to = machine_;
  to[Axis::z] = z;
  return to;
}

Point ToolChangeCycle::with_xy(const MachineXy& at) const {
  Point to = machine_;
  to[Axis::x] = at.x;
  to[Axis::y] = at.y;
  return to;
}

void ToolChangeCycle::rise() {
  if (machine_[Axis::z] < plan_.safe_z) go_to(with_z(plan_.safe_z));
}

void ToolChangeCycle::go_across(const MachineXy& at) {
  const Point to = with_xy(at);
  if (to != machine_) go_to(to);
}

void ToolChangeCycle::go_to(const Point& to) {
  machine_ = to;
  traverse(frame_.work_from_machine(to));
}

void ToolChangeCycle::go_to(const Point& to, MmPerSecond speed) {
  machine_ = to;
  emit(operation::SetFeedRate{operation::FeedPerSecond{speed}});
  feed(frame_.work_from_machine(to));
}

void ToolChangeCycle::probe_to(double z, MmPerSecond speed) {
  machine_ = with_z(z);
  position_ = frame_.work_from_machine(machine_);
  emit(operation::SetFeedRate{operation::FeedPerSecond{speed}});
  probe(position_);
}

void ToolChangeCycle::probe(const Point& work_end) {
  emit(operation::TurnProbe{true});
  emit(operation::StraightProbe{work_end, true, false});
  emit(operation::TurnProbe{false});
  awaits_ = true;
}

}  // namespace passo
