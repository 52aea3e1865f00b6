#include "passo/interpreter/interpreter.hpp"

#include <variant>

#include "block_executor.hpp"
#include "grbl.hpp"
#include "program_flow.hpp"
#include "rules.hpp"

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
                 const MachineAnswers& answers)
      : saved_(options.parameters),
        parameters_(symbols_, state_, options.machine_units, options.settings),
        reporter_(diagnostics),
        flow_(std::move(reader), flow_options(options), state_, parameters_, symbols_, reporter_),
        block_(state_, parameters_, operations_, reporter_, answers),
        executor_(block_, symbols_) {
    parameters_.load(options.parameters);
    executor_.start(options);
    diagnostics.look_up_rules_with(rule_of);
    if (options.dialect != Dialect::grbl) return;
    diagnostics.look_up_rules_with([](const Diagnostic& diagnostic) { return grbl_error(diagnostic.code); });
    state_.modal.set(ModalGroup::motion, code(0));  // where LinuxCNC waits for a first motion code
  }

  bool next(Operation& operation) {
    while (operations_.empty()) {
      if (executor_.awaits_probe()) executor_.take_probe_outcome();
      if (finished_) return false;
      step();
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

  void watch(BlockWatcher& watcher) {
    watcher_ = &watcher;
    flow_.watch(watcher);
  }

 private:
  // grbl throws the '/' away and runs the line.
  static ProgramFlow::Options flow_options(const InterpreterOptions& options) {
    return {options.block_delete && options.dialect != Dialect::grbl,
            options.idle_passes,
            options.repeated_steps,
            options.main_passes,
            options.sub_folders,
            options.dialect,
            !(options.settings && options.settings->is_on("RS274NGC", "DISABLE_FANUC_STYLE_SUB"))};
  }

  // One block: none, one or several operations.
  void step() {
    if (LatheCodes* const lathe = executor_.wants_contour()) return read_contour(*lathe);
    if (executor_.busy()) {
      if (!flow_.may_go_on_with_cycle(executor_.repeated())) return executor_.drop_cycle();
      executor_.go_on();
      return follow_jump();
    }
    const Block* const block = executor_.ended() ? nullptr : flow_.next();
    text_ = block != nullptr ? block->text : std::string_view();
    if (block != nullptr) {
      executor_.execute(*block);
      if (executor_.busy()) flow_.begin_cycle();
      follow_jump();
      if (watcher_ != nullptr) watcher_->after(state_);
      return;
    }
    if (const auto line = flow_.take_left_sub()) return executor_.leave_sub({*line, -1});
    finished_ = true;
    if (!executor_.ended() && flow_.end() == ProgramFlow::End::file && !reporter_.full()) {
      reporter_.warning("gcode.no-end", {1, 1}, "the program ends without M2, M30 or '%'", "M2 in its last line");
    }
    if (executor_.ended()) {
      if (!executor_.gave_up()) flow_.report_never_closed();
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
  bool finished_ = false;
  BlockWatcher* watcher_ = nullptr;
};

Interpreter::Interpreter(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics,
                         const MachineAnswers& answers)
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

std::uint64_t Interpreter::offset() const {
  return implementation_->offset();
}

}  // namespace passo
