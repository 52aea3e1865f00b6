// GrblSender: the side of a sender, for an existing machine that speaks Grbl 1.1: greets it, streams lines to it, and
// tells where it stands and what went wrong.
//
//   lines -> GrblSender -> bytes for the machine         real-time bytes go before all lines
//            GrblSender <- bytes of the machine          ok, error:n, ALARM:n, <…>, […], $n=…
//
// Place on the street: beside the street, instead of a board. Like `grbl/`, the other side of this protocol, a sender
// knows no sockets and no clock: its owner tells the time, hands over what came and sends what take_bytes() gives.
//
// Invariants: the bytes of all lines that the machine has not answered never exceed its receive buffer, as `$I` tells
// the buffer's size (128 if it tells none). Each answer belongs to the oldest line without one. A line that the machine
// refuses, an alarm, a restart and silence end the stream; nothing more is sent but what stops the machine. Every wait
// ends: the greeting, a line without an answer, and a state in which nothing goes on have their bounds. Only a hold, a
// door and a tool change wait for people as long as they last, and waits_for() tells it.
//
// What such a machine cannot tell: how many steps it has made, and which line it is executing. The line of a fault is
// exact for error:n. For an alarm it lies between two lines: the machine holds some lines that it has answered already.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "passo/geometry/axes.hpp"
#include "passo/sender/grbl_machine.hpp"
#include "passo/sender/grbl_reply.hpp"
#include "passo/sender/grbl_words.hpp"
#include "passo/units/units.hpp"

namespace passo {

class GrblSender {
 public:
  static constexpr Seconds between_questions{0.2};
  static constexpr Seconds between_urgent_questions{0.05};
  static constexpr Seconds longest_silence{5};
  static constexpr Seconds longest_greeting{20};
  static constexpr Seconds longest_standstill{60};

  // Begins to greet the machine, at this time. Nothing is sent for 2 s: an Arduino whose line is opened starts anew.
  explicit GrblSender(Seconds now);

  void receive(std::string_view bytes, Seconds now);
  // What to send now. Call often.
  std::string take_bytes(Seconds now);

  // The machine has told what it is, and lines may be added. It is idle or in an alarm: see report().
  bool ready() const { return stage_ == Stage::ready; }
  const GrblMachine& machine() const { return machine_; }
  // The last status report. Empty: none has come.
  const std::optional<GrblReport>& report() const { return report_; }
  // Where the machine stands, in machine coordinates, mm. Empty: not known yet.
  std::optional<Point> place() const;
  // Asks again for what a machine in an alarm may not have told, and for its offsets and modes.
  void ask_for_offsets();
  // The alarm that the machine was in when it was greeted, as a clause; empty: it has not told which.
  std::string alarm_words() const;
  // What somebody must do at the machine before it goes on, as a sentence without a full stop. Empty: nothing.
  std::string_view waits_for() const;

  // A line of a program, without its end. `line`: of the program's file. `silence`: how long the machine may be silent
  // because of it (homing, a dwell). Spindles may take their time anyway.
  void add(std::string text, std::uint32_t line = 0, Seconds silence = Seconds(0));
  // Few lines wait here.
  bool wants_lines() const { return waiting_.size() < 32; }
  // Each line was sent and answered.
  bool all_answered() const { return waiting_.empty() && unanswered_.empty(); }
  // All lines were answered, and a report that came later shows that the machine rests.
  bool at_rest() const;
  // Bytes that the machine can hold, as far as it has told.
  std::size_t buffer_size() const { return std::min(machine_.bytes, empty_buffer_); }
  // Bytes of lines that the machine may hold in its receive buffer.
  std::size_t unanswered_bytes() const { return unanswered_bytes_; }
  std::uint64_t lines_sent() const { return lines_sent_; }

  void hold();
  void resume();
  // Percent, 10 to 200, as near as Grbl comes.
  void override_feed(int percent);
  void override_spindle(int percent);
  // Brakes on the path, and drops what the machine holds. stopped() tells when that is done; the place is then known
  // still, if the machine has told that it rests. Homing is reset at once.
  void stop();
  bool stops() const { return stage_ == Stage::braking || stage_ == Stage::dropping; }
  bool stopped() const { return stage_ == Stage::stopped; }
  // The line is gone.
  void lose();

  // Why the stream has ended before its lines did.
  const std::optional<GrblFault>& fault() const { return fault_; }

 private:
  enum class Stage : std::uint8_t { waking, clearing, looking, asking, ready, braking, dropping, stopped };
  struct Line {
    std::string text;  // with its end
    std::uint32_t line = 0;
    Seconds silence{0};
    Seconds sent{0};
  };

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
  // `error`: what follows "error:". Empty: ok.
  void answer(std::optional<std::string_view> error);
  void alarm(std::string_view text);
  std::string words_of_alarm(int number) const;
  void fail(GrblFault fault);
  void end_with(GrblFault fault);
  GrblFault fault_between_lines(std::string code, std::string message) const;
  GrblFault fault_of_greeting() const;
  void check_silence();
  void check_lost_bytes();
  void check_standstill();
  void ask_for_status();
  Seconds silence_of_oldest() const { return unanswered_.empty() ? Seconds(0) : unanswered_.front().silence; }
  std::uint32_t first_held_line() const;

  Stage stage_ = Stage::waking;
  Seconds now_{0};
  Seconds begun_{0};
  Seconds stage_since_{0};
  Seconds heard_{0};     // any byte
  Seconds asked_{-1};    // for the status
  Seconds answered_{0};  // the last line
  Seconds idle_since_{0};
  Seconds progress_{0};  // the last answer, or the last report with another state or place
  Seconds told_{0};      // a line that is no report
  std::string came_;     // a line that is not whole yet
  std::string last_line_heard_;
  std::string locked_by_;  // the alarm that it told while it was greeted
  std::string urgent_;
  std::deque<Line> waiting_;
  std::deque<Line> unanswered_;
  std::size_t unanswered_bytes_ = 0;
  std::uint64_t lines_sent_ = 0;
  std::deque<std::uint32_t> held_lines_;  // answered lines that the planner may still hold
  std::uint32_t last_line_ = 0;
  bool has_work_ = false;  // lines of a program were sent
  bool is_held_ = false;   // by hold()
  GrblMachine machine_;
  std::size_t empty_buffer_ =
      std::numeric_limits<std::size_t>::max();  // bytes that were free in it when it held no line of ours
  std::optional<GrblReport> report_;
  std::optional<Point> offset_;  // of the work, as reported
  Seconds reported_{-1};
  int feed_percent_ = 100;
  int spindle_percent_ = 100;
  std::optional<GrblFault> fault_;
};

}  // namespace passo
