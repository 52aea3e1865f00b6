// GrblController: emulates a Grbl 1.1 controller on a machine session, for G-code senders.
//
//   sender's bytes -> GrblInput -> GrblController -> requests to MachineSession, lines to StreamedProgram
//   sender  <- replies(): whole lines                <- status and changes
//
// Position in the pipeline: outside it, above the session. The controller uses no sockets and has no clock. Its owner
// passes the sender's bytes to it, polls the session, calls poll() after that, and sends the replies.
//
// Invariants: each line is answered by one `ok` or one `error:n`, in the order of the lines. An `ok` means that the
// line was added to the queue; for a probe move or homing, that it is complete. Bytes are only dropped by a reset. Each
// reply consists of whole lines and must be sent in one write.
//
// Improvement over grbl: a reset and a soft limit brake along the path, so the position stays known.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/activity/streamed_program.hpp"
#include "passo/grbl/grbl_input.hpp"
#include "passo/grbl/grbl_memory.hpp"
#include "passo/grbl/grbl_reports.hpp"
#include "passo/grbl/grbl_settings.hpp"
#include "passo/grbl/grbl_store.hpp"
#include "passo/grbl/pending_response.hpp"
#include "passo/grbl/poll_keep_alive.hpp"
#include "passo/grbl/report_rotation.hpp"
#include "passo/grbl/sender_stream.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// Grbl's error numbers that do not correspond to an error in G-code.
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
  // `machine`, `session` and `program` must outlive the controller. `program` must use the Grbl dialect.
  GrblController(const MachineDescription& machine, MachineSession& session, StreamedProgram& program);

  // Enables settings, which are written into the machine file with the contents `text`. They take effect at the next
  // start. `write` replaces the file, and returns false if that is not possible, or if the file no longer has the
  // contents passed as its first argument.
  void keep_settings(std::string text, GrblStore::WriteFile write) {
    store_.keep_settings(std::move(text), std::move(write));
  }

  // Sets the initial contents of the controller's persistent memory, and the function that saves it after a change by a
  // sender; `write` returns false if that is not possible.
  void remember(GrblMemory memory, GrblStore::WriteMemory write) {
    store_.remember(std::move(memory), std::move(write));
  }
  // Shares the work offsets, and the home positions of G28 and G30, with other clients: `share` receives changes by a
  // sender once the machine is stopped. apply_offsets() adopts changes by others; it must be called while nothing moves
  // for the senders.
  void share_offsets(std::function<void(const SavedParameters&)> share) { share_offsets_ = std::move(share); }
  void apply_offsets(const SavedParameters& parameters);

  // Handles the connection of a sender: greets it, and drops output that an earlier one has left unread. Nothing moves
  // yet, because the client may not be a sender. The start-up lines run when a client sends something for the first
  // time, unless the controller is locked.
  void connect();
  // Handles the disconnection of the sender: ends a jog, and holds a program until it is resumed or reset.
  void disconnect();
  // Sets whether senders are in control of the machine. While they are not, queries are answered and all other lines
  // refused; a hold is still accepted. Must be called while nothing moves for the senders.
  void let_drive(bool drives);
  void receive(std::string_view bytes);
  // Returns false if the server must stop reading until lines were processed.
  bool wants_more() const { return input_.wants_more(); }
  // Processes as many lines as possible, and reports events. `changes`: the session's, since the last call. Must be
  // called after each turn of the session.
  void poll(const std::vector<MachineChange>& changes);
  // Returns the replies to send, each in one write.
  std::vector<std::string> take_replies();

 private:
  // Handlers of real-time commands.
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

  // Handlers of lines.
  void handle_lines();
  void handle(const GrblInput::Line& line);
  bool may_take_line() const;
  void handle_code(const std::string& text);
  void handle_command(const std::string& text);
  void handle_jog(const std::string& text);
  void handle_setting(const std::string& text);
  std::optional<std::string> enumeration_of(const std::string& text) const;
  void keep_setting(int number, double value);
  void write_to_board(int number, const std::string& value);
  void end_write(const std::string& trouble);
  std::vector<GrblSetting> all_settings() const;
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
  void home(std::optional<Axis> axis);
  void sleep();
  void begin_stream();
  void request_stream();
  void end_stream();

  // Events.
  void on_change(const MachineChange& change);
  void end_probe();
  void report_end();
  void report_wait();
  void begin_homing(std::optional<Axis> axis);
  void end_reset();
  void raise_alarm_of_board();
  void raise(GrblAlarm alarm);
  void stop_machine();
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
  StreamedProgram& program_;
  GrblInput input_;
  GrblStore store_;
  std::function<void(const SavedParameters&)> share_offsets_;
  std::vector<std::string> replies_;
  PendingResponse due_;
  SenderStream stream_;
  bool is_here_ = true;  // the sender is connected
  std::optional<ProbeOutcome> probe_;
  bool alarm_ = false;   // whether the controller is locked, until $X or $H
  bool checks_ = false;  // check mode, $C
  bool drives_ = true;   // senders are in control
  bool resets_ = false;  // the machine is stopping for a reset
  ReportRotation report_rotation_;
  bool wait_told_ = false;        // the current wait for the operator was reported
  bool has_started_ = false;      // the start-up lines were processed
  bool offsets_changed_ = false;  // changed by a sender, and not yet shared
  PollKeepAlive lease_;           // keep-alive timeout of a jog
};

}  // namespace passo
