// GrblFeed: converts a path to the lines of a Grbl machine while the machine executes them: with the program's stops,
// and with probe moves, whose results the path depends on.
//
// Position in the pipeline: between a source of path items and GrblSender. The source is a program (GrblProgramPath) or
// the lines of a client (StreamedProgram). Their path is built as for our boards, with the offsets of the Grbl machine;
// GrblCode converts it to lines.
//
//   while (feed.next()) sender.add(…);   at rest: stop() or asks() -> go_on() or take_probe()
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passo/activity/operator_messages.hpp"
#include "passo/activity/program_stages.hpp"
#include "passo/base/source.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/journal/resume_point.hpp"
#include "passo/sender/grbl_code.hpp"
#include "passo/sender/grbl_target.hpp"

namespace passo {

class GrblFeed {
 public:
  struct Line {
    std::string text;
    std::uint32_t line = 0;  // line of the program
    Seconds silence{0};      // how long the machine may not respond, because of a dwell
  };
  // For what the machine must be at rest before the path continues.
  enum class Asks : std::uint8_t {
    nothing,
    operator_stop,  // stop()
    probe_state,    // before a probe move: is the probe triggered already? See take_probe_state()
    probe_result,   // the probe move has ended. See take_probe()
    line,           // a program that comes line by line has no further line yet
    end,            // the path has ended
  };
  using Watcher = std::function<void(const PathItem&)>;

  // `path` and `answers` must outlive the feed. `target`: the board. `waits`: it waits at stops and tool changes;
  // `waits_at_optional`: also at M1.
  GrblFeed(Source<PathItem>& path, StoredResults& answers, const GrblTarget& target, bool waits,
           bool waits_at_optional);

  // Skips the path before that point. The lead-in comes first.
  void begin_at(const ResumePoint& point, const std::vector<PathItem>& lead_in);
  // Whether the path has not come to that point yet: what is written leads there.
  bool leads_in() const { return from_.has_value(); }
  // Receives each item when its lines are written.
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }
  // Receives each item before the point at which the path begins.
  void watch_skipped(Watcher watcher) { skipped_watcher_ = std::move(watcher); }
  void wait_at_optional(bool waits) { waits_at_optional_ = waits; }

  // Returns the next line. Empty: see asks(). The last line before that is answered only when all motion is complete.
  std::optional<Line> next();
  Asks asks() const { return ready_.empty() ? asks_ : Asks::nothing; }
  // The action at which the program waits.
  const Action& stop() const { return stop_; }
  // Continues after an operator stop, or with a further line.
  void go_on();
  // The same. The next lines have all their words, for a reader that does not know those before.
  void go_on_with_all_words();
  // The same after a stop at `from` during which others may have moved the machine, or changed its modes. From `place`,
  // rapids lead back: up to the higher Z, across, and down.
  void go_on_from(const Point& place, const Point& from);
  // `triggered`: the present state of the probe.
  void take_probe_state(bool triggered, const Point& place);
  void take_probe(const ProbeOutcome& outcome);
  // Why the path cannot be executed by the machine, as a clause. The path ends there.
  const std::string& objection() const { return objection_; }
  std::uint32_t objection_line() const { return objection_line_; }
  // The number of lines so far, including those that next() has not returned yet.
  std::uint64_t lines_written() const { return lines_written_; }
  // The outputs after the last line.
  const OutputState& outputs() const { return outputs_; }

 private:
  void pull();
  void add(const PathItem& item);
  void add_action(const Action& action);
  bool reaches(const PathItem& item);
  void write(const PathItem& item);
  void write_probe(const Segment& segment);
  void push(Line line);
  void sync(Asks asks, std::uint32_t line);

  Source<PathItem>& path_;
  StoredResults& answers_;
  Point zero_;  // machine coordinates
  GrblCode code_;
  Watcher watcher_;
  Watcher skipped_watcher_;
  bool waits_;
  bool waits_at_optional_;
  std::deque<Line> ready_;
  std::uint64_t lines_written_ = 0;
  Asks asks_ = Asks::nothing;
  Action stop_;
  std::optional<Action> probe_;  // probe_begin of the probe move that comes next
  std::optional<ResumePoint> from_;
  std::string objection_;
  std::uint32_t objection_line_ = 0;
  OutputState outputs_;
};

// A program as a path that is neither smoothed nor planned, because the machine does that.
class GrblProgramPath final : public Source<PathItem> {
 public:
  // `machine` and `diagnostics` must outlive the path.
  GrblProgramPath(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                  Diagnostics& diagnostics, std::vector<ProbeOutcome> known_probes);

  [[nodiscard]] bool next(PathItem& item) override;
  Tap<Operation>& operations() { return operations_; }
  StoredResults& answers() { return results_; }
  OperatorMessages& operator_messages() { return messages_; }
  SavedParameters saved_parameters() const { return interpreter_.saved_parameters(); }
  const ToolTable& tools() const { return interpreter_.tools(); }
  std::optional<ToolMeasurement> measured_tool() const { return interpreter_.measured_tool(); }

 private:
  StoredResults results_{StoredResults::Answers{}};
  KnownProbes answers_;
  PathOptions path_options_;
  Interpreter interpreter_;
  Tap<Operation> operations_;
  OperatorMessages messages_;
  PathBuilder builder_;
  PathUntilError until_error_;
};

}  // namespace passo
