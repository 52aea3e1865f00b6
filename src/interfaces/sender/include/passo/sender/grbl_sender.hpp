// GrblSender: a G-code sender for a machine with Grbl 1.1: connects to it, streams lines, and reports its position and
// errors.
//
//   lines -> GrblSender -> bytes for the machine         real-time bytes are sent before all lines
//            GrblSender <- bytes of the machine          ok, error:n, ALARM:n, <…>, […], $n=…
//
// Position in the pipeline: outside it, instead of a board. Like the controller in `grbl/`, which is the other side of
// this protocol, a sender uses no sockets and no clock: its owner passes the time and the received data, and sends what
// take_bytes() returns.
//
// Invariants: the bytes of all unacknowledged lines never exceed the machine's receive buffer, whose size is reported
// by `$I` (128 if not reported). Each response belongs to the oldest unacknowledged line. A refused line, an alarm, a
// restart and a timeout end the stream; after that only commands that stop the machine are sent. Every wait has a
// timeout: the handshake, an unacknowledged line, and a state without progress. Only a hold, an open door and a tool
// change wait for the operator without a limit; waits_for() reports this.
//
// After follow(), GrblFollower compares the reports with the path, and marks ($G) in the stream are counted: the answer
// to a mark must come when all lines before it are answered, so a line that was lost, doubled or cut is noticed. Such a
// fault holds the machine.
//
// Such a machine cannot report its step counts or the line that it executes. The line of a fault is exact for error:n.
// For an alarm it is a range of lines, because the machine's queue contains lines that it has already acknowledged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/sender/grbl_follower.hpp"
#include "passo/sender/grbl_machine.hpp"
#include "passo/sender/grbl_reply.hpp"
#include "passo/sender/grbl_words.hpp"
#include "passo/sender/last_grbl_report.hpp"
#include "passo/sender/unacknowledged_lines.hpp"
#include "passo/units/units.hpp"

namespace passo {

class GrblSender {
 public:
  static constexpr Seconds between_questions{0.2};
  static constexpr Seconds between_urgent_questions{0.05};
  static constexpr Seconds longest_silence{5};
  static constexpr Seconds longest_greeting{20};
  static constexpr Seconds longest_standstill{60};
  // In the state Run, beyond the time that the smallest change of a report takes at the slowest feed in the machine.
  static constexpr Seconds longest_stall{3};
  static constexpr Seconds default_ahead{1};

  // Begins the handshake with the machine at this time. Nothing is sent for 2 s, because an Arduino restarts when its
  // serial port is opened.
  explicit GrblSender(Seconds now);
  // The same for a connection that is open already, so that nothing restarts.
  static GrblSender on_open_line(Seconds now);

  void receive(std::string_view bytes, Seconds now);
  // Returns the bytes to send now. Must be called often.
  std::string take_bytes(Seconds now);

  // Returns whether the machine has identified itself, so that lines may be added. It is idle or in an alarm: see
  // report().
  bool ready() const { return stage_ == Stage::ready; }
  const GrblMachine& machine() const { return machine_; }
  // Returns the machine's messages since the last call: see GrblMachine::take_messages().
  std::vector<std::string> take_messages() { return machine_.take_messages(); }
  // Returns the last status report. Empty: none was received.
  const std::optional<GrblReport>& report() const { return reports_.last(); }
  // Returns the machine position, mm. Empty: not known yet.
  std::optional<Point> place() const { return reports_.place(machine_); }
  // Queries again what a machine in an alarm may not have reported, and its offsets and modes.
  void ask_for_offsets();
  // Returns the alarm during the handshake, as a clause; empty if its cause was not reported.
  std::string alarm_words() const;
  // Returns what the operator must do at the machine before it continues, as a sentence without a full stop. Empty:
  // nothing.
  std::string_view waits_for() const;

  // Adds a line of a program, without its line end. `line`: in the program file. `silence`: how long the machine may
  // not respond because of it (homing, a dwell). Spindle delays are always allowed.
  void add(std::string text, std::uint32_t line = 0, Seconds silence = Seconds(0));
  // Follows the motion from here on, with the settings that the machine has reported; it must be at rest. At most
  // `ahead` of motion lies in the machine then: longer lines are sent in pieces. Reported positions are compared with
  // the path, counts and modes with what was sent; a difference is a fault, at which the machine is held. `zero`: the
  // work zero of the lines, in machine coordinates. A line that is none of GrblCode's ends the comparison of positions
  // until the next call. No effect if the machine has reported no steps per unit, or no position.
  void follow(const Point& zero, Seconds ahead = default_ahead);
  // Ends that, at rest: from here on the machine may be moved by others, e.g. with a pendant.
  void stop_following() { follower_.reset(); }
  // Returns how long the machine still dwells; empty: it moves, or nothing is known.
  std::optional<Seconds> dwell_left() { return follower_ ? follower_->dwell_left(now_) : std::nullopt; }
  // Returns how long the machine moves if it gets nothing more. Without follow(): 0.
  Seconds time_in_machine() { return follower_ ? follower_->time_in_board(now_) : Seconds(0); }
  // Adds a line whose answer take_reply() returns, in the order of the questions. A rejection is no fault.
  void ask(std::string text, Seconds silence = Seconds(0));
  std::optional<GrblAnswer> take_reply() { return window_.take_reply(); }
  // Returns whether only few lines are waiting here.
  bool wants_lines() const { return window_.waiting() < 32; }
  // Returns whether each line was sent and acknowledged.
  bool all_answered() const { return window_.all_answered(); }
  // Returns whether all lines were acknowledged and a later report shows that the machine is idle.
  bool at_rest() const {
    return !fault_ && all_answered() && reports_.came_after(last_.answered) && report()->state == "Idle";
  }
  // Returns the size of the machine's receive buffer, as far as it is known.
  std::size_t buffer_size() const { return window_.usable(machine_.bytes); }
  // Returns the number of bytes that may be in the machine's receive buffer.
  std::size_t unanswered_bytes() const { return window_.sent_bytes(); }
  std::uint64_t lines_sent() const { return window_.lines_sent(); }
  std::uint64_t lines_answered() const { return window_.lines_answered(); }
  // Returns the number of reports received, so that news can be told from the last report.
  std::uint64_t reports_heard() const { return reports_heard_; }
  // Sets a listener for the lines that are neither reports nor answers, e.g. [PRB:…], [MSG:…], and errors that belong
  // to no line of ours.
  void listen(std::function<void(std::string_view)> listener) { listener_ = std::move(listener); }
  // Queries the position more often, e.g. during a jog.
  void look_often(bool often) { looks_often_ = often; }

  void hold();
  void resume();
  // Sets the feed override, percent, 10 to 200, as closely as Grbl allows.
  void override_feed(int percent);
  void override_spindle(int percent);
  // Sets the override of rapids: Grbl has 100, 50 and 25 percent. Returns the percentage that was set.
  int override_rapids(int percent);
  // Returns the overrides that the machine has reported since a change by this sender has taken effect; others may have
  // changed them. Empty: none yet.
  const std::optional<GrblOverrides>& told_overrides() const { return override_.told; }
  // As for an open door: brakes, and switches spindle and coolant off. resume() restores them.
  void open_door() { act('\x84'); }
  // Stops jogging motion, and drops the jog lines that were not sent.
  void cancel_jog();
  // Toggles an output during a program.
  void toggle_flood() { act('\xA0'); }
  void toggle_mist() { act('\xA1'); }
  // In a hold: stops the spindle, or starts it again.
  void toggle_spindle_stop() { act('\x9E'); }
  // Resets the machine at once, whatever it does. Its position is lost if it moves.
  void reset();
  // Brakes along the path, and drops the lines in the machine. stopped() becomes true when that is done; the position
  // is then still known if the machine has reported a stop. Homing is reset immediately.
  void stop();
  bool stops() const { return stage_ == Stage::braking || stage_ == Stage::dropping; }
  bool stopped() const { return stage_ == Stage::stopped; }
  // Notes that the connection is lost.
  void lose();

  // Returns why the stream has ended before its lines.
  const std::optional<GrblFault>& fault() const { return fault_; }

 private:
  enum class Stage : std::uint8_t { waking, clearing, looking, asking, ready, braking, dropping, stopped };
  void act(char byte) { urgent_ += byte; }
  bool greets() const { return stage_ < Stage::ready; }
  void enter(Stage stage);
  void poll(Seconds now);
  void greet();
  void watch();
  void brake();
  void hear(std::string_view line);
  void hear_report(const GrblReport& report);
  void hear_greeting();
  // `error`: the text after "error:". Empty: ok.
  void answer(std::optional<std::string_view> error);
  std::string words_of_error(std::string_view error) const;
  void alarm(std::string_view text);
  std::string words_of_alarm(int number) const;
  void fail(GrblFault fault);
  void end_with(GrblFault fault);
  GrblFault fault_between_lines(std::string code, std::string message) const;
  GrblFault fault_of_greeting() const;
  void fail_and_stop(std::string code, std::string message);
  void fail_and_stop(GrblFollower::Trouble trouble);
  std::string send_lines(Seconds now);
  bool wants_mark() const;
  void hear_modes(std::string_view modes);
  void answer_mark();
  void follow_report(const GrblReport& report);
  void send_overrides();
  void hear_overrides(const GrblReport& report);
  void check_silence();
  void check_lost_bytes();
  void check_standstill();
  bool must_move() const;
  void ask_for_status();
  bool has_work() const { return window_.last_line() != 0; }
  Seconds silence_of_oldest() const { return window_.oldest() == nullptr ? Seconds(0) : window_.oldest()->silence; }
  std::uint32_t first_held_line() const;

  Stage stage_ = Stage::waking;
  Seconds now_{0};
  // Times of the last …
  struct Times {
    Seconds begun{0};     // handshake begun
    Seconds stage{0};     // change of the stage
    Seconds heard{0};     // received byte
    Seconds asked{-1};    // status query
    Seconds answered{0};  // acknowledged line
    Seconds idle{0};      // time at which it was not idle, or had nothing to answer
    Seconds progress{0};  // acknowledgement, or report with a change of state or position
    Seconds told{0};      // line that is not a report
    Seconds polled{0};    // call of take_bytes()
  };
  Times last_;
  std::string came_;  // the incomplete line received so far
  std::string last_line_heard_;
  std::string locked_by_;  // the alarm reported during the handshake
  std::string urgent_;
  UnacknowledgedLines window_;
  bool is_held_ = false;  // the machine was held by hold()
  bool looks_often_ = false;
  std::uint64_t reports_heard_ = 0;
  std::function<void(std::string_view)> listener_;
  GrblMachine machine_;
  LastGrblReport reports_;
  std::optional<GrblFault> fault_;

  std::optional<GrblFollower> follower_;
  // Marks in the stream.
  struct Marks {
    struct Mark {
      GrblLineModes modes;     // that the machine must have there
      std::uint32_t line = 0;  // the last one before
    };
    std::deque<Mark> marked;           // that are not answered yet
    std::optional<std::string> modes;  // told since the oldest of them is the next to be answered
    Seconds sent{0};                   // time of the last one
    std::size_t since = 0;             // lines sent since
    std::uint32_t sure_line = 0;       // the last line before the last mark that was right
  };
  Marks marks_;
  struct Overrides {
    std::deque<char> bytes;  // not sent yet
    Seconds sent{-1};        // time of the last one
    double feed = 1;         // the factor, since the connection
    std::optional<GrblOverrides> told = {};
  };
  Overrides override_;
};

}  // namespace passo
