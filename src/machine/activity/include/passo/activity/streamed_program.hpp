// StreamedProgram: a program that arrives line by line and is never complete, e.g. from a sender. StreamedProgramRun:
// such a program as an activity.
//
// Position in the pipeline: the same as Program for a file. Each line is interpreted when it arrives, so that errors
// are reported immediately. The path items of valid lines wait in a queue. A line with an error has no effect: it moves
// nothing, and modes, offsets and parameters stay as they were.
//
//   lines -> Interpreter -> PathBuilder -> [ queue ] -> StreamedProgramRun: PathSmoother -> drive
//
// While the queue is empty, the next path item is an action await_line, at which the machine stops. A probe move is
// built only when it is executed, because the following lines depend on its result. Until then, no line is accepted.
//
// room() shows whether the queue accepts another line. A queue of many short moves is long, for the look-ahead; a queue
// of long moves is short, so that lines are not acknowledged too early.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "passo/activity/activity.hpp"
#include "passo/activity/line_queue.hpp"
#include "passo/activity/operator_messages.hpp"
#include "passo/base/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class StreamedProgram final : public Source<PathItem> {
 public:
  // `machine` must outlive the program. Of the options, the dialect, units, tools and parameters are used.
  StreamedProgram(const MachineDescription& machine, InterpreterOptions options, const Point& start);

  // Interprets a line without its line end, at the time `now`. Returns the error in the line, if any. Call only while
  // room().
  [[nodiscard]] std::optional<Diagnostic> add_line(std::string_view line, Seconds now);
  // The same for a jog: axis words and F, with G20, G21, G53, G90 or G91. Modal states are unchanged.
  [[nodiscard]] std::optional<Diagnostic> add_jog(std::string_view words, Seconds now);
  // The same as add_line(), but the line is only checked and not executed.
  [[nodiscard]] std::optional<Diagnostic> check(std::string_view line);
  // Returns the result that add_line() would have, without any change.
  [[nodiscard]] std::optional<Diagnostic> judge(std::string_view line);

  // Whether the machine may change tools by moves of its own (M6 with [tool_change]): its position is known. Otherwise
  // add_line() refuses them. True at first.
  void allow_tool_changes(bool allows) { allows_changes_ = allows; }

  bool room() const { return !asks_ && queue_.has_room(); }
  // Returns true if a line needs a result from the machine, which is not available yet.
  bool asks() const { return asks_; }
  // Returns true if the last line was M2, M30 or another program end. The next line starts a new program.
  bool take_ended() { return std::exchange(ended_, false); }
  std::size_t queued() const { return queue_.size(); }
  // The path mode at the end of the segment that was pulled last.
  PathMode last_mode() const { return last_mode_; }
  // Returns true if the items are a jog.
  bool jogs() const { return jogs_; }

  // For the session that executes the path: whether a stopped machine is to start, and whether a moving machine is to
  // wait a little before it pulls more items.
  bool is_to_begin(Seconds now) const { return asks_ || queue_.is_to_begin(now); }
  bool expects_more(Seconds now) const { return !asks_ && queue_.expects_more(now); }
  StoredResults& answers() { return answers_; }
  // The error with which the last machine result ended the program, if it did: G38.2 without a contact.
  const std::optional<Diagnostic>& answer_fault() const { return answer_fault_; }

  // Never returns false; see above.
  [[nodiscard]] bool next(PathItem& item) override;

  // Drops the queue. The program continues from `place`, with its modal state.
  void drop(const Point& place);
  // Restarts at `place`, like grbl after a reset: default modal state, and G54. Work offsets are kept; G92 and the tool
  // offset are cleared.
  void restart(const Point& place);
  // Drops the queue, and continues from `place`, with modal state and offsets. The outputs are off.
  void go_on_at(const Point& place);
  // The same, with the work offsets and the G28 and G30 positions of `parameters`.
  void apply_offsets(const SavedParameters& parameters, const Point& place);

  ActiveModes modes() const { return interpreter_->modes(); }
  SavedParameters parameters() const { return interpreter_->saved_parameters(); }
  const ToolTable& tools() const { return interpreter_->tools(); }
  OperatorMessages& operator_messages() { return operator_messages_; }
  // The N word of the source line of the item that was pulled last; negative: none.
  std::int64_t line_number() const { return line_number_; }

 private:
  void begin(const Point& start);
  void begin_with(const ActiveModes& modes, int motion, const Point& place);
  void begin_after_end();
  void forget_queue();
  std::optional<Diagnostic> read(std::string_view line, bool jogs = false);
  std::optional<Diagnostic> queue_line(std::string_view line, Seconds now, bool jogs);
  bool pull_answer(PathItem& item);
  void roll_back(std::size_t kept);

  const MachineDescription& machine_;
  InterpreterOptions options_;
  PathOptions path_options_;
  Diagnostics diagnostics_;
  StoredResults answers_;
  std::unique_ptr<Interpreter> interpreter_;
  std::unique_ptr<Tap<Operation>> operations_;
  std::unique_ptr<PathBuilder> builder_;
  LineQueue queue_;
  bool asks_ = false;
  bool allows_changes_ = true;
  bool ended_ = false;
  bool jogs_ = false;
  std::optional<Diagnostic> answer_fault_;
  OperatorMessages operator_messages_;
  OperatorMessages kept_words_;  // state before the line that was read last
  OutputState outputs_;          // state after the last item pulled
  std::int64_t line_number_ = -1;
  PathMode last_mode_ = PathMode::exact_stop;
};

class StreamedProgramRun final : public Activity {
 public:
  // `program` must outlive the run.
  StreamedProgramRun(StreamedProgram& program, const MachineDescription& machine);

  ActivityKind kind() const override { return program_.jogs() ? ActivityKind::jog : ActivityKind::program; }
  [[nodiscard]] bool next(PathItem& item) override { return smoother_.next(item); }

 private:
  StreamedProgram& program_;
  PathSmoother smoother_;
};

}  // namespace passo
