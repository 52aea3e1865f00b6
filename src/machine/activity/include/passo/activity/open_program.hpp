// OpenProgram: a program that comes line by line and is never complete, as a sender streams it. OpenRun: such a program
// as an activity.
//
// Place on the street: where Program is for a file. Each line is interpreted when it comes, so whoever sent it is told
// at once what is wrong with it. The path items of good lines wait in a queue. A bad line does nothing: it moves
// nothing, and modes, offsets and parameters stay as they were, as if the line had not come.
//
//   lines -> Interpreter -> PathBuilder -> [ queue ] -> OpenRun: PathSmoother -> drive
//
// Where the queue is empty, the path has an action await_line, at which the machine rests. A probe move is built only
// while it is played, because what comes after it depends on what the probe finds. Until then no line is taken.
//
// The queue is bounded: room() tells whether it takes another line. A queue of many short moves is long, for the sake
// of the look-ahead; a queue of long moves is short, so that the sender is not told too early that a line is taken.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "passo/activity/activity.hpp"
#include "passo/activity/wait_words.hpp"
#include "passo/base/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/interpreter/machine_answers.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class OpenProgram final : public Source<PathItem> {
 public:
  // More items are queued only while they last no longer than `enough_time`, and never more than `most_items`.
  static constexpr std::size_t enough_items = 256;
  static constexpr std::size_t most_items = 1024;
  static constexpr Seconds enough_time{10};
  // The machine begins to move when the queue is full, when no line has come for `quiet`, or when the first line has
  // waited for `longest_wait`. So the look-ahead sees more than the first line.
  static constexpr Seconds quiet{0.03};
  static constexpr Seconds longest_wait{0.5};

  // `machine` outlives the program. The options' dialect, units, tools and parameters count.
  OpenProgram(const MachineDescription& machine, InterpreterOptions options, const Point& start);

  // Takes a line without its end, at the time `now`. Returns what is wrong with the line, if anything is. Call only
  // while room().
  [[nodiscard]] std::optional<Diagnostic> add_line(std::string_view line, Seconds now);
  // The same for a jog: axis words and F, with G20, G21, G53, G90 or G91. The modes in force stay as they were.
  [[nodiscard]] std::optional<Diagnostic> add_jog(std::string_view words, Seconds now);
  // The same as add_line(), but nothing of the line is played: the program is only checked.
  [[nodiscard]] std::optional<Diagnostic> check(std::string_view line);
  // What add_line() would say. Nothing changes.
  [[nodiscard]] std::optional<Diagnostic> judge(std::string_view line);

  bool room() const;
  // True: a line has asked the machine, and was not answered yet.
  bool asks() const { return asks_; }
  // True: the last line taken was M2, M30, or one that ends programs. The program begins anew with the next line.
  bool take_ended() { return std::exchange(ended_, false); }
  std::size_t queued() const { return queue_.size(); }
  // How the path may pass the end of the segment that was pulled last.
  PathMode last_mode() const { return last_mode_; }
  // True: the items are a jog.
  bool jogs() const { return jogs_; }

  // For the session that plays the path: whether a machine that rests is to go on, and whether a machine that moves is
  // to wait a little with pulling more.
  bool is_to_begin(Seconds now) const;
  bool expects_more(Seconds now) const;
  AnswerBook& answers() { return answers_; }
  // Why the last question of the program has ended the program, if it did: G38.2 without a contact.
  const std::optional<Diagnostic>& answer_fault() const { return answer_fault_; }

  // Never ends; see above.
  [[nodiscard]] bool next(PathItem& item) override;

  // Drops what is queued. The program goes on from `place`, with its modes.
  void drop(const Point& place);
  // Begins anew at `place`, as grbl after a reset: modes as at first, and G54. The offsets of the work systems stay;
  // G92 and the tool offset are forgotten.
  void restart(const Point& place);
  // Drops what is queued, and goes on from `place`, with modes and offsets. The outputs are off.
  void go_on_at(const Point& place);
  // The same, with the work systems' offsets and the homes of G28 and G30 from `parameters`.
  void apply_offsets(const SavedParameters& parameters, const Point& place);

  ModesInForce modes() const { return interpreter_->modes(); }
  SavedParameters parameters() const { return interpreter_->saved_parameters(); }
  const ToolTable& tools() const { return interpreter_->tools(); }
  WaitWords& wait_words() { return wait_words_; }
  // The source line of the item that was pulled last: the value of its N word, below 0: none.
  std::int64_t line_number() const { return line_number_; }

 private:
  void begin(const Point& start);
  void begin_with(const ModesInForce& modes, int motion, const Point& place);
  void begin_after_end();
  void forget_queue();
  std::optional<Diagnostic> read(std::string_view line);
  std::optional<Diagnostic> queue_line(std::string_view line, Seconds now, bool jogs);
  void push(const PathItem& item);
  bool pull_answer(PathItem& item);
  void roll_back(std::size_t kept);

  InterpreterOptions options_;
  MotionLimits limits_;
  PathOptions path_options_;
  Diagnostics diagnostics_;
  AnswerBook answers_;
  std::unique_ptr<Interpreter> interpreter_;
  std::unique_ptr<Tap<Operation>> operations_;
  std::unique_ptr<PathBuilder> builder_;
  std::deque<PathItem> queue_;
  Seconds queued_time_{0};
  Seconds first_came_{0};  // the first line of the queue
  Seconds last_came_{0};
  bool asks_ = false;
  bool ended_ = false;
  bool jogs_ = false;
  std::optional<Diagnostic> answer_fault_;
  WaitWords wait_words_;
  WaitWords kept_words_;  // before the line that was read last
  OutputState outputs_;   // after the last item pulled
  std::int64_t line_number_ = -1;
  PathMode last_mode_ = PathMode::exact_stop;
};

class OpenRun final : public Activity {
 public:
  // `program` outlives the run.
  OpenRun(OpenProgram& program, const MachineDescription& machine);

  ActivityKind kind() const override { return program_.jogs() ? ActivityKind::jog : ActivityKind::program; }
  [[nodiscard]] bool next(PathItem& item) override { return smoother_.next(item); }

 private:
  OpenProgram& program_;
  PathSmoother smoother_;
};

}  // namespace passo
