// BoardSession: the communication of a host with a board, through a port. The board may be simulated in this process or
// real; the bytes are the same. The session performs the handshake, and is the only reader of the board's messages.
//
// Its parts: Handshake starts the session, SendWindow keeps the unacknowledged frames, BoardQueries the open queries,
// BoardMirror the state that the board has reported, and TimeoutMonitor the timeouts.
//
// Only poll() waits, and at most for the given time. One thread can thus serve any number of boards, and simulated time
// passes only where its owner allows.
//
// Before the handshake, the session can query the board's type and status, even while the board moves. These queries
// change nothing on the board. Then greet() starts the handshake, and ready() shows when it is complete.
//
// On a link that loses nothing, an error reported by the board is a bug of the host or the board, and final. On a link
// that may lose bytes, the session keeps each frame until the board has acknowledged it. If the board reports a missing
// frame, the session repeats from there: a few frames, then a query of the board's progress, and so on until the board
// has received all. During a silence, the session queries the board's status until the timeout. It thus notices when a
// connection comes back, and repeats the lost frames.
//
// A damaged frame can look like a valid message, although rarely. A message that would end the job must therefore
// arrive twice.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/link/board_mirror.hpp"
#include "passo/link/board_port.hpp"
#include "passo/link/board_queries.hpp"
#include "passo/link/handshake.hpp"
#include "passo/link/handwheel_query.hpp"
#include "passo/link/link.hpp"
#include "passo/link/send_window.hpp"
#include "passo/link/sent_segments.hpp"
#include "passo/link/timeout_monitor.hpp"
#include "passo/link/twin_motors.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class BoardSession final : public Link {
 public:
  // The result of a poll.
  struct Progress {
    bool news = false;  // an item was executed or accepted, an answer arrived, or an input changed
    bool heard = false;
  };

  // The constructor sends nothing. The port must outlive the session.
  explicit BoardSession(BoardPort& port, const LinkTimeouts& care = {});

  // Processes the board's messages, and repeats unanswered queries, until something has changed, but for at most
  // `most`. With an infinite `most`, a board that stays silent is an error.
  Progress poll(Seconds most);

  // Queries `about` or `status`, before or after the handshake. settled() shows when the answer has arrived.
  void inquire(Question question);
  // The last sent segments, for views of single pulses. Call keep() on it first.
  SentSegments& sent_segments() { return sent_segments_; }
  // The board's answer to `about`. Empty: the board has not answered.
  const std::optional<About>& about() const { return mirror_.about(); }
  // Readable characters received before the handshake, e.g. the welcome message of other firmware.
  const std::string& gibberish() const { return gibberish_; }

  // Starts the handshake. From here on, both sides count the fractions of steps from zero.
  void greet(const Greeting& greeting);
  // Gives the board another session number, e.g. for a new job. Call it after the handshake, while the board is
  // stopped.
  void name_session(std::uint16_t number);
  // Returns to the state before the handshake, after an error. Queries and another handshake may follow.
  void hang_up();
  // Clears an error that a user of the link had set with fail(). The board itself is unchanged, and stopped.
  void forgive() { error_.reset(); }
  // Returns true if the handshake is complete: the board has answered, suits the machine, and has the session's number.
  bool ready() const { return handshake_.phase() == Handshake::Phase::ready && !error_; }

  void send(const BoardSegment& segment) override;
  void send(const BoardOutputs& outputs) override;
  ItemNumber replace(ItemNumber after, std::span<const LinkItem> items) override;
  ItemNumber sent() const override { return window_.sent(); }
  ItemNumber executed() const override { return mirror_.executed(); }
  int room() const override { return std::min(mirror_.free(), SendWindow::most_untaken) - window_.untaken(); }
  int places() const override { return mirror_.free() - window_.untaken(); }
  bool rests() const override { return mirror_.rests(); }
  bool outputs_timed_out() const override { return mirror_.outputs_timed_out(); }
  bool busy() const override { return sent() != executed(); }

  void watch_probe(ProbeUntil until, std::uint8_t limit = 0) override;
  void recall_contact() override;
  void read_spindle() override;
  void rehearse(std::size_t bytes) override;
  bool settled() const override { return !questions_.awaited() || error_; }

  const ProbeReport& probe_report() const override { return probe_.report(); }
  void ask() override;
  void ask_for_spindle(bool wanted) override { questions_.ask_usually(wanted ? Question::spindle : Question::status); }
  std::optional<Turned> take_turned() override { return questions_.take_turned(); }
  // Queries the handwheel at the board's pins, unless such a query is open. handwheel() has the answer.
  void ask_for_handwheel();
  HandwheelQuery& handwheel() { return handwheel_; }
  bool awaits_handwheel() const { return handwheel_.is_open(now()); }
  bool answered() const override { return questions_.answered(); }
  Seconds answer_time() const override { return questions_.answer_time(); }
  Seconds time_a_frame() const override { return window_.statistics().time_a_frame(); }
  // The inputs that were activated since the last call, as bits of BoardInput.
  std::uint16_t take_pressed() { return mirror_.take_pressed(); }
  // The active inputs, as last reported.
  std::uint16_t inputs() const { return mirror_.inputs(); }
  // After LinkError::stopped: the inputs that stopped the motors, as bits of BoardInput. 0: unknown.
  std::uint16_t stopped_by() const { return mirror_.stopped_by(); }
  // The first status since the handshake which reports that the motors stopped during motion, because the board could
  // not make its events in time. The board continues with its queue, so this is not an error of the link: the
  // controlling object stops the machine, and then calls fail().
  const std::optional<BoardStatus>& standstill() const { return mirror_.standstill(); }
  Seconds now() const override { return port_.elapsed(); }
  std::optional<LinkError> error() const override { return error_; }
  void fail(LinkError error) override { error_ = error_.value_or(error); }

  std::uint64_t frames_sent() const override { return window_.statistics().frames(); }
  std::uint64_t bytes_sent() const override { return window_.statistics().bytes(); }
  std::uint64_t frames_repeated() const { return window_.statistics().repeated(); }
  // Call after an axis with two motors was homed, while stopped. Restores the board's own counts of first motors, also
  // in status(). Returns true if they differed because second motors had turned alone.
  bool forget_shifts() { return mirror_.counts() != nullptr && twins_.forget_shifts(mirror_.counts()); }
  // After LinkError::cannot_set_up: the part of the pin set-up that the board does not support.
  PinSetup undone_setup() const { return handshake_.undone_setup(); }
  // The step and direction timing of the board, and the requested timing.
  const StepTiming& timing() const { return handshake_.set_up().timing; }
  const StepTiming& wanted_timing() const { return handshake_.wanted().setup.timing; }
  // The number of motors in the handshake; 0 before it.
  std::uint8_t motors() const { return handshake_.motors(); }
  // The board's answer in the handshake. Empty: the board has not answered.
  const std::optional<HelloReply>& board() const { return handshake_.reply(); }
  // Returns true if the other side has closed the connection.
  bool hung_up() const { return port_.hung_up(); }
  // The time without a message from the board, although one is due. After patience() this is an error.
  Seconds silent_for() const { return expects() ? silence_.silence(now()) : Seconds(0); }
  Seconds patience() const { return silence_.care().patience; }
  // The board's last status, and the time of its arrival.
  const std::optional<BoardStatus>& status() const { return mirror_.status(); }
  Seconds status_time() const { return mirror_.status_time(); }

 private:
  void forget_what_was(ItemNumber number);
  void send_hello();
  void send_session();
  void check_greeting();
  bool hear(Seconds most);
  bool expects() const;
  void begin_to_expect();
  void check_silence(bool heard, bool endless);
  bool overdue() const;
  void ask_again();
  void ask(Question question);
  void await(Question question);
  void read(std::uint8_t byte);
  void handle(const WireFrame& frame);
  void handle(const PinSetup& setup);
  void handle(const Credit& credit);
  void handle(const BoardStatus& status);
  void handle(const ErrorReport& error);
  void handle(const Fault& fault);
  void handle(const Captured& captured);
  void handle(const Turned& turned);
  void settle(Question answered);
  void on_answer(std::uint8_t taken);
  void on_progress(const Credit& credit, std::uint8_t answers);
  bool holds_nothing_of(const Credit& credit) const;
  void doubt(LinkError error, Question again = Question::status);
  [[nodiscard]] bool on_standstill(const BoardStatus& status);
  void on_probe_news(ProbeWatch::News news);
  void on_accepted(std::uint8_t sequence);
  void repeat();
  void send_frame(const SendWindow::Frame& frame);
  void put_frames_on_wire();
  std::size_t most_under_way() const;
  template <class Message, class... More>
  void say(const Message& message, More... more) {
    std::uint8_t frame[largest_frame];
    window_.put({frame, encode(message, more..., frame)});
  }
  template <class Message, class... More>
  void send_counted(const Message& message, More... more);

  BoardPort& port_;
  Decoder decoder_;
  Handshake handshake_;
  TimeoutMonitor silence_;
  SendWindow window_;
  BoardQueries questions_;
  HandwheelQuery handwheel_;
  BoardMirror mirror_;
  TwinMotors twins_;
  ProbeWatch probe_;
  SentSegments sent_segments_;
  std::string gibberish_;
  std::optional<LinkError> error_;
  std::uint8_t refused_ = 0;               // sequence number of the frame that the board rejected last
  int refusals_ = 0;                       // number of rejections in a row
  int doubts_ = 0;                         // consecutive status messages that would end the job
  bool news_ = false;                      // since poll() began
  std::vector<SendWindow::Frame> frames_;  // the frames of a queue update while it is assembled
};

}  // namespace passo
