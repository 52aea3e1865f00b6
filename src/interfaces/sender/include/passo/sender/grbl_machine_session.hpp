// GrblMachineSession: the session of a machine whose motion a Grbl board plans. Clients use it like that of a board of
// ours; abilities() lists what such a machine cannot do.
//
//   requests -> GrblFeed, jog lines, $H -> GrblSender -> GrblPort
//
// The board keeps its own position, and the work offsets. Programs are interpreted here, as for our boards, and sent as
// plain lines (GrblCode). Before each program the board's modes are set, and its offsets are read.
//
// After a stop, a refused line and a probe alarm, the board is asked again who and where it is, before the activity
// ends. Nothing is sent twice: what a lost connection, a restart or an alarm has interrupted ends there. A restart, a
// lost connection and a timeout lead to the state fault, an alarm of the board to the state alarm; both end with
// ResetMachine, which resets the board (Ctrl-X), and opens a lost connection again. In motion it stops the machine at
// once, and the position is lost. A USB device that was unplugged and returns is opened without a request, also under
// another name.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/sender/grbl_match.hpp"
#include "passo/sender/grbl_port.hpp"
#include "passo/sender/grbl_program_check.hpp"
#include "passo/sender/grbl_sender.hpp"
#include "passo/sender/session_settings.hpp"
#include "passo/session/live_position.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

class GrblBoardStorage;

class GrblMachineSession final : public MachineSession {
 public:
  // The longest time between two exchanges with a busy board: a released key takes effect that much later at most.
  static constexpr Seconds between_looks{0.02};

  // Both must outlive the session. `ahead`: how much motion may lie in the board. Nothing is sent before the first
  // poll().
  GrblMachineSession(const MachineDescription& machine, GrblPort& port, Seconds ahead = GrblSender::default_ahead);
  ~GrblMachineSession() override;

  [[nodiscard]] Result<Ticket, Refusal> request(Request wanted) override;
  void poll(Seconds most) override;
  MachineStatus status() const override;
  std::vector<MachineChange> take_changes() override;
  MachineState state() const override { return state_; }
  Seconds now() const override { return port_.now(); }
  bool busy() const override;
  bool works() const override;
  const std::string& trouble_words() const override { return trouble_.words.text; }
  std::optional<ProgramResults> program_results() const override;
  std::optional<Refusal> closed_limit() const override { return {}; }
  std::optional<Refusal> lost_place() const override;
  MachineAbilities abilities() const override;
  BoardStorage* storage() override;
  NumberedSettings* numbered_settings() override { return &loan_.settings; }
  const NumberedSettings* numbered_settings() const override { return &loan_.settings; }

  // What the board has reported about itself.
  const GrblMachine& board() const { return board_; }
  // What the board reports now, and for what it waits.
  const GrblSender& sender() const { return sender_; }
  // The board is in an alarm that $X or $H ends.
  bool is_locked() const { return locked_; }
  // How the machine file suits the settings of the board. An objection refuses programs.
  const GrblMatch& match() const { return match_; }
  // Why the last activity ended before its end, or why the board cannot be used. Empty: nothing has gone wrong.
  const std::optional<GrblFault>& fault() const { return trouble_.fault; }
  // The number of lines that the current or the last program has sent.
  std::uint64_t lines_of_program() const;
  // Returns the board's messages since the last call: see GrblMachine::take_messages().
  std::vector<std::string> take_messages() { return sender_.take_messages(); }
  GrblPathJudge path_judge() const { return grbl_path_judge(GrblTarget::of(board_)); }
  // Returns the board's offsets as parameters of a program: G54 to G59.3, G28, G30 and G92. `kept`: the values of what
  // the board does not have.
  SavedParameters offsets(const SavedParameters& kept = {}) const;
  // Writes changed work offsets to the board (G10 L2), as soon as it is idle.
  void store_offsets(const SavedParameters& parameters);
  // Calls the listener when the board has others, e.g. because a zero was set at its panel.
  void watch_offsets(std::function<void()> listener) { connection_.offsets_listener = std::move(listener); }

  // Lends the sender to a reader of the board's settings or files, which moves nothing. The owner goes on polling the
  // session. Meanwhile every request is refused. Null: the machine is not at rest.
  GrblSender* lend_sender();
  // False if it has not been lent, or if the connection or the board's state was lost in the meantime.
  bool is_sender_lent() const { return loan_.lent; }
  // The settings may be others now: the session takes over what the board has told.
  void take_sender_back();
  // The same, and asks the board again what it is: it may have read lines that were none.
  void take_sender_back_and_greet();

 private:
  struct Work;
  // The result of the last probe move.
  struct Contact {
    std::optional<Point> at;
    bool touched = false;
  };
  // After a lost connection, an alarm or a restart.
  struct Recovery {
    bool lacks_place = false;
    AxisSet homed;         // single axes, since then
    Seconds next_look{0};  // for a device that was unplugged
  };
  struct Heard {
    std::uint64_t reports = 0;  // so far
    std::string pins;
    std::optional<std::string> outputs;  // letters, as the board reports them; empty: not reported yet
    std::uint64_t outputs_after = 0;     // lines that were answered before that report
    double speed = 0;                    // of the spindle, rpm, without its override
    std::optional<Point> work_zero;
    Contact contact;
  };
  struct Connection {
    Seconds ahead{1};
    bool is_prepared = false;  // the board's modes are set, since the connection
    std::optional<Seconds> broken_since = {};
    bool offsets_are_old = false;
    bool asks_offsets = false;
    std::function<void()> offsets_listener = {};
  };
  // Of the sender, for the settings or files of the board.
  struct Loan {
    explicit Loan(GrblMachineSession& session);
    bool lent = false;
    std::unique_ptr<GrblBoardStorage> storage;
    SessionSettings settings;
  };
  struct Trouble {
    Sentence words;
    std::optional<GrblFault> fault;
  };
  struct News {
    std::deque<MachineChange> changes;
    std::uint64_t version = 0;
  };
  struct Tickets {
    Ticket last = 0;
    std::vector<Ticket> holds;  // answered when the machine is stopped
  };

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
  std::optional<Refusal> refuse_motion(MachineEvent event) const;
  std::optional<Refusal> refuse_path() const;
  Answer refuse_ability(Ability ability) const;
  Answer at_once();
  void end_at_other_zero(std::uint32_t line);
  void switch_outputs_off();
  Answer begin(MachineEvent event, std::unique_ptr<Work> work);

  void exchange(Seconds most);
  void hear(std::string_view line);
  void hear_report();
  void hear_switches(const GrblReport& report);
  void hear_work_zero(const Point& zero);
  void ask_for_offsets();
  void take_board();
  void go_online();
  void connect_again(bool on_open_line);
  void look_for_device();
  void prepare();
  bool rests() const;
  bool is_held_at_board() const;
  OutputState outputs_now() const;
  MmPerSecond speed_now() const;
  void unlock();
  void lose_place();

  void poll_idle();
  void poll_check();
  void poll_work();
  void make_feed();
  void play_executed(Work& work, const MotionLimits& limits) const;
  void poll_feed();
  void answer_question();
  void await_line();
  void update_holds();
  void poll_jog();
  void send_jog_piece();
  void poll_home();
  void begin_board_file();
  void poll_board_file();
  void hear_board_file(std::string_view line);
  void tell_board_file(MachineStatus& status) const;
  bool knows_place_after(std::optional<Axis> homed);
  void resync();
  void end_resync();
  void end_program();
  void end_work(Outcome outcome, std::optional<ActivityFault> fault = {});
  void check_fault();
  void check_fault_of_work(const GrblFault& fault);
  void break_off(MachineEvent event, const GrblFault& fault);
  void stop_by_reset();
  Sentence sentence_of(const GrblFault& fault) const;
  std::string words_of_restart() const;
  void send_overrides();

  void move_to(MachineEvent event);
  void publish(MachineChange change);
  void answer(Ticket ticket, Outcome outcome, std::optional<ActivityFault> fault = {});
  void answer_holds(Outcome outcome);

  const MachineDescription& machine_;
  GrblPort& port_;
  GrblSender sender_;
  GrblMachine board_;  // as it has described itself last
  GrblMatch match_;
  MachineState state_ = MachineState::offline;
  Connection connection_;
  bool locked_ = false;  // the board is in an alarm that $X or $H ends
  Recovery recovery_;
  Loan loan_{*this};
  KnownPosition position_;
  LivePosition live_;
  Heard heard_;
  std::unique_ptr<Work> work_;  // the current or the last activity
  Overrides overrides_;
  ChosenStops stops_;
  Trouble trouble_;
  std::optional<SavedParameters> to_store_;
  News news_;
  Tickets tickets_;
};

}  // namespace passo
