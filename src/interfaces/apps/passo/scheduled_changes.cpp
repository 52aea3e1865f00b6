#include "scheduled_changes.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "machine_connection.hpp"
#include "program_input.hpp"

#include "passo/activity/adaptive_feed_file.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/link/await.hpp"

namespace passo {
namespace {

constexpr double most_percent = 200;
// A longer time is a typing error, and may be too long for a count of ticks.
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

}  // namespace

MotorPosition motors_of(const MachineCounts& counts) {
  MotorPosition place;
  for (std::size_t m = 0; m < counts.motors.size(); ++m) place[m] = static_cast<double>(counts.motors[m].position);
  return place;
}

std::vector<double> place_of(const VirtualMachine& machine, const MachineDescription& description) {
  const Point axes = kinematics_of(description).axes(motors_of(machine.counts()));
  std::vector<double> place;
  for (const AxisDescription& axis : description.axes) place.push_back(axes[axis.axis]);
  return place;
}

std::optional<CableCut> read_cable_cut(const std::string& text) {
  const auto both = pair_of(text, ':');
  if (both) return CableCut{.at = Seconds(both->first), .missing = Seconds(both->second)};
  fail(exit_bad_program,
       "'" + text + "': expected --cut-cable-at SECONDS:SECONDS, the time of the cut and its duration");
  return std::nullopt;
}

void TailWatch::update(const BoardMachineSession& session, const VirtualMachine& machine,
                       const MachineDescription& description) {
  const QueueUpdateLedger* const ledger = session.ledger();
  if (ledger == nullptr || static_cast<std::size_t>(ledger->recoveries()) == tails_.size()) return;
  std::int64_t last_step = 0;
  for (const MotorCounts& motor : machine.counts().motors) last_step = std::max(last_step, motor.last_step.count);
  tails_.push_back({.rest = Seconds(static_cast<double>(last_step) / description.board.clock.value()),
                    .place = place_of(machine, description),
                    .resumed = session.now()});
}

std::optional<ScheduledChanges> ScheduledChanges::read(const ChangeArguments& arguments) {
  ScheduledChanges changes;
  for (const std::string& text : arguments.holds) {
    if (const auto at = number(text)) {
      changes.changes_.push_back({.at = Seconds(*at)});
    } else if (const auto both = pair_of(text, ':')) {
      changes.changes_.push_back({.at = Seconds(both->first), .pause = Seconds(both->second)});
    } else {
      fail(exit_bad_program,
           "'" + text + "': expected --hold-at SECONDS, or SECONDS:PAUSE to continue after PAUSE seconds");
      return std::nullopt;
    }
  }
  for (const std::string& text : arguments.overrides) {
    const auto both = pair_of(text, '@');
    if (!both || both->first > most_percent) {
      fail(exit_bad_program, "'" + text + "': expected --override PERCENT@SECONDS, with 0 to 200 percent");
      return std::nullopt;
    }
    changes.changes_.push_back({.at = Seconds(both->second), .factor = both->first / 100});
  }
  if (!arguments.adaptive_feed.empty() && !changes.add_adaptive_feed(arguments.adaptive_feed)) return std::nullopt;
  std::ranges::stable_sort(changes.changes_, {}, &Change::at);
  return changes;
}

bool ScheduledChanges::add_adaptive_feed(const std::string& file) {
  Diagnostics diagnostics;
  const auto factors = read_adaptive_feed(file, diagnostics);
  show(diagnostics);
  if (!factors) return false;
  for (const AdaptiveFeedChange& own : *factors) changes_.push_back({.at = own.at, .adaptive = own.factor});
  return true;
}

Seconds ScheduledChanges::act(MachineSession& session, const std::function<std::vector<double>()>& place) {
  const Seconds most = update_rest(session, place);
  for (; next_ < changes_.size() && changes_[next_].at <= now(session) && session.busy(); ++next_) {
    // The next hold waits until this hold is over.
    if (changes_[next_].is_hold() && holds_now_) break;
    apply(changes_[next_], session);
  }
  return most;
}

void ScheduledChanges::apply(const Change& change, MachineSession& session) {
  if (!change.is_hold()) {
    try_request(session, request::Override{.feed = change.factor, .adaptive_feed = change.adaptive});
    return;
  }
  const Seconds committed = session.status().committed;
  if (!session.request(request::Hold{})) return;
  holds_now_ = true;
  pause_ = change.pause;
  holds_.push_back({.asked = now(session), .reaction = committed});
}

// Decides how long the machine goes on resting, and returns that time. A hold lasts until its pause is over; a hold
// without a pause stops the program. A feed of 0 lasts until the next change; if there is none, the program is stopped.
Seconds ScheduledChanges::update_rest(MachineSession& session, const std::function<std::vector<double>()>& place) {
  const MachineStatus status = session.status();
  if (!session.busy() || status.state != MachineState::hold || !status.rests) return endless;
  if (!holds_now_) {
    if (!status.holds.has(HoldReason::zero_feed)) return endless;
    if (next_ < changes_.size()) return std::max(changes_[next_].at - now(session), Seconds(0));
    try_request(session, request::Stop{});
    return endless;
  }
  HoldSummary& hold = holds_.back();
  if (!resume_at_) {
    hold.rest = now(session);
    hold.place = place();
    resume_at_ = now(session) + pause_.value_or(Seconds(0));
  }
  if (pause_ && *resume_at_ - now(session) > hardly_any) return *resume_at_ - now(session);
  holds_now_ = false;
  resume_at_.reset();
  if (pause_) {
    hold.resumed = now(session);
    try_request(session, request::Resume{});
  } else {
    try_request(session, request::Stop{});
  }
  return endless;
}

std::vector<HoldSummary> ScheduledChanges::holds() const {
  std::vector<HoldSummary> rested = holds_;
  std::erase_if(rested, [](const HoldSummary& hold) { return hold.place.empty(); });
  return rested;
}

}  // namespace passo
