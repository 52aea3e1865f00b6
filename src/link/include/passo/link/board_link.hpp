// BoardLink: the link to a board behind a port, in this process or at the end of a line. The bytes are the same in
// both.
//
// The board plays only when the host has to wait for it: with no room left, in wait() and in drain(). So its queue is
// as full as the host wants it, and a run gives the same bytes every time.
//
// Where nothing is lost on the way an error that the board reports is a bug on one of the two sides, and final. Where
// something may be lost, what was sent is kept until the board has taken it, and repeated from where the board
// says that something is missing: a few frames, and a question how far it is now, and so on until it has all. After a
// silence the link asks the board how it is, again and again while patience lasts: a line that comes back is found by
// that, and what it had swallowed is sent again.
//
// Damage that looks like a message is rare, but not never: what would end the job is believed when it comes again.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "passo/link/board_port.hpp"
#include "passo/link/link.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// Of a line on which bytes may get lost. The default is one that loses nothing.
struct LineCare {
  Seconds answer_within{std::numeric_limits<double>::infinity()};  // after so long without an answer, ask
  Seconds patience{3600};                                          // and after so long, give up
  std::uint16_t session = 0;                                       // by which the board is known again; not 0
  std::uint8_t greeting = 0;                                       // of the hello: where numbers begin
};

class BoardLink final : public Link {
 public:
  // Says hello: from here on both sides count the motors' fractions from the start. The port outlives the link.
  BoardLink(BoardPort& port, std::uint8_t motors, const LineCare& care = {});

  void send(const BoardSegment& segment) override;
  void send(const BoardOutputs& outputs) override;
  ItemNumber replace(ItemNumber after, std::span<const LinkItem> items) override;
  ItemNumber sent() const override { return sent_; }
  ItemNumber executed() const override { return executed_; }
  int room() const override { return std::min(free_, most_untaken) - later_by(sent_, taken_); }
  int places() const override { return free_ - later_by(sent_, taken_); }
  bool rests() const override { return rests_; }
  void drain() override;
  bool busy() const override { return sent_ != executed_; }
  void wait() override;
  // Lets time pass on the board's side, and hears what it says meanwhile.
  void let_pass(Seconds time);
  void watch_probe(ProbeUntil until, std::uint8_t limit = 0) override;
  const ProbeReport& probe_report() const override { return probe_report_; }
  void recall_contact() override;
  void ask() override { ask(usual_question_); }
  void ask_for_spindle(bool wanted) override { usual_question_ = wanted ? Question::spindle : Question::status; }
  std::optional<Turned> take_turned() override { return std::exchange(turned_, std::nullopt); }
  // Sends so many bytes that say nothing new, and a question: how long that takes until it is answered, as a refill of
  // that size will. At rest.
  Seconds rehearse(std::size_t bytes);
  // Asks where the spindle is, and waits for the answer. False where there is none.
  bool read_spindle();
  bool answered() const override { return answered_; }
  Seconds answer_time() const override { return answer_time_; }
  // What has been switched on, as the board told or its status shows, since this was asked last. Bits of BoardInput.
  std::uint16_t take_pressed() { return std::exchange(pressed_, std::uint16_t{0}); }
  // What is switched on now, as far as it has told.
  std::uint16_t inputs() const { return inputs_; }
  // At rest: asks how the board is, and lets time pass until something is switched on, but no more than `most`.
  void listen_for(Seconds most);
  std::optional<LinkError> error() const override { return error_; }
  void fail(LinkError error) override { error_ = error_.value_or(error); }

  std::uint64_t frames_sent() const override { return frames_sent_; }
  std::uint64_t bytes_sent() const override { return bytes_sent_; }
  std::uint64_t frames_repeated() const { return frames_repeated_; }
  // What the board said it is; nothing where it did not answer.
  const std::optional<HelloReply>& board() const { return board_; }
  // What it said when it was last asked.
  const std::optional<BoardStatus>& status() const { return status_; }

 private:
  struct Frame {
    ItemNumber number = 0;
    std::uint8_t size = 0;
    std::uint8_t bytes[largest_frame] = {};
  };

  // A sequence number is a byte, and half of them are for frames that come again.
  static constexpr int most_untaken = 127;

  bool may_lose() const { return care_.answer_within < Seconds(std::numeric_limits<double>::infinity()); }
  void say_hello();
  void name_session();
  void wait_for_room();
  template <class Again>
  bool listen(Again again);
  bool listen();
  template <class Done>
  bool hear_until(Done done);
  bool hear();
  bool hear(Seconds most);
  bool overdue() const;
  void ask(Question question);
  std::uint16_t watched() const { return limit_ != 0 ? std::uint16_t{limit_} : std::uint16_t{input_probe}; }
  void take(const WireFrame& frame);
  void take(const Credit& credit);
  void take(const BoardStatus& status);
  void take(const ErrorReport& error);
  void take(const Captured& captured);
  void take(const Turned& turned);
  void note_answer(std::uint8_t taken);
  void note_progress(const Credit& credit, std::uint8_t answers);
  bool holds_nothing_of(const Credit& credit) const;
  void doubt(LinkError error, Question again = Question::status);
  void note_inputs(const BoardStatus& status);
  void note_probe(const BoardStatus& status);
  void note_taken(std::uint8_t sequence);
  void repeat();
  template <class Message, class... More>
  void say(const Message& message, More... more);
  template <class Message, class... More>
  void send_counted(const Message& message, More... more);
  void send_frame(const Frame& frame);
  void put_on_wire(const std::uint8_t* frame, std::uint8_t size);

  BoardPort& port_;
  std::uint8_t motors_;
  LineCare care_;
  Decoder decoder_;
  std::optional<HelloReply> board_;
  std::optional<BoardStatus> status_;
  std::optional<LinkError> error_;
  ItemNumber sent_;            // number of the last frame sent
  ItemNumber taken_;           // of the last one that the board told to have
  ItemNumber executed_;        // of the last item that it told to be done
  ItemNumber asked_behind_;    // the last one sent when the board was last asked
  std::uint8_t question_ = 0;  // the number of that
  Question last_question_ = Question::status;
  Question usual_question_ = Question::status;
  std::optional<Turned> turned_;
  std::uint8_t repeated_before_ = 0;  // the question behind what was repeated last
  bool repeating_ = false;            // and not heard the answer since
  std::uint8_t refused_ = 0;          // sequence number of the frame that the board refused last
  int refusals_ = 0;                  // so many times in a row
  int doubts_ = 0;                    // statuses in a row that would end the job
  int free_ = 0;                      // room that it had when it told so
  bool rests_ = false;
  ProbeUntil probe_until_ = ProbeUntil::off;
  std::uint8_t limit_ = 0;  // that is watched in the probe's place
  ProbeReport probe_report_;
  bool began_as_wanted_ = false;  // the probe was as it is to become
  std::optional<Captured> recalled_;
  std::array<std::int32_t, max_motors> probed_from_{};  // positions when the watch began
  bool answered_ = true;                                // since the last frame was sent
  Seconds unanswered_since_{0};
  std::uint16_t inputs_ = 0;
  std::uint16_t pressed_ = 0;
  Seconds answer_time_{0};
  bool news_ = false;          // since wait() began
  std::vector<Frame> frames_;  // of a replacement that is put together
  std::deque<Frame> kept_;     // those that were sent and, as far as we know, not taken
  Seconds heard_{0};           // when the board last said anything
  Seconds moved_on_{0};        // when it last took something, or we asked or sent
  std::uint64_t frames_sent_ = 0;
  std::uint64_t bytes_sent_ = 0;
  std::uint64_t frames_repeated_ = 0;
};

}  // namespace passo
