#include "program_flow.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter_sentences.hpp"
#include "whole_number.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

using enum ControlKind;

std::string_view name_of(ControlKind kind) {
  switch (kind) {
    case sub: return "sub";
    case if_: return "if";
    case while_: return "while";
    case do_: return "do";
    case repeat: return "repeat";
    case program: return "program";
    default: return "block";
  }
}
std::string_view name_of_end(ControlKind kind) {
  switch (kind) {
    case sub: return "endsub";
    case if_: return "endif";
    case while_: return "endwhile";
    case do_: return "while";
    default: return "endrepeat";
  }
}

Sentence loop_without_motion(std::uint64_t passes) {
  if (passes == 1) return interpreter_says::loop_ran_once.with();
  return interpreter_says::loop_without_motion.with({{"times", grouped(passes)}});
}

}  // namespace

ProgramFlow::ProgramFlow(ProgramReader reader, const Options& options, ProgramState& state, Parameters& parameters,
                         SymbolTable& symbols, Reporter& reporter)
    : numbered_programs_(options.numbered_programs),
      state_(state),
      parameters_(parameters),
      symbols_(symbols),
      reporter_(reporter),
      returned_(symbols, parameters),
      lines_(std::move(reader), options.lines, state, parameters, symbols, reporter),
      bounds_(options.bounds) {
  reporter_.set_call_stack(*this);
}

const Block* ProgramFlow::next() {
  if (again_) run_again();
  while (end_ == End::none) {
    if (frames_.size() < contour_depth_) {
      contour_depth_ = 0;
      return nullptr;
    }
    switch (lines_.read()) {
      case ProgramLines::Read::end:
        if (lines_.open_ended()) return nullptr;
        while (any_open()) {
          report_unclosed(open_.back());
          open_.pop_back();
        }
        if (!frames_.empty()) {
          const Frame& frame = frames_.back();
          report_unclosed({frame.place.numbered ? program : sub, frame.sub, frame.place.at, {}});
        }
        lines_.block().text = {};  // the text is the reader's, and is lost
        return finish(End::file);
      case ProgramLines::Read::skipped: continue;
      case ProgramLines::Read::block: break;
    }
    const Block& block = lines_.block();
    if (block.percent) {
      if (lines_.percent_signs().closes()) return finish(End::percent);
      continue;
    }
    if (watcher_ != nullptr) watcher_->before(block, lines_.file().name, state_, parameters_, symbols_);
    // The hook at the start comes before the '%' of the program.
    const bool has_content = block.control || !block.words.empty() || !block.assignments.empty();
    if (has_content && frames_.empty()) lines_.percent_signs().note_content();
    if (!block.control) return &block;
    state_.line = block.line;
    obey(*block.control);
    if (watcher_ != nullptr) watcher_->after(state_);
    if (contour_depth_ != 0) {
      left_sub_.reset();  // nothing was executed in the sub, so nothing is restored
    } else if (left_sub_) {
      return nullptr;
    }
  }
  return nullptr;
}

const Block* ProgramFlow::finish(End end) {
  end_ = end;
  return nullptr;
}

void ProgramFlow::obey(const Control& control) {
  Symbol label;
  if (!label_of(control, label)) return;
  switch (control.kind) {
    case sub: return begin_sub(label, control);
    case ControlKind::call: return call(label, control);
    case return_:
    case endsub: return leave_sub(label, control);
    case if_: return begin_if(label, control);
    case elseif:
    case else_:
    case endif: return next_branch(label, control);
    case while_: return innermost(do_, label) != nullptr ? end_do(label, control) : begin_while(label, control);
    case endwhile: return end_while(label, control);
    case do_: push(do_, label); return;
    case repeat: return begin_repeat(label, control);
    case endrepeat: return end_repeat(label, control);
    case break_:
    case continue_: return leave_or_continue_loop(label, control);
    default: (void)check_numbered_programs(control.span, "a numbered program"); return;  // it begins; nothing happens
  }
}

void ProgramFlow::begin_sub(Symbol label, const Control& control) {
  if (!frames_.empty()) {
    stray(label, control, fmt::format("a subroutine inside the subroutine {}", label_text(frames_.back().sub)),
          frames_.back().place.numbered ? "M99 before the next subroutine" : "endsub before the next subroutine");
    finish(End::error);
    return;
  }
  const ReaderPosition after = lines_.after();
  const auto [known, added] = lines_.file().subs.try_emplace(label.id, SubPlace{lines_.at(), after, false});
  if (!added && known->second.after.offset != after.offset) {
    stray(label, control,
          fmt::format("a second subroutine {}; the first one is in line {}", label_text(label), known->second.at.line),
          "another name");
  }
  skip_to({sub, label, lines_.at(), after}, kinds({endsub}));
}

void ProgramFlow::leave_sub(Symbol label, const Control& control) {
  // LinuxCNC does not look at the label of a return.
  if (frames_.empty() || (control.kind == endsub && frames_.back().sub != label)) {
    stray(label, control, fmt::format("the subroutine {} is not running", label_text(label)),
          "endsub with the label of its subroutine");
    return;
  }
  const Frame frame = frames_.back();
  if (frame.place.numbered) {
    reporter_.error("gcode.mixed-subs", control.span,
                    fmt::format("{} in the numbered program O{}, which starts in line {}",
                                control.kind == endsub ? "endsub" : "return", label_text(label), frame.place.at.line),
                    "M99");
    return leave_frame();
  }
  double value = 0;
  if (!control.arguments.empty() && !value_of(lines_.block(), control.arguments.front(), parameters_, reporter_, value))
    return;
  if (control.kind == endsub) {
    for (std::size_t i = frame.first_open; i < open_.size(); ++i) report_unclosed(open_[i]);
  }
  returned_.set(value, !control.arguments.empty());
  leave_frame();
}

void ProgramFlow::begin_if(Symbol label, const Control& control) {
  check_used_once(label, control);
  const Open& open = push(if_, label);
  double condition = 0;
  if (!argument(control, condition)) {
    if (skip_to(open, kinds({endif}))) open_.pop_back();
  } else if (condition == 0) {
    skip_branch(open);
  }
}

// An if has its label alone, as in LinuxCNC: in the file, or in its sub.
void ProgramFlow::check_used_once(Symbol label, const Control& control) {
  constexpr std::size_t most_remembered = 10'000;  // computed labels have no bound of their own
  if (lines_.file().ifs.size() >= most_remembered) return;
  const std::uint32_t inside = frames_.empty() ? 0 : frames_.back().sub.id + 1;
  const auto [first, added] = lines_.file().ifs.try_emplace({inside, label.id}, lines_.at());
  if (added || first->second.offset == lines_.at().offset) return;
  stray(label, control,
        fmt::format("a second if {}; the first one is in line {}", label_text(label), first->second.line),
        "another label");
}

// Goes from a branch that is not taken to the one that is taken, or behind the endif.
bool ProgramFlow::skip_branch(const Open& from) {
  while (skip_to(from, kinds({elseif, else_, endif}))) {
    const Control& control = *lines_.block().control;
    double condition = 1;
    if (control.kind == endif) return open_.pop_back(), true;
    if (control.kind == else_) return true;
    if (!argument(control, condition)) {
      if (skip_to(from, kinds({endif}))) open_.pop_back();
      return false;
    }
    if (condition != 0) return true;
  }
  return false;
}

// For elseif, else and endif at the end of the branch that was taken.
void ProgramFlow::next_branch(Symbol label, const Control& control) {
  const Open* const open = require_innermost(if_, label, control);
  if (open == nullptr) return;
  if (control.kind == endif || skip_to(*open, kinds({endif}))) open_.pop_back();
}

void ProgramFlow::begin_while(Symbol label, const Control& control) {
  Open* open = innermost(while_, label);
  const bool again = open != nullptr && open->at.offset == lines_.at().offset;
  if (!again) open = &push(while_, label);
  double condition = 0;
  if (argument(control, condition) && condition != 0) return;
  if (skip_to(*open, kinds({endwhile}))) open_.pop_back();
}

void ProgramFlow::end_while(Symbol label, const Control& control) {
  const Open* const open = require_innermost(while_, label, control);
  if (open != nullptr) go_round(*open, open->at);  // its condition is evaluated again
}

void ProgramFlow::end_do(Symbol label, const Control& control) {
  const Open* const open = require_innermost(do_, label, control);
  double condition = 0;
  if (open == nullptr) return;
  if (argument(control, condition) && condition != 0) {
    go_round(*open, open->after);
  } else {
    open_.pop_back();
  }
}

// Halves are rounded to even, as in LinuxCNC: 2.5 is 2 passes.
void ProgramFlow::begin_repeat(Symbol label, const Control& control) {
  constexpr double most_passes = 1e15;
  Open& open = push(repeat, label);
  double passes = 0;
  if (argument(control, passes) && std::nearbyint(passes) >= 1) {
    open.passes_left = static_cast<std::uint64_t>(std::min(std::nearbyint(passes), most_passes));
  } else if (skip_to(open, kinds({endrepeat}))) {
    open_.pop_back();
  }
}

void ProgramFlow::end_repeat(Symbol label, const Control& control) {
  Open* const open = require_innermost(repeat, label, control);
  if (open == nullptr) return;
  if (--open->passes_left == 0) {
    open_.pop_back();
  } else {
    go_round(*open, open->after);
  }
}

void ProgramFlow::leave_or_continue_loop(Symbol label, const Control& control) {
  const bool leave = control.kind == break_;  // `control` is overwritten when the loop's end is searched
  while (any_open()) {
    const Open open = open_.back();
    if (open.kind == if_ || open.label != label) {
      open_.pop_back();
      continue;
    }
    if (!skip_to(open, end_of(open.kind))) return;
    if (leave) {
      open_.pop_back();
    } else {
      lines_.seek(lines_.at());  // the line at the loop's end decides
    }
    return;
  }
  stray(label, control, fmt::format("the loop {} is not running", label_text(label)),
        "break and continue with the label of their loop");
}

ProgramFlow::Kinds ProgramFlow::end_of(ControlKind construct) {
  switch (construct) {
    case sub: return kinds({endsub});
    case if_: return kinds({endif});
    case while_: return kinds({endwhile});
    case do_: return kinds({while_});
    default: return kinds({endrepeat});
  }
}

ProgramFlow::Open& ProgramFlow::push(ControlKind kind, Symbol label) {
  if (is_outermost()) bounds_.begin();
  return open_.emplace_back(Open{kind, label, lines_.at(), lines_.after(), reporter_.errors()});
}

ProgramFlow::Open* ProgramFlow::innermost(ControlKind kind, Symbol label) {
  if (!any_open()) return nullptr;
  Open& open = open_.back();
  return open.kind == kind && open.label == label ? &open : nullptr;
}

// Finds the open construct that an O-word ends. Constructs inside it that were not closed are reported and left.
ProgramFlow::Open* ProgramFlow::require_innermost(ControlKind kind, Symbol label, const Control& control) {
  for (std::size_t i = open_.size(); i > first_open(); --i) {
    if (open_[i - 1].kind != kind || open_[i - 1].label != label) continue;
    for (; open_.size() > i; open_.pop_back()) report_unclosed(open_.back());
    return &open_[i - 1];
  }
  stray(label, control, fmt::format("no {} {} is open", name_of(kind), label_text(label)),
        fmt::format("o{} {} before", label_text(label), name_of(kind)));
  return nullptr;
}

// Goes back to `to`, unless a line of the loop is wrong. The next passes would then only repeat it, or, since a wrong
// line does nothing, never end. So the loop is left.
void ProgramFlow::go_round(const Open& loop, ReaderPosition to) {
  if (reporter_.errors() > loop.errors_before) return open_.pop_back();
  if (may_go_round(loop)) lines_.seek(to);
}

bool ProgramFlow::may_go_on_with_cycle(Span repeated) {
  if (bounds_.allows_more_operations()) return true;
  reporter_.error("gcode.endless-cycle", repeated,
                  fmt::format("the cycle reached {} operations", bounds_.limits().repeated_steps),
                  "fewer repetitions (L), larger pecks (Q), or a higher --step-limit");
  finish(End::error);
  return false;
}

// False: the loop went round too often.
bool ProgramFlow::may_go_round(const Open& loop) {
  const RunawayGuard::Reached reached = bounds_.count_pass();
  if (reached == RunawayGuard::Reached::nothing) return true;
  const bool idles = reached == RunawayGuard::Reached::idle;
  lines_.seek(loop.at);
  (void)lines_.read();
  reporter_.error("gcode.endless-loop", lines_.block().control ? lines_.block().control->span : Span{1, 1},
                  idles ? FindingWords(loop_without_motion(bounds_.limits().idle_passes))
                        : FindingWords(fmt::format("the loop reached {} passes, calls and operations",
                                                   bounds_.limits().repeated_steps)),
                  idles ? "a loop that ends, or that moves" : "a loop that ends, or a higher --step-limit");
  finish(End::error);
  return false;
}

// Reads on to the line with an O-word of `from`'s label and one of the wanted kinds. Then the block at hand is
// that of this line. A construct of the same label and kind inside is skipped as a whole.
bool ProgramFlow::skip_to(const Open& from, Kinds wanted) {
  const Open opening = from;  // `from` may be in open_
  int inside = 0;
  for (;;) {
    Symbol label;
    if (!lines_.read_control(label)) {
      if (end_ == End::none && !reporter_.full()) report_unclosed(opening);
      while (any_open()) open_.pop_back();
      finish(End::error);
      return false;
    }
    const ControlKind kind = lines_.block().control->kind;
    if (!frames_.empty() && kind == endsub && label == frames_.back().sub && opening.kind != sub) {
      report_unclosed(opening);
      while (any_open()) open_.pop_back();
      lines_.seek(lines_.at());  // the sub ends here
      return false;
    }
    if (kind == sub && opening.kind == sub) {
      stray(label, *lines_.block().control,
            fmt::format("a subroutine inside the subroutine {}", label_text(opening.label)),
            "endsub before the next subroutine");
      finish(End::error);
      return false;
    }
    if (label != opening.label) continue;
    const bool closes = (end_of(opening.kind) >> static_cast<unsigned>(kind) & 1U) != 0;
    if (kind == opening.kind && !closes) {
      ++inside;
    } else if (inside > 0) {
      if (closes) --inside;
    } else if ((wanted >> static_cast<unsigned>(kind) & 1U) != 0) {
      return true;
    }
  }
}

bool ProgramFlow::label_of(const Control& control, Symbol& label) {
  label = control.label;
  if (!control.computed_label) return true;
  double value = 0;
  if (!value_of(lines_.block(), *control.computed_label, parameters_, reporter_, value)) return false;
  const std::optional<Symbol> computed = label_of_value(value, symbols_);
  if (!computed) {
    reporter_.error("gcode.bad-o-word", control.computed_label->span,
                    fmt::format("the label is {}", plain_number(value)), "a whole number, 0 or more");
    return false;
  }
  label = *computed;
  return true;
}

bool ProgramFlow::argument(const Control& control, double& value) {
  if (!control.arguments.empty())
    return value_of(lines_.block(), control.arguments.front(), parameters_, reporter_, value);
  reporter_.error("gcode.missing-condition", control.span, "the O-word needs a value", "[…] after it");
  return false;
}

void ProgramFlow::report_unclosed(const Open& open) {
  if (lines_.unreadable_labels().has(open.label)) return;
  const ReaderPosition here = lines_.after();
  std::string_view text;
  std::uint32_t line = open.at.line;
  lines_.seek(open.at);
  (void)lines_.file().reader.next_line(text, line, reporter_.diagnostics());
  const std::size_t first = text.find_first_of("oO");
  const Span span = first == std::string_view::npos
                        ? Span{1, 1}
                        : Span{static_cast<std::uint32_t>(first + 1), static_cast<std::uint32_t>(text.size() - first)};
  reporter_.error_at("gcode.unclosed-o-word", line, text, span,
                     fmt::format("{} {} is never closed", name_of(open.kind), label_text(open.label)),
                     open.kind == program ? std::string("M99")
                                          : fmt::format("o{} {}", label_text(open.label), name_of_end(open.kind)));
  lines_.reread_block_text();
  lines_.seek(here);
}

// M2 may stand in a branch, before the end of its construct.
void ProgramFlow::report_never_closed() {
  const ReaderPosition here = lines_.after();
  while (any_open()) {
    const Open open = open_.back();
    open_.pop_back();
    if (!is_closed_further_on(open)) report_unclosed(open);
  }
  lines_.seek(here);
}

// Reads on to the end of the construct. Nothing that is read is executed, and so nothing else is reported.
bool ProgramFlow::is_closed_further_on(const Open& open) {
  const ReaderPosition here = lines_.after();
  Block block;
  Diagnostics unheeded;
  std::string_view text;
  std::uint32_t line = 0;
  int inside = 0;
  while (lines_.file().reader.next_line(text, line, unheeded)) {
    if (!ProgramLines::may_be_control(text) || !lines_.file().parser.parse(text, line, block, unheeded) ||
        !block.control)
      continue;
    if (!frames_.empty() && block.control->kind == endsub && block.control->label == frames_.back().sub) break;
    // A computed label may be this one, so the construct is not said to lack its end.
    if (!block.control->computed_label && block.control->label != open.label) continue;
    const bool closes = (end_of(open.kind) >> static_cast<unsigned>(block.control->kind) & 1U) != 0;
    if (block.control->kind == open.kind && !closes) ++inside;
    if (closes && inside-- == 0) return true;
  }
  lines_.seek(here);
  return false;
}

bool ProgramFlow::stray(Symbol label, const Control& control, FindingWords message, FindingWords expected) {
  if (lines_.unreadable_labels().has(label)) return false;
  reporter_.error("gcode.stray-o-word", control.span, std::move(message), std::move(expected));
  return false;
}

}  // namespace passo
