// BoardSession: a host's whole conversation with a board. The board is reached through a port, in this process or at
// the end of a line; the bytes are the same in both. The session says the one hello, and is the only reader of what the
// board says.
//
// Its parts: Handshake is how the two begin, SendWindow has the frames under way, BoardQuestions are those that the
// host has asked, BoardMirror is what the board has told, and SilenceWatch says when it has told nothing for too long.
//
// Only poll() waits, and never longer than it is told. So one thread serves any number of boards, and virtual time
// passes only where its owner lets it pass.
//
// Before the hello, the session may ask the board about itself and for its status, even while the board moves. These
// questions change nothing on the board. Then greet() says hello, and ready() tells when the greeting is complete.
//
// Where nothing is lost on the way, an error that the board reports is a bug on one of the two sides, and final. Where
// something may be lost, the session keeps what it sent until the board has taken it. When the board says that
// something is missing, the session repeats from there: a few frames, then a question how far the board is now, and so
// on until the board has all. After a silence the session asks for the board's status again and again while patience
// lasts. So the session notices when a line comes back, and sends again what the line had swallowed.
//
// A damaged frame that looks like a message is rare, but does happen. So a message that would end the job is believed
// only when it comes again.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/link/board_mirror.hpp"
#include "passo/link/board_port.hpp"
#include "passo/link/board_questions.hpp"
#include "passo/link/handshake.hpp"
#include "passo/link/link.hpp"
#include "passo/link/send_window.hpp"
#include "passo/link/sent_segments.hpp"
#include "passo/link/silence_watch.hpp"
#include "passo/link/twin_motors.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class BoardSession final : public Link {
 public:
  // What a poll brought.
  struct Progress {
    bool news = false;  // an item was done or taken, an answer came, an input changed
    bool heard = false;
  };

  // The constructor sends nothing. The port outlives the session.
  explicit BoardSession(BoardPort& port, const LineCare& care = {});

  // Hears what the board says, and repeats questions that were not answered, until there is news, but no longer than
  // `most`. An endless poll waits for news, and a board that stays silent is then an error.
  Progress poll(Seconds most);

  // Asks `about` or `status`, before the hello or after. settled() tells when the answer has come.
  void inquire(Question question);
  // What was sent last, where somebody wants to look at single pulses: keep() them first.
  SentSegments& sent_segments() { return sent_segments_; }
  // The board's answer to `about`. Empty: the board has not answered.
  const std::optional<About>& about() const { return mirror_.about(); }
  // Readable characters that came before the hello: perhaps the greeting of other firmware.
  const std::string& gibberish() const { return gibberish_; }

  // Says hello. From here on both sides count the motors' fractions of steps from the start.
  void greet(const Greeting& greeting);
  // Gives the board another session number, for instance for a new job. Call after the hello, at rest.
  void name_session(std::uint16_t number);
  // Goes back to the state before the hello, after an error. Questions and another hello may follow.
  void hang_up();
  // Clears the error after a user of the link has failed it because the work could not go on. The board itself is as it
  // was, and at rest.
  void forgive() { error_.reset(); }
  // True: the board has answered the hello, suits, and knows the session's number.
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
  bool answered() const override { return questions_.answered(); }
  Seconds answer_time() const override { return questions_.answer_time(); }
  Seconds time_a_frame() const override { return window_.statistics().time_a_frame(); }
  // The inputs that were switched on since the last call, as the board told or its status shows. Bits of BoardInput.
  std::uint16_t take_pressed() { return mirror_.take_pressed(); }
  // The inputs that are on now, as far as the board has told.
  std::uint16_t inputs() const { return mirror_.inputs(); }
  // After LinkError::stopped: the inputs that stopped the motors, as bits of BoardInput. 0: the board does not know.
  std::uint16_t stopped_by() const { return mirror_.stopped_by(); }
  // The status that first told that the motors have stood still amid motion since the hello, because the board could
  // not make its events in time. The board goes on with what it holds, so this is no error of the link: whoever drives
  // the machine brakes, and then fails the link.
  const std::optional<BoardStatus>& standstill() const { return mirror_.standstill(); }
  Seconds now() const override { return port_.elapsed(); }
  std::optional<LinkError> error() const override { return error_; }
  void fail(LinkError error) override { error_ = error_.value_or(error); }

  std::uint64_t frames_sent() const override { return window_.statistics().frames(); }
  std::uint64_t bytes_sent() const override { return window_.statistics().bytes(); }
  std::uint64_t frames_repeated() const { return window_.statistics().repeated(); }
  // After an axis with two motors was homed, at rest: the counts of first motors are the board's own again, also in
  // status(). True: they were not, because second motors have turned alone.
  bool forget_shifts() { return mirror_.counts() != nullptr && twins_.forget_shifts(mirror_.counts()); }
  // What the board cannot do of the setup in the greeting, after LinkError::cannot_set_up.
  PinSetup undone_setup() const { return handshake_.undone_setup(); }
  // The times that the board gives its step and direction pins, and those that the greeting asked for.
  const StepTiming& timing() const { return handshake_.set_up().timing; }
  const StepTiming& wanted_timing() const { return handshake_.wanted().setup.timing; }
  // The number of motors in the hello; 0 before the hello.
  std::uint8_t motors() const { return handshake_.motors(); }
  // The board's answer to the hello. Empty: the board has not answered.
  const std::optional<HelloReply>& board() const { return handshake_.reply(); }
  // True: the other side of the line has closed it.
  bool hung_up() const { return port_.hung_up(); }
  // For how long nothing was heard of the board, while it had something to say. After patience() that is an error.
  Seconds silent_for() const { return expects() ? silence_.silence(now()) : Seconds(0); }
  Seconds patience() const { return silence_.care().patience; }
  // The board's last status, and when it was heard.
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
  SilenceWatch silence_;
  SendWindow window_;
  BoardQuestions questions_;
  BoardMirror mirror_;
  TwinMotors twins_;
  ProbeWatch probe_;
  SentSegments sent_segments_;
  std::string gibberish_;
  std::optional<LinkError> error_;
  std::uint8_t refused_ = 0;               // sequence number of the frame that the board refused last
  int refusals_ = 0;                       // how many times in a row
  int doubts_ = 0;                         // statuses in a row that would end the job
  bool news_ = false;                      // since poll() began
  std::vector<SendWindow::Frame> frames_;  // the frames of a replacement while it is put together
};

}  // namespace passo
