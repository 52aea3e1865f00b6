#include "passo/activity/program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/activity/nominal_time.hpp"
#include "passo/activity/stage_options.hpp"

namespace passo {
namespace {

// How many moves after a probe move the check follows.
constexpr std::uint64_t most_moves_after_a_probe = 10'000'000;

bool is_probe(const PathItem& item) {
  const auto* action = std::get_if<Action>(&item);
  return action != nullptr && action->kind == Action::Kind::probe_end;
}

// Warns that the check does not cover the whole program.
void report_end(Diagnostics& diagnostics, const std::string& file, const PathItem& item) {
  const std::uint32_t line = std::visit([](const auto& what) { return what.source.line; }, item);
  diagnostics.add({.severity = Severity::warning,
                   .code = "path.unchecked",
                   .file = file,
                   .place = {.line = line, .column = 0, .length = 1},
                   .message = "the check ends here, ten million moves after a probe move",
                   .expected = "a loop that also ends if the probe is triggered at the end of its move",
                   .text = {}});
}

}  // namespace

// The program with the moves of M6 and the hooks.
struct ProgramChecker::Changes {
  Changes(ProgramReader program, const PathOptions& path, const InterpreterOptions& options)
      : interpreter(std::move(program), options, findings),
        operations(interpreter),
        builder(operations, path, findings) {
    operations.watch([this](const Operation& operation) {
      probes |= std::holds_alternative<operation::StraightProbe>(operation.what) && !operation.in_machine;
    });
  }

  Diagnostics findings;
  Interpreter interpreter;
  Tap<Operation> operations;
  PathBuilder builder;
  bool probes = false;  // the program itself, and not only M6
  std::uint64_t after_a_probe = 0;
};

ProgramChecker::~ProgramChecker() = default;

ProgramChecker::ProgramChecker(ProgramReader program, const MachineDescription& machine,
                               const InterpreterOptions& options, Diagnostics& diagnostics)
    : diagnostics_(diagnostics),
      path_options_(path_options(machine, program.name(), options.start)),
      limits_(motion_limits(machine)),
      tools_(options.tools),
      again_(machine.tool_change != nullptr || !machine.hooks.empty() ? std::optional(program.again()) : std::nullopt),
      changing_(again_ ? on_machine(machine, options) : InterpreterOptions{}),
      interpreter_(std::move(program), options, diagnostics),
      track_(options.start),
      mistakes_(machine, options.units, path_options_.file, diagnostics),
      low_rapids_(machine, !options.parameters.empty(), path_options_.file, diagnostics),
      spindle_mistakes_(machine, path_options_.file, diagnostics),
      operations_(interpreter_),
      builder_(operations_, path_options_, diagnostics) {
  operations_.watch([this](const Operation& operation) {
    track_.follow(operation);
    changes_tools_ |= std::holds_alternative<operation::StartToolChange>(operation.what);
    mistakes_.watch(operation, track_);
    low_rapids_.watch(operation, track_);
    spindle_mistakes_.watch(operation, track_);
  });
}

bool ProgramChecker::go_on(std::uint64_t items) {
  for (; items > 0 && !done_; --items) {
    if (changes_ != nullptr ? pull_change() : pull_item() || begins_changes()) continue;
    finish();
  }
  return done_;
}

bool ProgramChecker::pull_item() {
  if (diagnostics_.full() || after_a_probe_ >= most_moves_after_a_probe || !builder_.next(item_)) return false;
  check_.nominal_time += nominal_time_of(item_, limits_);
  if (std::holds_alternative<Segment>(item_)) ++check_.moves;
  if (watcher_) watcher_(item_);
  if (check_.probes) ++after_a_probe_;
  if (!check_.probes && is_probe(item_)) {
    check_.probes = true;
    diagnostics_.doubt_errors("if the probe is triggered at the end of its move");
  }
  return true;
}

bool ProgramChecker::begins_changes() {
  if (!again_ || !(changes_tools_ || !changing_.hooks.empty()) || diagnostics_.any_error()) return false;
  changes_ = std::make_unique<Changes>(std::move(*again_), path_options_, changing_);
  return true;
}

bool ProgramChecker::pull_change() {
  Changes& with = *changes_;
  PathItem item;
  if (with.findings.full() || with.after_a_probe >= most_moves_after_a_probe || !with.builder.next(item)) return false;
  if (with.probes) ++with.after_a_probe;
  if (with.probes && is_probe(item)) with.findings.doubt_errors("if the probe is triggered at the end of its move");
  return true;
}

void ProgramChecker::finish() {
  done_ = true;
  if (changes_ != nullptr) {
    for (const Diagnostic& found : changes_->findings.all()) {
      if (found.severity == Severity::error) diagnostics_.add_certain(found);
    }
  }
  mistakes_.finish();
  low_rapids_.finish();
  spindle_mistakes_.finish();
  if (after_a_probe_ == most_moves_after_a_probe) report_end(diagnostics_, path_options_.file, item_);
  diagnostics_.doubt_errors({});
  check_.tools_change = interpreter_.tools() != tools_;
  check_.good = !diagnostics_.any_error();
}

ProgramCheck check_program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                           Diagnostics& diagnostics, const std::function<void(const PathItem&)>& watch,
                           const Tap<Operation>::Watcher& watch_operations) {
  ProgramChecker checker(std::move(program), machine, options, diagnostics);
  checker.watch(watch);
  if (watch_operations) checker.watch_operations(watch_operations);
  while (!checker.go_on(UINT64_MAX)) {
  }
  return checker.result();
}

Program::Program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                 const MachineResults& answers, Diagnostics& diagnostics, Seconds whole,
                 std::vector<ProbeOutcome> known_probes)
    : limits_(motion_limits(machine)),
      stages_(std::move(program), machine, options, answers, diagnostics, std::move(known_probes)),
      whole_(whole) {
  stages_.operations().watch([this](const Operation& operation) { operator_messages_.watch(operation, tools()); });
  stages_.path().watch([this](const PathItem& item) { nominal_time_ += nominal_time_of(item, limits_); });
}

std::optional<double> Program::progress() const {
  if (!(whole_ > Seconds(0))) return {};
  return std::min(nominal_time_ / whole_, 1.0);
}

}  // namespace passo
