#include "mid_run_changes.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "program_input.hpp"

namespace passo {
namespace {

constexpr double most_percent = 200;
// A time beyond it is a slip of the pen, and would not fit a clock of ticks.
constexpr double most_seconds = 1e6;

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = error == std::errc() && end == text.data() + text.size() && value >= 0 && value <= most_seconds;
  return good ? std::optional(value) : std::nullopt;
}

std::optional<std::pair<double, double>> pair_of(std::string_view text, char between) {
  const std::size_t at = text.find(between);
  if (at == std::string_view::npos) return std::nullopt;
  const std::optional<double> first = number(text.substr(0, at));
  const std::optional<double> second = number(text.substr(at + 1));
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

std::vector<double> place_of(const VirtualMachine& machine, const MachineDescription& description) {
  std::vector<double> place;
  const MachineCounts counts = machine.counts();
  for (std::size_t m = 0; m < description.axes.size(); ++m) {
    const AxisDescription& axis = description.axes[m];
    const auto steps = static_cast<double>(counts.motors[m].position);
    place.push_back((axis.inverted ? -steps : steps) / axis.steps_per_unit);
  }
  return place;
}

}  // namespace

std::optional<CableCut> read_cable_cut(const std::string& text) {
  const auto both = pair_of(text, ':');
  if (both) return CableCut{.at = Seconds(both->first), .missing = Seconds(both->second)};
  fail(exit_bad_program,
       "'" + text + "': expected --cut-cable-at SECONDS:SECONDS, when it is cut and after how long it is back");
  return std::nullopt;
}

void TailWatch::look(const MotionDrive& drive, const VirtualMachine& machine, const MachineDescription& description) {
  const Refiller* const refiller = drive.refiller();
  if (refiller == nullptr || static_cast<std::size_t>(refiller->recoveries()) == tails_.size()) return;
  std::int64_t last_step = 0;
  for (const MotorCounts& motor : machine.counts().motors) last_step = std::max(last_step, motor.last_step.count);
  tails_.push_back({.rest = Seconds(static_cast<double>(last_step) / description.board.clock.value()),
                    .place = place_of(machine, description),
                    .resumed = drive.now()});
}

std::optional<MidRunChanges> MidRunChanges::read(const std::vector<std::string>& holds,
                                                 const std::vector<std::string>& overrides) {
  MidRunChanges changes;
  for (const std::string& text : holds) {
    if (const auto at = number(text)) {
      changes.changes_.push_back({.at = Seconds(*at)});
    } else if (const auto both = pair_of(text, ':')) {
      changes.changes_.push_back({.at = Seconds(both->first), .pause = Seconds(both->second)});
    } else {
      fail(exit_bad_program,
           "'" + text + "': expected --hold-at SECONDS, or SECONDS:SECONDS to go on after the second time");
      return std::nullopt;
    }
  }
  for (const std::string& text : overrides) {
    const auto both = pair_of(text, '@');
    if (!both || both->first > most_percent) {
      fail(exit_bad_program, "'" + text + "': expected --override PERCENT@SECONDS, with 0 to 200 percent");
      return std::nullopt;
    }
    changes.changes_.push_back({.at = Seconds(both->second), .factor = both->first / 100});
  }
  std::stable_sort(changes.changes_.begin(), changes.changes_.end(),
                   [](const Change& a, const Change& b) { return a.at < b.at; });
  return changes;
}

void MidRunChanges::begin(MotionDrive& drive) const {
  if (any()) drive.go_live({});
}

void MidRunChanges::act(MotionDrive& drive, VirtualMachine& machine, const MachineDescription& description) {
  if (drive.state() == MotionDrive::State::held) {
    if (drive.hold_asked()) {
      rest(drive, machine, description);
    } else {
      wait_for_feed(drive);
    }
  }
  for (; next_ < changes_.size() && changes_[next_].at <= drive.now(); ++next_) {
    const Change& change = changes_[next_];
    if (change.factor) {
      drive.set_feed_override(*change.factor);
      continue;
    }
    // One after the other.
    if (drive.hold_asked()) return;
    drive.hold();
    pause_ = change.pause;
    holds_.push_back({.asked = drive.now(), .reaction = drive.committed()});
  }
}

void MidRunChanges::rest(MotionDrive& drive, VirtualMachine& machine, const MachineDescription& description) {
  HoldSummary& hold = holds_.back();
  hold.rest = drive.now();
  hold.place = place_of(machine, description);
  if (!pause_) return drive.stop();
  drive.wait(*pause_);
  hold.resumed = drive.now();
  drive.resume();
}

// Until the next change; where none comes, for good.
void MidRunChanges::wait_for_feed(MotionDrive& drive) {
  if (next_ == changes_.size()) return drive.stop();
  drive.wait(std::max(changes_[next_].at - drive.now(), Seconds(0)));
}

std::vector<HoldSummary> MidRunChanges::holds() const {
  std::vector<HoldSummary> rested = holds_;
  std::erase_if(rested, [](const HoldSummary& hold) { return hold.place.empty(); });
  return rested;
}

}  // namespace passo
