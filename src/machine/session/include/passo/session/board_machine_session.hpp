// BoardMachineSession: the session of a machine whose board executes steps that are planned here.
//
// The session owns the board's session, the current activity, and the position with its trust.
//
// Invariant: a position whose trust is not `unknown` is as accurate as the board's counts.
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
#include "passo/drive/queue_update_ledger.hpp"
#include "passo/link/board_session.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/live_position.hpp"
#include "passo/session/machine_session.hpp"
#include "passo/session/machine_status.hpp"
#include "passo/session/position_tracker.hpp"
#include "passo/session/request.hpp"

namespace passo {

struct SessionOptions {
  // True: the board is connected by a link. Its queue always ends in a stop, its counts are compared with the commanded
  // position, and its buttons and door switch are used. False: the board is in this process.
  bool over_a_line = false;
  LinkTimeouts care = {};
  Greeting greeting = {};    // the session sets `motors`
  bool tells_place = false;  // the board's position is queried even during motion, for MachineStatus::now_at
  KnownPosition start = {};  // the position as known to the owner
  // Programs do not start while the position is lost or, on a machine that can home all axes, unknown.
  bool needs_place = false;
  HostSpindle* spindle = nullptr;  // a spindle that this computer controls; only over a line. Outlives the session
};

class BoardMachineSession final : public MachineSession {
 public:
  // `machine` and `port` must outlive the session. It sends nothing to the board before greet() or the first poll().
  BoardMachineSession(const MachineDescription& machine, BoardPort& port, const SessionOptions& options = {});
  ~BoardMachineSession() override;

  // The board's session, for queries before the first poll(), which change nothing on the board.
  BoardSession& board() { return board_; }
  const BoardSession& board() const { return board_; }
  // Sets the position before greet() or the first poll(), if it depends on the board's status.
  void start_at(const KnownPosition& position) { place_.start_at(position); }
  // Starts the handshake before the first poll(), if its parameters depend on the board's status. Otherwise they come
  // from SessionOptions.
  void greet(const Greeting& greeting);
  // Gives the board another session number, between two programs.
  void name_session(std::uint16_t number);
  // The listener is called before each later handshake (after a reset), with the board's status and the parameters of
  // the handshake.
  void listen_before_hello(std::function<void(const BoardStatus&, const Greeting&)> listener) {
    before_hello_ = std::move(listener);
  }

  [[nodiscard]] Result<Ticket, Refusal> request(Request wanted) override;
  void poll(Seconds most) override;
  MachineStatus status() const override;
  std::vector<MachineChange> take_changes() override;
  MachineState state() const override { return state_; }
  Seconds now() const override { return board_.now(); }
  bool busy() const override;
  bool works() const override;
  const std::string& trouble_words() const override { return trouble_.sentence.text; }
  std::optional<ProgramResults> program_results() const override;
  std::optional<Refusal> closed_limit() const override;
  std::optional<Refusal> lost_place() const override;
  MachineAbilities abilities() const override;
  const HostSpindle* spindle() const override { return options_.spindle; }
  BoardMachineSession* as_board_session() override { return this; }
  const BoardMachineSession* as_board_session() const override { return this; }

  // Returns the current activity, or otherwise the last one, for reports; null if there is none of this kind.
  const MotionDrive* drive() const;
  const Program* program() const;
  const HomingPath* homing() const;
  const QueueUpdateLedger* ledger() const;
  // The difference between the board's counts and the commanded position, if any. The position is then lost.
  const std::optional<CountMismatch>& mismatch() const { return place_.mismatch(); }
  // With a board on a link, when the machine is ready: the board's counts at machine zero.
  const std::optional<MotorSteps>& zero_counts() const { return place_.zero_counts(); }

 private:
  class Work;
  class Panel;
  // An error that blocks the machine until a reset.
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
  Answer handle(request::RenewKeepAlive& renew);
  Answer handle(request::Home& home);
  Answer handle(request::Probe& probe);
  Answer handle(request::Check& check);
  Answer handle(request::RunBoardFile& run);
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

  void put_on_drive(Work& work, const DriveOptions& options, const Watchers& watchers = {}, bool knows_ahead = true,
                    Seconds nominal_time = Seconds(0));
  // The clock of the board's executed motion.
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
  void record_place(bool knows_counts);
  bool poll_lines(Seconds most);
  void go_on_after_drop();
  void check_lease();
  void update_holds();
  void update_door();
  void poll_spindle();
  std::optional<Refusal> refuse_spindle() const;
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
  bool asks_place_ = false;    // the board's position is queried before another handshake
  bool switches_off_ = false;  // after another handshake: the interrupted activity may have left outputs on
  PositionTracker place_;
  std::unique_ptr<Work> work_;  // the current or the last activity
  std::unique_ptr<Panel> panel_;
  Overrides overrides_;
  ChosenStops stops_;
  LivePosition live_position_;  // for tells_place
  Trouble trouble_;
  std::deque<MachineChange> changes_;
  std::vector<Ticket> waiting_holds_;  // answered when the machine is stopped
  Ticket last_ticket_ = 0;
  Seconds enabled_at_{0};  // time of the last handshake, which enables the drivers
  std::uint64_t version_ = 0;
};

}  // namespace passo
