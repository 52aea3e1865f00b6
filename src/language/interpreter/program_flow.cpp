#include "program_flow.hpp"

#include <algorithm>
#include <cmath>

#include "whole_number.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

using enum ControlKind;

constexpr double highest_label = 1e9;

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

}  // namespace

ProgramFlow::ProgramFlow(ProgramReader reader, const Options& options, ProgramState& state, Parameters& parameters,
                         SymbolTable& symbols, Reporter& reporter)
    : options_(options),
      state_(state),
      parameters_(parameters),
      symbols_(symbols),
      reporter_(reporter),
      value_name_(symbols.intern("_value")),
      returned_name_(symbols.intern("_value_returned")) {
  files_.push_back(std::make_unique<File>(std::move(reader), 0, symbols_));
  if (options_.dialect == Dialect::grbl) files_.front()->parser.accept_line_numbers_anywhere();
  file_ = files_.front().get();
  (void)parameters_.set_named(value_name_, 0);
  (void)parameters_.set_named(returned_name_, 0);
  set_block(line_);
  reporter_.set_call_stack(*this);
}

const Block* ProgramFlow::next() {
  if (again_) run_again();
  while (end_ == End::none) {
    if (frames_.size() < contour_depth_) {
      contour_depth_ = 0;
      return nullptr;
    }
    switch (read()) {
      case Read::end:
        if (options_.open_ended) return nullptr;
        while (any_open()) {
          report_unclosed(open_.back());
          open_.pop_back();
        }
        if (!frames_.empty()) {
          const Frame& frame = frames_.back();
          report_unclosed({frame.place.numbered ? program : sub, frame.sub, frame.place.at, {}});
        }
        block_->text = {};  // the text is the reader's, and is lost
        return finish(End::file);
      case Read::skipped: continue;
      case Read::block: break;
    }
    if (block_->percent) {
      if (is_percent_end()) return finish(End::percent);
      continue;
    }
    if (watcher_ != nullptr) watcher_->before(*block_, file_->name, state_, parameters_, symbols_);
    if (!block_->control) {
      begun_ = begun_ || !block_->words.empty() || !block_->assignments.empty();
      return block_;
    }
    begun_ = true;
    state_.line = block_->line;
    obey(*block_->control);
    if (watcher_ != nullptr) watcher_->after(state_);
    if (contour_depth_ != 0) {
      left_sub_.reset();  // nothing was executed in the sub, so nothing is restored
    } else if (left_sub_) {
      return nullptr;
    }
  }
  return nullptr;
}

// A '%' before everything else opens the program. The next '%' closes it.
bool ProgramFlow::is_percent_end() {
  const bool ends = std::exchange(begun_, true);
  opened_percent_ = opened_percent_ || !ends;
  return ends;
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
    stray(label, control, fmt::format("a sub inside the sub {}", label_text(frames_.back().sub)),
          frames_.back().place.numbered ? "M99 before the next sub" : "endsub before the next sub");
    finish(End::error);
    return;
  }
  const ReaderPosition after = file_->reader.position();
  const auto [known, added] = file_->subs.try_emplace(label.id, SubPlace{block_at_, after, false});
  if (!added && known->second.after.offset != after.offset) {
    stray(label, control,
          fmt::format("a second sub {}; the first one is at line {}", label_text(label), known->second.at.line),
          "another name");
  }
  skip_to({sub, label, block_at_, after}, kinds({endsub}));
}

void ProgramFlow::leave_sub(Symbol label, const Control& control) {
  // LinuxCNC does not look at the label of a return.
  if (frames_.empty() || (control.kind == endsub && frames_.back().sub != label)) {
    stray(label, control, fmt::format("no sub {} is running", label_text(label)), "endsub with the label of its sub");
    return;
  }
  const Frame frame = frames_.back();
  if (frame.place.numbered) {
    reporter_.error("gcode.mixed-subs", control.span,
                    fmt::format("{} in the numbered program O{}, which begins at line {}",
                                control.kind == endsub ? "endsub" : "return", label_text(label), frame.place.at.line),
                    "M99");
    return leave_frame();
  }
  double value = 0;
  if (!control.arguments.empty() && !value_of(*block_, control.arguments.front(), parameters_, reporter_, value))
    return;
  if (control.kind == endsub) {
    for (std::size_t i = frame.first_open; i < open_.size(); ++i) report_unclosed(open_[i]);
  }
  (void)parameters_.set_named(value_name_, value);
  (void)parameters_.set_named(returned_name_, control.arguments.empty() ? 0 : 1);
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
  if (file_->ifs.size() >= most_remembered) return;
  const std::uint32_t inside = frames_.empty() ? 0 : frames_.back().sub.id + 1;
  const auto [first, added] = file_->ifs.try_emplace({inside, label.id}, block_at_);
  if (added || first->second.offset == block_at_.offset) return;
  stray(label, control,
        fmt::format("a second if {}; the first one is at line {}", label_text(label), first->second.line),
        "another label");
}

// Goes from a branch that is not taken to the one that is taken, or behind the endif.
bool ProgramFlow::skip_branch(const Open& from) {
  while (skip_to(from, kinds({elseif, else_, endif}))) {
    const Control& control = *block_->control;
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
  const bool again = open != nullptr && open->at.offset == block_at_.offset;
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
      file_->reader.seek(block_at_);  // the line at the loop's end decides
    }
    return;
  }
  stray(label, control, fmt::format("no loop {} is running", label_text(label)),
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
  if (is_outermost()) steps_ = 0;
  return open_.emplace_back(Open{kind, label, block_at_, file_->reader.position(), reporter_.errors()});
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
  if (may_go_round(loop)) file_->reader.seek(to);
}

// False: the loop went round too often.
bool ProgramFlow::may_go_on_with_cycle(Span repeated) {
  if (steps_ <= options_.repeated_steps) return true;
  reporter_.error("gcode.endless-cycle", repeated,
                  fmt::format("the cycle came to {} operations", options_.repeated_steps),
                  "fewer repetitions (L) or larger pecks (Q); or a higher --step-limit");
  finish(End::error);
  return false;
}

bool ProgramFlow::may_go_round(const Open& loop) {
  const bool idles = ++idle_passes_ > options_.idle_passes;
  if (!idles && ++steps_ <= options_.repeated_steps) return true;
  file_->reader.seek(loop.at);
  (void)read();
  reporter_.error(
      "gcode.endless-loop", block_->control ? block_->control->span : Span{1, 1},
      idles ? fmt::format("the loop went round {}, and the machine did nothing", counted(options_.idle_passes, "time"))
            : fmt::format("the loop came to {} passes, calls and operations", options_.repeated_steps),
      idles ? "a loop that ends, or that moves" : "a loop that ends; or a higher --step-limit");
  finish(End::error);
  return false;
}

// Reads on to the line with an O-word of `from`'s label and one of the wanted kinds. Then block_ is that line. A
// construct of the same label and kind inside is skipped as a whole.
bool ProgramFlow::skip_to(const Open& from, Kinds wanted) {
  const Open opening = from;  // `from` may be in open_
  int inside = 0;
  for (;;) {
    Symbol label;
    if (!read_control(label)) {
      if (end_ == End::none && !reporter_.full()) report_unclosed(opening);
      while (any_open()) open_.pop_back();
      finish(End::error);
      return false;
    }
    const ControlKind kind = block_->control->kind;
    if (!frames_.empty() && kind == endsub && label == frames_.back().sub && opening.kind != sub) {
      report_unclosed(opening);
      while (any_open()) open_.pop_back();
      file_->reader.seek(block_at_);  // the sub ends here
      return false;
    }
    if (kind == sub && opening.kind == sub) {
      stray(label, *block_->control, fmt::format("a sub inside the sub {}", label_text(opening.label)),
            "endsub before the next sub");
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
  if (!value_of(*block_, *control.computed_label, parameters_, reporter_, value)) return false;
  const std::optional<double> whole = whole_within(value, 0, highest_label);
  if (!whole) {
    reporter_.error("gcode.bad-o-word", control.computed_label->span,
                    fmt::format("the label is {}", plain_number(value)), "a whole number, 0 or more");
    return false;
  }
  label = symbols_.intern(plain_number(*whole));
  return true;
}

// A line that is skipped is not executed, so its label may have no value. False: it has none, or is no label.
bool ProgramFlow::label_of_skipped(const Control& control, Symbol& label) const {
  label = control.label;
  if (!control.computed_label) return true;
  const Evaluation value = evaluate(*block_, *control.computed_label, parameters_);
  const std::optional<double> whole = value ? whole_within(*value, 0, highest_label) : std::nullopt;
  if (!whole) return false;
  label = symbols_.intern(plain_number(*whole));
  return true;
}

bool ProgramFlow::argument(const Control& control, double& value) {
  if (!control.arguments.empty()) return value_of(*block_, control.arguments.front(), parameters_, reporter_, value);
  reporter_.error("gcode.missing-condition", control.span, "the O-word needs a value", "[…] behind it");
  return false;
}

void ProgramFlow::report_unclosed(const Open& open) {
  if (is_doubtful(open.label)) return;
  const ReaderPosition here = file_->reader.position();
  std::string_view text;
  std::uint32_t line = open.at.line;
  file_->reader.seek(open.at);
  (void)file_->reader.next_line(text, line, reporter_.diagnostics());
  const std::size_t first = text.find_first_of("oO");
  const Span span = first == std::string_view::npos
                        ? Span{1, 1}
                        : Span{static_cast<std::uint32_t>(first + 1), static_cast<std::uint32_t>(text.size() - first)};
  reporter_.error_at("gcode.unclosed-o-word", line, text, span,
                     fmt::format("{} {} is never closed", name_of(open.kind), label_text(open.label)),
                     open.kind == program ? std::string("M99")
                                          : fmt::format("o{} {}", label_text(open.label), name_of_end(open.kind)));
  reread_block_text();
  file_->reader.seek(here);
}

// M2 may stand in a branch, before the end of its construct.
void ProgramFlow::report_never_closed() {
  const ReaderPosition here = file_->reader.position();
  while (any_open()) {
    const Open open = open_.back();
    open_.pop_back();
    if (!is_closed_further_on(open)) report_unclosed(open);
  }
  file_->reader.seek(here);
}

// Reads on to the end of the construct. Nothing that is read is executed, and so nothing else is reported.
bool ProgramFlow::is_closed_further_on(const Open& open) {
  const ReaderPosition here = file_->reader.position();
  Block block;
  Diagnostics unheeded;
  std::string_view text;
  std::uint32_t line = 0;
  int inside = 0;
  while (file_->reader.next_line(text, line, unheeded)) {
    if (!may_be_control(text) || !file_->parser.parse(text, line, block, unheeded) || !block.control) continue;
    if (!frames_.empty() && block.control->kind == endsub && block.control->label == frames_.back().sub) break;
    // A computed label may be this one, so the construct is not said to lack its end.
    if (!block.control->computed_label && block.control->label != open.label) continue;
    const bool closes = (end_of(open.kind) >> static_cast<unsigned>(block.control->kind) & 1U) != 0;
    if (block.control->kind == open.kind && !closes) ++inside;
    if (closes && inside-- == 0) return true;
  }
  file_->reader.seek(here);
  return false;
}

bool ProgramFlow::stray(Symbol label, const Control& control, std::string message, std::string expected) {
  if (is_doubtful(label)) return false;
  reporter_.error("gcode.stray-o-word", control.span, std::move(message), std::move(expected));
  return false;
}

}  // namespace passo
