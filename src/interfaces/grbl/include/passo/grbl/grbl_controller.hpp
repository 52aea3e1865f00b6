// GrblController: a Grbl 1.1 controller around a machine session, as senders know it.
//
//   sender's bytes -> GrblInput -> GrblController -> requests to MachineSession, lines to OpenProgram
//   sender  <- replies(): whole lines                <- status and changes
//
// Place on the street: beside the street, above the session. The controller knows no sockets and has no clock. Its
// owner gives it the sender's bytes, turns the session, calls poll() after it, and sends the replies.
//
// Invariants: each line is answered by one `ok` or one `error:n`, in the order of the lines. An `ok` means that the
// line was taken into the queue; after a probe move or homing, that it is done. A byte is never dropped, but by a
// reset. Each reply is whole lines and belongs into one write.
//
// Where this differs from grbl, for the better: a reset and a soft limit brake on the path, so the place stays known.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/activity/open_program.hpp"
#include "passo/grbl/grbl_input.hpp"
#include "passo/grbl/grbl_memory.hpp"
#include "passo/grbl/grbl_reports.hpp"
#include "passo/grbl/grbl_settings.hpp"
#include "passo/grbl/grbl_store.hpp"
#include "passo/grbl/poll_lease.hpp"
#include "passo/grbl/report_turns.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// grbl's numbers for what is wrong with a line, beside those for G-code.
enum class GrblError : int {
  none = 0,
  bad_number = 2,
  bad_statement = 3,
  negative_value = 4,
  setting_disabled = 5,
  not_idle = 8,
  locked = 9,
  line_overflow = 11,
  door_open = 13,
  line_too_long_to_keep = 14,
  jog_beyond_travel = 15,
  bad_jog = 16,
  unsupported = 20,
  no_axis_words = 26,
  invalid_target = 33,
};

inline constexpr std::string_view jog_begins = "$J=";

class GrblController {
 public:
  // `machine`, `session` and `program` outlive the controller. `program` speaks grbl's dialect.
  GrblController(const MachineDescription& machine, MachineSession& session, OpenProgram& program);

  // Settings are written into the machine file, whose text is `text`. They count from the next start on. `write`
  // replaces the file by a text, and returns false if that is not possible, or if the file is no longer the text it is
  // given first.
  void keep_settings(std::string text, GrblStore::WriteFile write) {
    store_.keep_settings(std::move(text), std::move(write));
  }

  // What the controller keeps over a restart begins as `memory`, and goes to `write` when a sender has changed it;
  // `write` returns false if that is not possible.
  void remember(GrblMemory memory, GrblStore::WriteMemory write) {
    store_.remember(std::move(memory), std::move(write));
  }
  // Offsets of the work systems, and the homes of G28 and G30, are shared with others: `share` gets those that a sender
  // has changed, once the machine rests. apply_offsets() takes theirs; call while nothing moves for the senders.
  void share_offsets(std::function<void(const SavedParameters&)> share) { share_offsets_ = std::move(share); }
  void apply_offsets(const SavedParameters& parameters);

  // A sender has come: it is greeted, and what an earlier one has left unread is dropped. Nothing moves: whoever has
  // come may be no sender. To the first one that says something the controller has just started: its start lines run,
  // unless it is locked.
  void connect();
  // The sender has gone: a jog ends, and a program is held until somebody resumes or resets it.
  void disconnect();
  // Whether senders may move the machine now, or somebody else does. While they may not, lines that ask are answered,
  // and all others refused; a hold is still taken. Call while nothing moves for the senders.
  void let_drive(bool drives);
  void receive(std::string_view bytes);
  // False: the server is to stop reading until lines were taken.
  bool wants_more() const { return input_.wants_more(); }
  // Takes lines as far as they can be taken now, and tells what has happened. `changes`: the session's, since the last
  // call. Call after each turn of the session.
  void poll(const std::vector<MachineChange>& changes);
  // What to send, each in one write.
  std::vector<std::string> take_replies();

 private:
  enum class Waits : std::uint8_t { none, probe, homing, stop };

  // Real-time commands.
  void act(std::uint8_t byte);
  void act_as_watcher(std::uint8_t byte);
  void report_status();
  bool is_executing() const;
  void hold();
  void resume();
  void reset();
  void cancel_jog();
  void open_door();
  void stop_spindle();
  void switch_coolant(bool flood);
  void change_feed(int by);
  void change_rapids(int to);
  void change_spindle(int by);

  // Lines.
  void handle_lines();
  void handle(const GrblInput::Line& line);
  bool may_take_line() const;
  void handle_code(const std::string& text);
  void handle_command(const std::string& text);
  void handle_jog(const std::string& text);
  void handle_setting(const std::string& text);
  void keep_setting(int number, double value);
  void handle_build_info(const std::string& text);
  bool keep_memory(const GrblMemory& memory);
  void start_up();
  void run_startup();
  bool is_door_open() const;
  void share_changed_offsets();
  void handle_startup_line(const std::string& text);
  void restore(const std::string& text);
  void toggle_check();
  void unlock();
  bool state_place();
  bool has_lost_place() const;
  void home();
  void sleep();
  void begin_stream();
  void request_stream();
  void end_stream();

  // What has happened.
  void on_change(const MachineChange& change);
  void end_probe();
  void report_end();
  void report_wait();
  void begin_homing();
  void end_reset();
  void raise_alarm_of_board();
  void raise(GrblAlarm alarm);
  void stop_for(Waits waits);
  void stop_at_soft_limit();

  static int number_of(const Diagnostic& wrong);
  void answer(GrblError error) { answer(static_cast<int>(error)); }
  void answer(int error);
  void say(std::string text) { replies_.push_back(std::move(text)); }
  std::string_view state_name() const;
  bool is_idle() const;
  bool jogs() const;
  std::string pins() const;
  GrblUnits units() const;
  template <class Wanted>
  bool ask(Wanted wanted) {
    return session_.request(std::move(wanted)).has_value();
  }

  const MachineDescription& machine_;
  MachineSession& session_;
  OpenProgram& program_;
  GrblInput input_;
  GrblStore store_;
  std::function<void(const SavedParameters&)> share_offsets_;
  std::vector<std::string> replies_;
  Waits waits_ = Waits::none;
  std::function<void()> after_stop_;
  std::optional<Ticket> homing_;
  std::optional<Ticket> stream_;  // of the lines
  bool stream_ends_ = false;      // it was asked to end
  Seconds rests_since_{0};        // it has waited for a line since then
  bool is_here_ = true;           // the sender
  std::optional<ProbeOutcome> probe_;
  bool alarm_ = false;   // locked, until $X, $H
  bool checks_ = false;  // $C
  bool drives_ = true;   // senders may move the machine
  bool resets_ = false;  // the machine comes to rest for a reset
  ReportTurns report_turns_;
  bool wait_told_ = false;        // where the program waits for a person now
  bool has_started_ = false;      // the start lines have had their turn
  bool offsets_changed_ = false;  // a sender has changed them, and nobody has heard of it
  PollLease lease_;               // on a jog
};

}  // namespace passo
