// MachineSession: the object that stands for the machine. Everything that moves a machine goes through its session.
//
// Requests go in; a status and an ordered list of changes come out. The session owns the board's session, the work that
// the machine is busy with, and the position with its trust. A session waits for nothing, and has no thread and no
// clock. Its owner calls poll() again and again, in the board's virtual time or in real time.
//
//   owner:  session.request(…);  while (…) { session.poll(Seconds(0.02));  session.status();  session.take_changes(); }
//
// Invariants: the state changes only as the table in machine_state.hpp says. A position whose trust is not `unknown` is
// as true as the board's counts. Each request is answered exactly once.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "passo/activity/program.hpp"
#include "passo/base/result.hpp"
#include "passo/drive/refill_ledger.hpp"
#include "passo/link/board_session.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/live_place.hpp"
#include "passo/session/machine_status.hpp"
#include "passo/session/request.hpp"
#include "passo/session/tracked_place.hpp"

namespace passo {

struct SessionOptions {
  // True: the board is at the end of a line. The motion that it holds always ends at rest, its counts are compared with
  // what was commanded, and its buttons and its door are heeded. False: the board is in this process.
  bool over_a_line = false;
  LineCare care = {};
  Greeting greeting = {};    // the session sets `motors`
  bool tells_place = false;  // the board is asked where it stands, also in motion, for MachineStatus::now_at
  KnownPosition start = {};  // where the machine stands, as far as the owner knows
  // No program begins where the place is lost or, on a machine that can home all axes, not known.
  bool needs_place = false;
};

class MachineSession {
 public:
  // `machine` and `port` outlive the session. The session sends nothing to the board before greet() or the first
  // poll().
  MachineSession(const MachineDescription& machine, BoardPort& port, const SessionOptions& options = {});
  ~MachineSession();
  MachineSession(const MachineSession&) = delete;
  MachineSession& operator=(const MachineSession&) = delete;

  // The board's session, for questions to the board before the first poll(). These questions change nothing on the
  // board.
  BoardSession& board() { return board_; }
  const BoardSession& board() const { return board_; }
  // Says where the machine stands, before greet() or the first poll(), if that depends on the board's status.
  void start_at(const KnownPosition& position) { place_.start_at(position); }
  // Greets the board before the first poll(), if the greeting depends on the board's status. Otherwise the greeting
  // comes from SessionOptions.
  void greet(const Greeting& greeting);
  // Gives the board another session number, between two programs.
  void name_session(std::uint16_t number);
  // Before each further hello over a line, after a reset: the listener gets the board's status, and the greeting that
  // follows.
  void listen_before_hello(std::function<void(const BoardStatus&, const Greeting&)> listener) {
    before_hello_ = std::move(listener);
  }

  [[nodiscard]] Result<Ticket, Refusal> request(Request wanted);
  // Does one bounded step. Where the session can only wait for the board, time passes until there is news, but no
  // longer than `most`. `most` may be endless only while something moves.
  void poll(Seconds most);

  MachineStatus status() const;
  std::vector<MachineChange> take_changes();
  MachineState state() const { return state_; }
  // The board's time.
  Seconds now() const { return board_.now(); }
  // Something is going on, or rests and goes on later.
  bool busy() const;
  // Why this board cannot drive the machine, as a sentence without a full stop.
  const std::string& trouble_words() const { return trouble_.sentence.text; }

  // What is going on, or else what ended last, for reports. Null: nothing of this kind.
  const MotionDrive* drive() const;
  const Program* program() const;
  const HomingPath* homing() const;
  const RefillLedger* ledger() const;
  // How the board's counts differed from what was commanded, if they did. The position is then lost.
  const std::optional<CountMismatch>& mismatch() const { return place_.mismatch(); }
  // Over a line, when the machine is ready: the board's counts at machine zero.
  const std::optional<MotorSteps>& zero_counts() const { return place_.zero_counts(); }
  // Why no program may begin, as far as the board's switches tell: a limit switch is closed, so the board would not
  // stop at that end any more. Empty: nothing is in the way.
  std::optional<Refusal> closed_limit() const;
  // The same, where a program needs to know where the machine stands (SessionOptions::needs_place). A jog is possible.
  std::optional<Refusal> lost_place() const;

 private:
  class Work;
  class Panel;
  // What keeps the machine from working until a reset.
  struct Trouble {
    std::optional<LinkError> error = {};  // none: the board does not suit the machine
    Sentence sentence = {};
  };

  // One function for each request.
  using Answer = Result<Ticket, Refusal>;
  Answer handle(request::Start& start);
  Answer handle(request::Stream& stream);
  Answer handle(request::DropLines& drop);
  Answer handle(request::Jog& jog);
  Answer handle(request::RenewLease& renew);
  Answer handle(request::Home& home);
  Answer handle(request::Probe& probe);
  Answer handle(request::Check& check);
  Answer handle(request::Hold& hold);
  Answer handle(request::Resume& resume);
  Answer handle(request::Stop& stop);
  Answer handle(request::Override& change);
  Answer handle(request::SwitchOutputs& wanted);
  Answer handle(request::ChooseStops& chosen);
  Answer handle(request::OperatorDone& done);
  Answer handle(request::SetPosition& set);
  Answer handle(request::ResetMachine& reset);
  Answer handle(request::Sleep& sleep);
  Answer handle(request::Wake& wake);
  std::optional<Refusal> refuse(MachineEvent event) const;
  Refusal why_not() const;
  Refusal refusal_in_alarm() const;
  std::optional<Refusal> refuse_way(const Point& way) const;
  Answer at_once();
  Answer begin(MachineEvent event, std::unique_ptr<Work> work);
  DriveOptions drive_options() const;
  StepOptions step_options() const;

  void put_on_drive(Work& work, const DriveOptions& options, bool knows_ahead);
  // The clock by which it is told what the board executes.
  Seconds clock_of(const Work& work) const;

  void go_online(Seconds most);
  void begin_reset();
  void find_place_again();
  void stand_at(const KnownPosition& position);
  const KnownPosition& position() const { return place_.position(); }
  const BoardStatus* watched_status() const;

  void poll_work(Seconds most);
  void poll_check();
  void finish_work();
  void end_work();
  std::pair<Outcome, std::optional<ActivityFault>> judge_work() const;
  void record_place();
  bool poll_lines(Seconds most);
  void go_on_after_drop();
  void check_lease();
  void update_holds();
  void update_door();
  void end_overrides();
  void put_overrides_on(MotionDrive& drive) const;
  void report_tails();
  void on_standstill();
  void check_board();
  Sentence sentence_of(LinkError error) const;
  void poll_panel();
  void poll_place();
  Sentence sentence_of_stop() const;
  bool watches_counts() const { return options_.over_a_line || options_.tells_place; }

  void move_to(MachineEvent event);
  void publish(MachineChange change);
  void answer(Ticket ticket, Outcome outcome, std::optional<ActivityFault> fault = {});
  void answer_holds(Outcome outcome);

  const MachineDescription& machine_;
  SessionOptions options_;
  BoardSession board_;
  std::function<void(const BoardStatus&, const Greeting&)> before_hello_;
  MachineState state_ = MachineState::offline;
  bool greeted_ = false;
  bool asks_place_ = false;    // the board is asked for its place before another hello
  bool switches_off_ = false;  // after another hello: what was going on may have left something on
  TrackedPlace place_;
  std::unique_ptr<Work> work_;  // what is going on, or what ended last
  std::unique_ptr<Panel> panel_;
  Overrides overrides_;
  ChosenStops stops_;
  LivePlace live_place_;  // for tells_place
  Trouble trouble_;
  std::deque<MachineChange> changes_;
  std::vector<Ticket> waiting_holds_;  // answered when the machine rests
  Ticket last_ticket_ = 0;
  Seconds enabled_at_{0};  // when the board was greeted last, and with that its drivers were enabled
  std::uint64_t version_ = 0;
};

}  // namespace passo
