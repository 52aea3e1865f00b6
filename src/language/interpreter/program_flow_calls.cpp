// ProgramFlow: calling subs, and leaving them.
#include "interpreter_sentences.hpp"
#include "program_flow.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {

void ProgramFlow::call(Symbol label, const Control& control) {
  if (!may_call(control.span)) return;
  if (control.arguments.size() > sub_parameters) {
    reporter_.error("gcode.too-many-arguments", control.span,
                    fmt::format("a call with {} arguments", control.arguments.size()), "at most 30: #1 to #30");
    return;
  }
  std::array<double, sub_parameters> arguments{};
  for (std::size_t i = 0; i < control.arguments.size(); ++i) {
    if (!value_of(lines_.block(), control.arguments[i], parameters_, reporter_, arguments[i])) return;
  }

  Frame frame{&lines_.file(), lines_.after(), label, {}, open_.size(), reporter_.errors()};
  File* const file = lines_.find_sub(label);
  if (file == nullptr) return report_unknown_sub(label, control.span, false);
  frame.place = file->subs.at(label.id);
  if (!check_style(frame.place, label, control.span, {})) return;
  parameters_.enter_sub({arguments.data(), control.arguments.size()});
  enter(frame, file);
}

// False: calls are nested too deep, or the program called too often.
bool ProgramFlow::may_call(Span span) {
  if (is_outermost()) bounds_.begin();
  const RunawayGuard::Reached reached = bounds_.count_call();
  const bool idles = reached == RunawayGuard::Reached::idle;
  if (frames_.size() >= deepest_call) {
    reporter_.error("gcode.calls-too-deep", span, fmt::format("calls are nested more than {} deep", deepest_call),
                    "a subroutine that does not call itself endlessly");
  } else if (reached != RunawayGuard::Reached::nothing) {
    reporter_.error("gcode.endless-calls", span,
                    idles ? fmt::format("subroutines were called {} without any action of the machine",
                                        counted(bounds_.limits().idle_passes, "time"))
                          : fmt::format("the call from line {} reached {} passes, calls and operations",
                                        frames_.empty() ? lines_.at().line : frames_.front().return_to.line - 1,
                                        bounds_.limits().repeated_steps),
                    "a subroutine that does not call itself endlessly");
  } else {
    return true;
  }
  finish(End::error);
  return false;
}

// The diagnostic says where the sub was searched for.
void ProgramFlow::report_unknown_sub(Symbol label, Span span, bool numbered) {
  const std::string sub = fmt::format("{}{}{}", numbered ? "O" : "o", label_text(label), numbered ? "" : " sub");
  const std::string file = std::string(symbols_.name(label)) + ".ngc";
  if (lines_.unreadable_labels().has(label)) {
    reporter_.meet_again();
  } else {
    reporter_.error("gcode.unknown-sub", span,
                    (numbered ? interpreter_says::no_program : interpreter_says::no_sub)
                        .with({{"name", std::string(label_text(label))}}),
                    fmt::format("{} in this file, or in a file {} {}", sub, file, lines_.places_looked_at(file)));
  }
  // The run goes on to find more errors, but not for ever with a loop of calls that lead nowhere.
  if (bounds_.is_last_unknown_call()) finish(End::error);
}

void ProgramFlow::enter(const Frame& frame, File* file) {
  frames_.push_back(frame);
  state_.call_depth = static_cast<int>(frames_.size());
  lines_.seek(*file, frame.place.after);
}

void ProgramFlow::leave_frame() {
  const Frame frame = frames_.back();
  open_.resize(frame.first_open);
  frames_.pop_back();
  parameters_.leave_sub();
  state_.call_depth = static_cast<int>(frames_.size());
  lines_.seek(*frame.caller, frame.return_to);
  left_sub_ = frame.return_to.line - 1;
}

std::vector<CallLocation> ProgramFlow::calls() const {
  std::vector<CallLocation> calls;
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    calls.push_back(
        {(frame->place.numbered ? "O" : "o") + label_text(frame->sub), frame->caller->name, frame->return_to.line - 1});
  }
  return calls;
}

bool ProgramFlow::call_for_contour(Symbol sub, Span span) {
  Control control;
  control.kind = ControlKind::call;
  control.span = span;
  const std::size_t depth = frames_.size() + 1;
  call(sub, control);
  if (frames_.size() != depth) return false;
  contour_depth_ = depth;
  return true;
}

}  // namespace passo
