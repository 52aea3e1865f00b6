#include "passo/interpreter/interpreter.hpp"

#include <algorithm>
#include <variant>

#include "block_executor.hpp"
#include "grbl_dialect.hpp"
#include "interpreter_sentences.hpp"
#include "program_flow.hpp"
#include "rules.hpp"

#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {
namespace {

// True: the machine moves, waits, or needs a person. A loop that gives only other operations does nothing.
struct IsWork {
  bool operator()(const operation::StraightTraverse&) const { return true; }
  bool operator()(const operation::StraightFeed&) const { return true; }
  bool operator()(const operation::ArcFeed&) const { return true; }
  bool operator()(const operation::NurbsFeed&) const { return true; }
  bool operator()(const operation::RigidTap&) const { return true; }
  bool operator()(const operation::StraightProbe&) const { return true; }
  bool operator()(const operation::Dwell& dwell) const { return dwell.time > Seconds(0); }
  bool operator()(const operation::OrientSpindle&) const { return true; }
  bool operator()(const operation::ChangeTool&) const { return true; }
  bool operator()(const operation::ProgramStop&) const { return true; }
  bool operator()(const operation::PalletShuttle&) const { return true; }
  bool operator()(const auto&) const { return false; }
};

}  // namespace

class Interpreter::Implementation {
 public:
  Implementation(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics,
                 const MachineResults& answers)
      : saved_(options.parameters),
        parameters_(symbols_, state_, options.machine_units, options.settings),
        reporter_(diagnostics),
        flow_(std::move(reader), flow_options(options), state_, parameters_, symbols_, reporter_),
        block_(state_, parameters_, operations_, reporter_, answers),
        executor_(block_, symbols_) {
    parameters_.load(options.parameters);
    if (options.open_ended) reporter_.judge_lines_alone();  // a sender is told of each line whether it is good
    executor_.start(options);
    diagnostics.look_up_rules_with(rule_of);
    if (options.dialect != Dialect::grbl) return;
    diagnostics.look_up_rules_with([](const Diagnostic& diagnostic) { return grbl_error(diagnostic.code); });
    state_.modal.set(ModalGroup::motion, code(0));  // where LinuxCNC waits for a first motion code
  }

  bool next(Operation& operation) {
    while (operations_.empty()) {
      if (executor_.awaits_probe()) executor_.apply_probe_outcome();
      if (finished_ || !step()) return false;
    }
    operation = operations_.front();
    flow_.count_operation(std::visit(IsWork(), operation.what));
    if (operation.file.empty()) {
      operation.file = reporter_.file();
      operation.text = text_;
    }
    operations_.pop();
    return true;
  }

  SavedParameters saved_parameters() const {
    SavedParameters saved = saved_;
    parameters_.save(saved);
    return saved;
  }

  const ToolTable& tools() const { return state_.tools; }

  std::uint64_t offset() const { return flow_.offset(); }

  void push_line(std::string_view text) { flow_.push_line(text); }
  bool ended() const { return finished_ || executor_.ended(); }
  void keep() {
    kept_state_ = state_;
    parameters_.keep();
    executor_.keep();
  }
  void roll_back() {
    state_ = kept_state_;
    parameters_.roll_back();
    executor_.roll_back();
    finished_ = false;
  }
  void reopen() {
    executor_.reopen();
    finished_ = false;
  }
  int motion() const { return state_.modal[ModalGroup::motion]; }
  void set_motion(int tenths) { state_.modal.set(ModalGroup::motion, static_cast<CodeNumber>(tenths)); }
  void stand_at(const Point& machine) { state_.position = state_.frame.work_from_machine(machine); }
  ActiveModes modes() const {
    ActiveModes modes;
    constexpr ModalGroup shown[] = {ModalGroup::motion,       ModalGroup::work_system, ModalGroup::plane,
                                    ModalGroup::length_units, ModalGroup::distance,    ModalGroup::feed_mode};
    for (const ModalGroup group : shown) modes.codes.push_back(spelling('G', state_.modal[group]));
    modes.spindle = state_.spindles[0].direction;
    modes.speed = state_.spindles[0].speed;
    modes.mist = state_.mist;
    modes.flood = state_.flood;
    modes.tool = std::max(state_.selected_tool, state_.tool);
    modes.feed = state_.feed;
    modes.inches = state_.modal.inches();
    modes.frame = state_.frame;
    modes.position = state_.machine_position();
    return modes;
  }

  std::optional<ToolMeasurement> measured_tool() const {
    const MeasuredTools& known = state_.measured;
    if (known.tool == 0 || known.tool != state_.tool) return {};
    return ToolMeasurement{known.tool, state_.frame.tool_offset()[Axis::z] + known.work_shift};
  }

  void watch(BlockWatcher& watcher) {
    watcher_ = &watcher;
    flow_.watch(watcher);
  }

 private:
  static std::vector<MachineProgram> machine_programs(const InterpreterOptions& options) {
    std::vector<MachineProgram> programs;
    const auto add = [&](std::int32_t number, const char* name, const std::string& lines) {
      if (!lines.empty()) programs.push_back({number, name, lines});
    };
    if (options.tool_change != nullptr) {
      add(change_macro_number, "[tool_change] of the machine file", options.tool_change->macro);
    }
    add(start_hook_number, "hooks.at_start of the machine file", options.hooks.at_start);
    add(end_hook_number, "hooks.at_end of the machine file", options.hooks.at_end);
    return programs;
  }

  // grbl throws the '/' away and runs the line.
  static ProgramFlow::Options flow_options(const InterpreterOptions& options) {
    return {.lines = {.block_delete = options.block_delete && options.dialect != Dialect::grbl,
                      .sub_folders = options.sub_folders,
                      .dialect = options.dialect,
                      .open_ended = options.open_ended,
                      .more_grbl_axes = options.more_grbl_axes.c_str(),
                      .machine_programs = machine_programs(options)},
            .bounds = {.idle_passes = options.idle_passes,
                       .repeated_steps = options.repeated_steps,
                       .main_passes = options.main_passes},
            .numbered_programs = !(options.settings && options.settings->is_on("RS274NGC", "DISABLE_FANUC_STYLE_SUB"))};
  }

  // One block: none, one or several operations. False: the next line was not given yet.
  bool step() {
    if (!std::exchange(has_begun_, true) && !block_.options.hooks.empty() && flow_.is_job()) {
      executor_.allow_hooks();
      if (executor_.call_start_hook()) return follow_jump(), true;
    }
    if (LatheCodes* const lathe = executor_.wants_contour()) {
      read_contour(*lathe);
    } else if (executor_.busy()) {
      go_on_with_cycle();
    } else if (const Block* const block = executor_.ended() ? nullptr : flow_.next()) {
      execute(*block);
    } else if (const auto line = flow_.take_left_sub()) {
      executor_.leave_sub({*line, -1});
    } else if (flow_.waits_for_line() && !executor_.ended()) {
      return false;
    } else {
      finish();
    }
    return true;
  }

  void go_on_with_cycle() {
    if (!flow_.may_go_on_with_cycle(executor_.repeated())) return executor_.drop_cycle();
    executor_.go_on();
    follow_jump();
  }

  void execute(const Block& block) {
    text_ = block.text;
    executor_.execute(block);
    if (executor_.busy()) flow_.begin_cycle();
    follow_jump();
    if (watcher_ != nullptr) watcher_->after(state_);
  }

  void finish() {
    text_ = {};
    finished_ = true;
    if (!executor_.ended() && flow_.end() == ProgramFlow::End::file && !reporter_.full()) {
      const bool is_for_grbl = block_.options.dialect == Dialect::grbl;
      reporter_.warning("gcode.no-end", {1, 1},
                        is_for_grbl ? FindingWords("the program ends without M2 or M30") : interpreter_says::no_end,
                        interpreter_says::end_in_last_line);
    }
    if (executor_.ended()) {
      if (!executor_.gave_up()) {
        flow_.report_never_closed();
        flow_.report_moves_after_end();
      }
      executor_.finish(flow_.lacks_closing_percent() ? BlockExecutor::Closing::missing : BlockExecutor::Closing::none);
    } else {
      const bool at_percent = flow_.end() == ProgramFlow::End::percent;
      executor_.finish(at_percent ? BlockExecutor::Closing::percent : BlockExecutor::Closing::none);
    }
  }

  // A macro of G66 runs when the cycle of its block is done.
  void follow_jump() {
    if (executor_.busy() || executor_.ended()) return;
    if (const auto jump = executor_.take_jump()) follow(*jump);
  }

  void follow(const SubprogramJump& jump) {
    switch (flow_.follow(jump)) {
      case ProgramFlow::Followed::goes_on: return;
      case ProgramFlow::Followed::left_sub:
        if (const auto line = flow_.take_left_sub()) executor_.leave_sub({*line, -1});
        return;
      case ProgramFlow::Followed::main_ends: executor_.end_program(false); return;
    }
  }

  // The blocks of a lathe cycle's sub are not executed: they are its contour.
  void read_contour(LatheCodes& lathe) {
    if (!flow_.call_for_contour(lathe.contour_sub(), lathe.contour_span())) return lathe.abandon_contour();
    while (const Block* const block = flow_.next()) executor_.add_to_contour(*block);
    if (flow_.end() != ProgramFlow::End::none) return lathe.abandon_contour();
    executor_.end_contour();
    text_ = lathe.text();
  }

  SavedParameters saved_;  // as they were before the program
  SymbolTable symbols_;
  ProgramState state_;
  Parameters parameters_;
  Reporter reporter_;
  OperationQueue operations_;
  ProgramFlow flow_;
  BlockContext block_;
  BlockExecutor executor_;
  std::string_view text_;  // of the block at hand
  bool has_begun_ = false;
  bool finished_ = false;
  ProgramState kept_state_;
  BlockWatcher* watcher_ = nullptr;
};

Interpreter::Interpreter(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics,
                         const MachineResults& answers)
    : implementation_(std::make_unique<Implementation>(std::move(reader), options, diagnostics, answers)) {}
Interpreter::~Interpreter() = default;

bool Interpreter::next(Operation& operation) {
  return implementation_->next(operation);
}

SavedParameters Interpreter::saved_parameters() const {
  return implementation_->saved_parameters();
}

const ToolTable& Interpreter::tools() const {
  return implementation_->tools();
}

void Interpreter::watch(BlockWatcher& watcher) {
  implementation_->watch(watcher);
}

void Interpreter::push_line(std::string_view text) {
  implementation_->push_line(text);
}

bool Interpreter::ended() const {
  return implementation_->ended();
}

void Interpreter::keep() {
  implementation_->keep();
}

void Interpreter::roll_back() {
  implementation_->roll_back();
}

void Interpreter::reopen() {
  implementation_->reopen();
}

int Interpreter::motion() const {
  return implementation_->motion();
}

void Interpreter::set_motion(int tenths) {
  implementation_->set_motion(tenths);
}

void Interpreter::stand_at(const Point& machine) {
  implementation_->stand_at(machine);
}

ActiveModes Interpreter::modes() const {
  return implementation_->modes();
}

std::optional<ToolMeasurement> Interpreter::measured_tool() const {
  return implementation_->measured_tool();
}

std::uint64_t Interpreter::offset() const {
  return implementation_->offset();
}

}  // namespace passo
