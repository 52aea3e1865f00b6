// BoardSession: a host's whole conversation with a board. The board is reached through a port, in this process or at
// the end of a line; the bytes are the same in both. The session says the one hello, and is the only reader of what the
// board says.
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
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "passo/link/board_port.hpp"
#include "passo/link/link.hpp"
#include "passo/link/sent_segments.hpp"
#include "passo/link/twin_motors.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// How to handle a line on which bytes may get lost. The default is for a line that loses nothing.
struct LineCare {
  Seconds answer_within{std::numeric_limits<double>::infinity()};  // after so long without an answer, ask again
  Seconds patience{3600};                                          // after so long without any word, give up
};

// How a host begins with a board.
struct Greeting {
  std::uint8_t motors = 0;
  std::uint16_t session = 0;          // identifies the session to the board; 0: none, for a line that loses nothing
  std::uint8_t number = 0;            // the hello's number: where the counting of items begins
  Silence silence = {};               // goes with the session: after what silence the board switches its outputs off
  std::vector<MotorPair> pairs = {};  // motors that turn an axis together; the host plans those before them only
  PinSetup setup = {};                // what is connected to the board's pins; the board must be able to do all of it
};

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
  const std::optional<About>& about() const { return about_; }
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
  bool ready() const { return phase_ == Phase::ready && !error_; }

  void send(const BoardSegment& segment) override;
  void send(const BoardOutputs& outputs) override;
  ItemNumber replace(ItemNumber after, std::span<const LinkItem> items) override;
  ItemNumber sent() const override { return sent_; }
  ItemNumber executed() const override { return executed_; }
  int room() const override { return std::min(free_, most_untaken) - later_by(sent_, taken_); }
  int places() const override { return free_ - later_by(sent_, taken_); }
  bool rests() const override { return rests_; }
  bool outputs_timed_out() const override { return outputs_timed_out_; }
  bool busy() const override { return sent_ != executed_; }

  void watch_probe(ProbeUntil until, std::uint8_t limit = 0) override;
  void recall_contact() override;
  void read_spindle() override;
  void rehearse(std::size_t bytes) override;
  bool settled() const override { return !awaited_ || error_; }

  const ProbeReport& probe_report() const override { return probe_.report(); }
  void ask() override;
  void ask_for_spindle(bool wanted) override { usual_question_ = wanted ? Question::spindle : Question::status; }
  std::optional<Turned> take_turned() override { return std::exchange(turned_, std::nullopt); }
  bool answered() const override { return answered_; }
  Seconds answer_time() const override { return answer_time_; }
  Seconds time_a_frame() const override { return time_a_frame_; }
  // The inputs that were switched on since the last call, as the board told or its status shows. Bits of BoardInput.
  std::uint16_t take_pressed() { return std::exchange(pressed_, std::uint16_t{0}); }
  // The inputs that are on now, as far as the board has told.
  std::uint16_t inputs() const { return inputs_; }
  // After LinkError::stopped: the inputs that stopped the motors, as bits of BoardInput. 0: the board does not know.
  std::uint16_t stopped_by() const { return stopped_by_; }
  // The status that first told that the motors have stood still amid motion since the hello, because the board could
  // not make its events in time. The board goes on with what it holds, so this is no error of the link: whoever drives
  // the machine brakes, and then fails the link.
  const std::optional<BoardStatus>& standstill() const { return standstill_; }
  Seconds now() const override { return port_.elapsed(); }
  std::optional<LinkError> error() const override { return error_; }
  void fail(LinkError error) override { error_ = error_.value_or(error); }

  std::uint64_t frames_sent() const override { return frames_sent_; }
  std::uint64_t bytes_sent() const override { return bytes_sent_; }
  std::uint64_t frames_repeated() const { return frames_repeated_; }
  // After an axis with two motors was homed, at rest: the counts of first motors are the board's own again, also in
  // status(). True: they were not, because second motors have turned alone.
  bool forget_shifts() { return status_ && twins_.forget_shifts(status_->positions); }
  // What the board cannot do of the setup in the greeting, after LinkError::cannot_set_up.
  PinSetup undone_setup() const;
  // The times that the board gives its step and direction pins, and those that the greeting asked for.
  const StepTiming& timing() const { return set_up_.timing; }
  const StepTiming& wanted_timing() const { return setup_.timing; }
  // The number of motors in the hello; 0 before the hello.
  std::uint8_t motors() const { return motors_; }
  // The board's answer to the hello. Empty: the board has not answered.
  const std::optional<HelloReply>& board() const { return board_; }
  // True: the other side of the line has closed it.
  bool hung_up() const { return port_.hung_up(); }
  // For how long nothing was heard of the board, while it had something to say. After patience() that is an error.
  Seconds silent_for() const { return expects() ? now() - heard_ : Seconds(0); }
  Seconds patience() const { return care_.patience; }
  // The board's last status, and when it was heard.
  const std::optional<BoardStatus>& status() const { return status_; }
  Seconds status_time() const { return status_time_; }

 private:
  enum class Phase : std::uint8_t { before_hello, greeting, naming, ready };
  struct Frame {
    ItemNumber number = 0;
    std::uint8_t size = 0;
    std::uint8_t bytes[largest_frame] = {};
  };

  // A sequence number is a byte. Half of the numbers are reserved for frames that come again.
  static constexpr int most_untaken = 127;
  // In bytes, of the frames on the wire that a small board has not taken. It keeps 256 received bytes; the rest is for
  // questions. A board with many places takes frames as fast as they come.
  static constexpr std::size_t most_under_way = 224;
  static constexpr int many_places = 200;

  bool may_lose() const { return care_.answer_within < Seconds(std::numeric_limits<double>::infinity()); }
  void forget_what_was();
  void say_hello();
  void say_session();
  void take(const PinSetup& setup);
  bool is_set_up() const;
  void look_at_greeting();
  bool hear(Seconds most);
  bool expects() const;
  void begin_to_expect();
  void mind_silence(bool heard, bool endless);
  bool overdue() const;
  void ask_again();
  void ask(Question question);
  void await(Question question);
  void read(std::uint8_t byte);
  void take(const WireFrame& frame);
  void take(const Credit& credit);
  void take(const BoardStatus& status);
  void take(const ErrorReport& error);
  void take(const Fault& fault);
  void take(const Captured& captured);
  void take(const Turned& turned);
  void settle(Question answered);
  void note_answer(std::uint8_t taken);
  void note_progress(const Credit& credit, std::uint8_t answers);
  bool holds_nothing_of(const Credit& credit) const;
  void doubt(LinkError error, Question again = Question::status);
  [[nodiscard]] bool note_standstill(const BoardStatus& status);
  void note_inputs(const BoardStatus& status);
  void note_timeout(const BoardStatus& status);
  void note_probe(ProbeWatch::News news);
  void note_taken(std::uint8_t sequence);
  void note_end_of_burst();
  void repeat();
  void put_frames_on_wire();
  bool is_small() const { return board_ && board_->capacity < many_places; }
  template <class Message, class... More>
  void say(const Message& message, More... more) {
    std::uint8_t frame[largest_frame];
    put_on_wire(frame, encode(message, more..., frame));
  }
  template <class Message, class... More>
  void send_counted(const Message& message, More... more);
  void send_frame(const Frame& frame);
  void put_on_wire(const std::uint8_t* frame, std::uint8_t size);

  BoardPort& port_;
  LineCare care_;
  Decoder decoder_;
  Phase phase_ = Phase::before_hello;
  std::uint8_t motors_ = 0;
  std::uint8_t greeting_ = 0;  // the hello's own number
  std::uint16_t session_ = 0;
  Silence silence_;
  PinSetup setup_;
  TwinMotors twins_;
  PinSetup set_up_;     // as the board has answered
  Seconds greeted_{0};  // when the hello or the session's number was said last
  std::optional<HelloReply> board_;
  std::optional<About> about_;
  std::string gibberish_;
  std::optional<BoardStatus> status_;
  Seconds status_time_{0};
  std::optional<LinkError> error_;
  ItemNumber sent_ = 0;              // number of the last frame sent
  ItemNumber on_wire_ = 0;           // number of the last frame put on the wire; the later ones wait
  ItemNumber taken_ = 0;             // number of the last frame that the board has, as it told
  ItemNumber executed_ = 0;          // number of the last item that is done, as the board told
  ItemNumber asked_behind_ = 0;      // the last frame on the wire when the board was last asked
  bool question_waits_ = false;      // for the frames that wait
  std::optional<Question> awaited_;  // the host goes on when this is answered
  std::uint8_t question_ = 0;        // the number of the last question
  Question last_question_ = Question::status;
  Question usual_question_ = Question::status;
  std::optional<Turned> turned_;
  std::optional<Seconds> rehearsed_;  // when the rehearsal began
  std::uint8_t repeated_before_ = 0;  // the question after the frames that were repeated last
  bool repeating_ = false;            // frames were repeated, and the answer after them was not heard
  std::uint8_t refused_ = 0;          // sequence number of the frame that the board refused last
  int refusals_ = 0;                  // how many times in a row
  int doubts_ = 0;                    // statuses in a row that would end the job
  int free_ = 0;                      // the room that the board last told
  bool rests_ = false;
  bool outputs_timed_out_ = false;  // as the board last told, and no outputs were sent since
  std::optional<BoardStatus> standstill_;
  ProbeWatch probe_;
  SentSegments sent_segments_;
  bool answered_ = true;  // the board has answered since the last frame was sent
  Seconds unanswered_since_{0};
  std::uint16_t inputs_ = 0;
  std::uint16_t pressed_ = 0;
  std::uint16_t stopped_by_ = 0;
  Seconds answer_time_{0};
  bool news_ = false;          // since poll() began
  std::vector<Frame> frames_;  // the frames of a replacement while it is put together
  std::deque<Frame> kept_;     // frames sent and, as far as the host knows, not taken
  std::size_t burst_ = 0;      // frames sent since nothing was kept
  Seconds burst_began_{0};
  Seconds time_a_frame_{0};
  Seconds heard_{0};        // when the board last said anything
  Seconds progressed_{0};   // when the board last answered, took or executed something
  Seconds quiet_since_{0};  // when the board did, or was asked again
  Seconds moved_on_{0};     // when the board last took something, or the host asked or sent
  std::uint64_t frames_sent_ = 0;
  std::uint64_t bytes_sent_ = 0;
  std::uint64_t frames_repeated_ = 0;
};

// Whether all times are as long as needed, and events as close.
bool suffices(const StepTiming& given, const StepTiming& needed);
// What a board makes that does not suffice, as the object of a sentence. `clock`: its ticks a second.
std::string words_of_timing(const StepTiming& given, const StepTiming& needed, double clock);
// The pins of a setup, as words: "door, limit 4". Limits are counted from 1.
std::string words_of_setup(const PinSetup& setup);

}  // namespace passo
