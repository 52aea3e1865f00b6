// ProgramFlow: numbered programs as Fanuc writes them: O1234, called with M98 P1234 L or G65 P1234 L, ended with M99.
//
// A numbered program has named parameters of its own. Called by M98, it shares #1 … #30 with its caller, as in
// LinuxCNC. Called by G65 or G66, it has its arguments there. Numbered programs and subs with O-words do not mix. What
// cannot be called is reported and skipped, so that the run finds more errors.
#include <algorithm>

#include "program_flow.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {

ProgramFlow::Followed ProgramFlow::follow(const SubprogramJump& jump) {
  if (jump.kind == SubprogramJump::Kind::user_code) {
    call_user_code(jump);
    return Followed::goes_on;
  }
  if (!check_numbered_programs(jump.span, jump.code())) {
    return jump.kind == SubprogramJump::Kind::leave && frames_.empty() ? Followed::main_ends : Followed::goes_on;
  }
  if (jump.kind != SubprogramJump::Kind::leave) {
    if (jump.good && jump.passes > 0) call_program(jump);
    return Followed::goes_on;
  }
  if (frames_.empty()) return restart_main(jump) ? Followed::goes_on : Followed::main_ends;
  return end_program(jump);
}

void ProgramFlow::call_program(const SubprogramJump& jump) {
  using Kind = SubprogramJump::Kind;
  // A move in a macro of G66 does not call the macro again.
  if (jump.kind == Kind::modal_macro && std::ranges::any_of(frames_, &Frame::modal_macro)) return;
  const Symbol label = symbols_.intern(fmt::format("{}", jump.program));
  if (!may_call(jump.span)) return;
  Frame frame{&lines_.file(),
              lines_.after(),
              label,
              {},
              open_.size(),
              reporter_.errors(),
              static_cast<std::uint64_t>(jump.passes)};
  File* const file = lines_.find_sub(label);
  if (file == nullptr) return report_unknown_sub(label, jump.span, true);
  frame.place = file->subs.at(label.id);
  if (!check_style(frame.place, label, jump.span, jump.code()) || jump.kind == Kind::find_macro) return;
  frame.modal_macro = jump.kind == Kind::modal_macro;
  if (jump.is_macro()) frame.arguments = jump.arguments;
  enter_program(frame, file);
}

// A user code calls a subroutine with O-words, in the file of its name.
void ProgramFlow::call_user_code(const SubprogramJump& jump) {
  const Symbol label = symbols_.intern(fmt::format("m{}", jump.program));
  if (!may_call(jump.span)) return;
  Frame frame{&lines_.file(), lines_.after(), label, {}, open_.size(), reporter_.errors()};
  File* const file = lines_.find_sub(label);
  if (file == nullptr) return report_unknown_sub(label, jump.span, false);
  frame.place = file->subs.at(label.id);
  if (!check_style(frame.place, label, jump.span, {})) return;
  parameters_.enter_sub(jump.arguments);
  enter(frame, file);
}

void ProgramFlow::enter_program(const Frame& frame, File* file) {
  if (frame.arguments) {
    parameters_.enter_sub(*frame.arguments);
  } else {
    parameters_.enter_subprogram();
  }
  enter(frame, file);
}

void ProgramFlow::run_again() {
  enter_program(again_->frame, again_->file);
  again_.reset();
}

// M99 in a numbered program. It goes back to the caller. If passes are left, the program is then entered again with
// fresh names. left_sub is returned after each pass.
ProgramFlow::Followed ProgramFlow::end_program(const SubprogramJump& jump) {
  Frame frame = frames_.back();
  if (!frame.place.numbered) {
    reporter_.error("gcode.mixed-subs", jump.span,
                    fmt::format("M99 in o{} sub, which starts in line {}", label_text(frame.sub), frame.place.at.line),
                    fmt::format("o{0} endsub, or o{0} return", label_text(frame.sub)));
    leave_frame();
    return Followed::left_sub;
  }
  File* const file = &lines_.file();
  const bool again = --frame.passes_left > 0 && reporter_.errors() == frame.errors_before;
  if (again && !may_go_round({ControlKind::program, frame.sub, frame.place.at, {}})) return Followed::goes_on;
  leave_frame();
  if (again) again_ = Again{frame, file};
  return Followed::left_sub;
}

// M99 in the main program. The program begins again, as often as is allowed, unless it has errors. False: it does not.
bool ProgramFlow::restart_main(const SubprogramJump& jump) {
  if (!bounds_.count_main_pass() || reporter_.errors() > 0) return false;
  if (!bounds_.count_restart()) {
    reporter_.error("gcode.endless-loop", jump.span,
                    fmt::format("the program restarted {} without any machine action",
                                counted(bounds_.limits().idle_passes, "time")),
                    "a program that moves, or M2 in place of M99");
    finish(End::error);
    return true;
  }
  open_.clear();
  lines_.percent_signs().restart();
  lines_.seek({});
  return true;
}

bool ProgramFlow::check_numbered_programs(Span span, std::string_view what) {
  if (numbered_programs_) return true;
  reporter_.error("gcode.no-numbered-programs", span,
                  fmt::format("{}, but the settings disable numbered programs", what),
                  "o<name> sub and o<name> call, or the settings without [RS274NGC]DISABLE_FANUC_STYLE_SUB");
  return false;
}

// `caller`: M98, G65 or G66; empty: an O-word.
bool ProgramFlow::check_style(const SubPlace& place, Symbol label, Span span, std::string_view caller) {
  if (place.numbered != caller.empty()) return true;
  const std::string name = label_text(label);
  reporter_.error("gcode.mixed-subs", span,
                  place.numbered ? fmt::format("O{} in line {} is a numbered program, but is called like a subroutine",
                                               name, place.at.line)
                                 : fmt::format("{} calls o{} sub, in line {}", caller, name, place.at.line),
                  place.numbered ? fmt::format("M98 P{}", name) : fmt::format("o{} call", name));
  return false;
}

}  // namespace passo
