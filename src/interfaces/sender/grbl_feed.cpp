#include "passo/sender/grbl_feed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/drive/program_stop.hpp"
#include "passo/sender/grbl_executed.hpp"

namespace passo {
namespace {

constexpr double same_place = 1e-3;       // mm
constexpr double moved_by_others = 5e-3;  // mm

}  // namespace

GrblFeed::GrblFeed(Source<PathItem>& path, StoredResults& answers, const GrblTarget& target, bool waits,
                   bool waits_at_optional)
    : path_(path),
      answers_(answers),
      zero_(target.zero),
      code_(target),
      waits_(waits),
      waits_at_optional_(waits_at_optional) {}

void GrblFeed::begin_at(const ResumePoint& point, const std::vector<PathItem>& lead_in) {
  from_ = point;
  for (const PathItem& item : lead_in) write(item);
}

std::optional<GrblFeed::Line> GrblFeed::next() {
  while (ready_.empty() && asks_ == Asks::nothing) pull();
  if (ready_.empty()) return {};
  Line line = std::move(ready_.front());
  ready_.pop_front();
  return line;
}

void GrblFeed::pull() {
  PathItem item;
  if (objection_.empty() && path_.next(item)) return add(item);
  if (from_) {
    objection_ = "the path does not lead through the point at which it was to begin";
    objection_line_ = from_->line;
  }
  sync(Asks::end, 0);
}

void GrblFeed::add(const PathItem& item) {
  if (from_ && !reaches(item)) {
    if (skipped_watcher_) skipped_watcher_(item);
    return;
  }
  if (const auto* action = std::get_if<Action>(&item)) return add_action(*action);
  const auto& segment = std::get<Segment>(item);
  if (probe_) return write_probe(segment);
  write(item);
}

void GrblFeed::add_action(const Action& action) {
  using Kind = Action::Kind;
  switch (action.kind) {
    case Kind::await_line: return sync(Asks::line, 0);
    case Kind::probe_begin: probe_ = action; return sync(Asks::probe_state, action.source.line);
    case Kind::probe_end: probe_.reset(); return;
    default: break;
  }
  write(action);
  const bool waits = action.kind == Kind::optional_stop ? waits_ && waits_at_optional_ : waits_;
  if (!is_program_stop(action) || !waits) return;
  stop_ = action;
  sync(Asks::operator_stop, action.source.line);
}

// A line may be executed several times: the pass that leads through the point is meant. Corners are not rounded here,
// so the point may lie beside this path. The line is executed from its beginning.
bool GrblFeed::reaches(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (segment == nullptr || segment->source.line != from_->line) return false;
  if (grbl_distance(segment->curve, from_->point) > same_place + segment->tolerance.value()) return false;
  Segment to_start = *segment;
  to_start.curve = Curve::line(segment->curve.end(), segment->curve.start());
  write(to_start);
  from_.reset();
  return true;
}

void GrblFeed::push(Line line) {
  ready_.push_back(std::move(line));
  ++lines_written_;
}

void GrblFeed::sync(Asks asks, std::uint32_t line) {
  push({.text = GrblCode::wait_for_rest, .line = line});
  asks_ = asks;
}

void GrblFeed::write(const PathItem& item) {
  std::vector<std::string> lines;
  if (const auto written = code_.write(item, lines); !written) {
    objection_ = written.error();
    objection_line_ = GrblCode::source_line(item);
    return;
  }
  const std::uint32_t line = GrblCode::source_line(item);
  const auto* action = std::get_if<Action>(&item);
  const Seconds silence = action != nullptr && action->kind == Action::Kind::dwell ? action->dwell : Seconds(0);
  if (action != nullptr) outputs_ = action->outputs;
  for (std::string& text : lines) push({.text = std::move(text), .line = line, .silence = silence});
  if (watcher_) watcher_(item);
}

// Without an error if nothing is met: what follows from that is decided here. The move is written with all words,
// because the machine stands where the last probe move has ended.
void GrblFeed::write_probe(const Segment& segment) {
  const Point& end = segment.curve.end();
  std::string text = code_.is_by_time() ? "G94" : "";
  text += probe_->probe_toward ? "G38.3" : "G38.5";
  const Point& start = segment.curve.start();
  for (const Axis axis : all_axes) {
    if (std::abs(end[axis] - start[axis]) < 1e-9) continue;
    text += fmt::format("{}{:.4f}", letter_of(axis), end[axis] - zero_[axis]);
  }
  text += fmt::format("F{:.4f}", segment.speed.value() * seconds_per_minute);
  code_.forget_modes();
  push({.text = std::move(text), .line = segment.source.line});
  if (watcher_) watcher_(segment);
  sync(Asks::probe_result, segment.source.line);
}

void GrblFeed::go_on() {
  asks_ = Asks::nothing;
}

void GrblFeed::go_on_with_all_words() {
  if (code_.is_by_time()) push({.text = GrblCode::known_modes, .line = 0});
  code_.forget_modes();
  go_on();
}

void GrblFeed::go_on_from(const Point& place, const Point& from) {
  const std::uint32_t line = stop_.source.line;
  push({.text = GrblCode::known_modes, .line = line});
  code_.forget_modes();
  Point at = place;
  const auto go_to = [&](const Point& end) {
    if (end == at) return;
    Segment segment{.curve = Curve::line(at, end), .rapid = true};
    segment.speed = MmPerSecond(std::numeric_limits<double>::infinity());
    segment.source.line = line;
    std::vector<std::string> lines;
    if (!code_.write(segment, lines)) return;
    for (std::string& text : lines) push({.text = std::move(text), .line = line});
    at = end;
  };
  if (grbl_distance(Curve::line(place, place), from) > moved_by_others) {
    const double height = std::max(place[Axis::z], from[Axis::z]);
    Point above = place;
    above[Axis::z] = height;
    Point over = from;
    over[Axis::z] = height;
    for (const Point& end : {above, over, from}) go_to(end);
  }
  go_on();
}

void GrblFeed::take_probe_state(bool triggered, const Point& place) {
  const bool refused = triggered == probe_->probe_toward;
  answers_.record({.refused = refused, .touched = false, .contact = place, .rest = place});
  asks_ = Asks::nothing;
}

void GrblFeed::take_probe(const ProbeOutcome& outcome) {
  answers_.record(outcome);
  probe_.reset();
  asks_ = Asks::nothing;
}

GrblProgramPath::GrblProgramPath(ProgramReader program, const MachineDescription& machine,
                                 const InterpreterOptions& options, Diagnostics& diagnostics,
                                 std::vector<ProbeOutcome> known_probes)
    : answers_(results_, std::move(known_probes)),
      path_options_(path_options(machine, program.name(), options.start)),
      interpreter_(std::move(program), on_machine(machine, options), diagnostics, answers_),
      operations_(interpreter_),
      builder_(operations_, path_options_, diagnostics, answers_),
      until_error_(builder_, diagnostics) {
  path_options_.outputs = {};  // Grbl itself sets a laser's power, and has no outputs that switch in motion
  operations_.watch([this](const Operation& operation) { messages_.watch(operation, interpreter_.tools()); });
}

bool GrblProgramPath::next(PathItem& item) {
  if (!until_error_.next(item)) return false;
  answers_.see(item);
  return true;
}

}  // namespace passo
