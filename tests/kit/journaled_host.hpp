// A host that may be killed at any moment. It writes a journal like `passo run` over a serial link. The next instance
// of the host continues from that journal like `passo run --resume`.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kit/driven.hpp"
#include "kit/memory_store.hpp"
#include <gtest/gtest.h>

#include "passo/journal/resumption.hpp"

namespace passo::test {

// How a host ends: it is killed before, during or after sending a frame; or it brakes along the path and disconnects.
enum class HostEnd : std::uint8_t { before_frame, amid_frame, behind_frame, stopped };
struct HostDied {};
constexpr std::uint64_t never = UINT64_MAX;

// The link as the host uses it until it is killed. A moment is each time when the host sends a frame or receives data.
class MortalPort final : public BoardPort {
 public:
  MortalPort(BoardPort& line, std::uint64_t dies_at, HostEnd end) : line_(line), dies_at_(dies_at), end_(end) {}

  void receive(std::span<const std::uint8_t> bytes) override {
    const bool dies = is_time();
    const bool goes_out = !dies || end_ == HostEnd::behind_frame;
    if (goes_out) line_.receive(bytes);
    if (dies && end_ == HostEnd::amid_frame) line_.receive(bytes.first(bytes.size() / 2));
    if (dies) throw HostDied();
  }
  bool run(Seconds most) override {
    const bool said = line_.run(most);
    if (said && is_time()) throw HostDied();
    return said;
  }
  std::span<const std::uint8_t> replies() override { return line_.replies(); }
  Seconds elapsed() const override { return line_.elapsed(); }
  std::uint64_t moments() const { return moments_; }
  bool is_to_stop() const { return end_ == HostEnd::stopped && moments_ > dies_at_; }

 private:
  bool is_time() { return moments_++ == dies_at_ && end_ != HostEnd::stopped; }

  BoardPort& line_;
  std::uint64_t dies_at_;
  HostEnd end_;
  std::uint64_t moments_ = 0;
};

class JournaledHost {
 public:
  JournaledHost(const MachineDescription& machine, std::string program)
      : machine_(machine), program_(std::move(program)) {}

  // Returns whether the program reached its end. `moments` is set to the number of moments before the end of the host.
  bool live(BoardPort& line, std::uint64_t ends_at, HostEnd end, std::uint64_t& moments) {
    MortalPort port(line, ends_at, end);
    bool done = false;
    try {
      work(port, done);
    } catch (const HostDied&) {
      done = false;
    }
    moments = port.moments();
    return done;
  }
  MemoryStore store;
  std::vector<ProbeOutcome> found;  // results of all probe moves so far
  bool may_fail = false;            // the link is so bad that the job may fail with a message
  // Set: the program waits at its stops, for this. Empty: it does not wait.
  std::function<void(const Action&)> operator_works;
  std::uint64_t turns_between_holds = 0;  // the program is held that often, and resumed at rest; 0: never
  bool holds_by_door = false;             // at rest, spindle and coolant are then off
  Seconds door_stays_open{0};

 private:
  void work(MortalPort& port, bool& done) {
    BoardSession asking(port, real_line_care);
    const std::optional<BoardStatus> status = ask_status_at_rest(asking, Seconds(5));
    ASSERT_TRUE(status);
    const auto reader = ProgramReader::from_text("t", program_);
    JournalHead head = head_of_beginning({}, *status, {}, machine_.axes.size());
    std::optional<ResumePoint> point;
    if (!store.bytes.empty()) {
      const auto journal = Journal::read(store.bytes);
      ASSERT_TRUE(journal);
      EXPECT_EQ(journal->torn(), 0U);
      const auto rests_at = resume_point_of(*journal, *status, reader, machine_, InterpreterOptions());
      ASSERT_TRUE(rests_at) << message_of(rests_at.error());
      point = *rests_at;
      head = head_of_resumption(journal->head(), *status, *point);
    }
    head.numbers.session = ++sessions_;
    head.numbers.greeting = static_cast<std::uint8_t>(1 + sessions_ % 255);
    JournalWriter writer(store);
    writer.begin(head);
    DriveOn on{.board = &port, .session = head.numbers.session, .greeting = head.numbers.greeting, .resume_at = point};
    on.waits_for_operator = static_cast<bool>(operator_works);
    if (point) on.stands = place_by_counts(head, *point, *status, machine_);
    on.known_probes = found = head.probes;
    Diagnostics diagnostics;
    DrivenProgram job(reader.again(), machine_, InterpreterOptions(), diagnostics, on);
    if (fails(job)) return;
    ASSERT_TRUE(!point || stands_at(head, *point, *job.link().status(), machine_));
    const std::size_t lead_in = job.lead_in().size();
    job.drive().ledger()->watch_rests(
        [&](const BoardStop& rest) { writer.record(lead_in > 0 ? without_lead_in(*point, lead_in, rest) : rest); });
    job.drive().probe().watch([&](const ProbeOutcome& outcome) {
      writer.record(outcome);
      found.push_back(outcome);
    });
    job.resume();
    while (job.advance()) {
      if (port.is_to_stop() && !job.drive().stopped()) job.drive().stop();
      hold_now_and_then(job.drive());
      if (!job.drive().waits_for() || job.drive().stopped()) continue;
      operator_works(*job.drive().waits_for());
      job.drive().done();
    }
    done = !fails(job) && !job.drive().stopped();
  }
  void hold_now_and_then(MotionDrive& drive) {
    if (turns_between_holds == 0) return;
    const HoldReason reason = holds_by_door ? HoldReason::door : HoldReason::operator_hold;
    if (++turns_ % turns_between_holds == 0) drive.hold(reason);
    if (!drive.holds().has(reason) || drive.state() != MotionDrive::State::held) return;
    if (holds_by_door && !std::exchange(outputs_are_off_, true)) {
      drive.stop_outputs();
      return let_pass(drive, door_stays_open);
    }
    outputs_are_off_ = false;
    drive.resume(reason);
  }
  bool fails(const DrivenProgram& job) const {
    const auto error = job.link().error();
    EXPECT_TRUE(!error || may_fail) << message_of(*error);
    return error.has_value();
  }

  const MachineDescription& machine_;
  std::string program_;
  std::uint16_t sessions_ = 0;
  std::uint64_t turns_ = 0;
  bool outputs_are_off_ = false;
};

}  // namespace passo::test
