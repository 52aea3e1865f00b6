// ProgramFlow: numbered programs as Fanuc writes them: O1234, called with M98 P1234 L, ended with M99.
//
// They share #1 … #30 with their caller and have names of their own, as in LinuxCNC, and like there the two styles of
// subs do not mix. What cannot be called is told and passed over, so that the run finds what else is wrong.
#include "program_flow.hpp"
#include <fmt/format.h>

namespace passo {

ProgramFlow::Followed ProgramFlow::follow(const SubprogramJump& jump) {
  if (jump.call) {
    if (jump.good && jump.passes > 0) call_program(jump);
    return Followed::goes_on;
  }
  if (frames_.empty()) return restart_main(jump) ? Followed::goes_on : Followed::main_ends;
  return end_program(jump);
}

void ProgramFlow::call_program(const SubprogramJump& jump) {
  const Symbol label = symbols_.intern(fmt::format("{}", jump.program));
  if (!has_room_for_call(jump.span)) return;
  Frame frame{file_, file_->reader.position(), label, {}, open_.size(), static_cast<std::uint64_t>(jump.passes)};
  File* const file = find_sub(label);
  if (file == nullptr) return report_unknown_sub(label, jump.span, true);
  frame.place = file->subs.at(label.id);
  if (!check_style(frame.place, label, jump.span, true)) return;
  parameters_.enter_subprogram();
  enter(frame, file);
}

void ProgramFlow::run_again() {
  parameters_.enter_subprogram();
  enter(again_->frame, again_->file);
  again_.reset();
}

// M99 where a numbered program runs: back, and perhaps in again with fresh names. Its caller is told each time.
ProgramFlow::Followed ProgramFlow::end_program(const SubprogramJump& jump) {
  Frame frame = frames_.back();
  if (!frame.place.numbered) {
    reporter_.error("gcode.mixed-subs", jump.span,
                    fmt::format("M99 in o{} sub, which begins at line {}", label_text(frame.sub), frame.place.at.line),
                    fmt::format("o{0} endsub, or o{0} return", label_text(frame.sub)));
    leave_frame();
    return Followed::left_sub;
  }
  File* const file = file_;
  const bool again = --frame.passes_left > 0;
  if (again && !go_round({ControlKind::program, frame.sub, frame.place.at, {}, 0})) return Followed::goes_on;
  leave_frame();
  if (again) again_ = Again{frame, file};
  return Followed::left_sub;
}

// M99 in the main program: from its beginning again, as often as is allowed.
bool ProgramFlow::restart_main(const SubprogramJump& jump) {
  if (++main_passes_ == options_.main_passes) return false;
  if (++idle_passes_ > options_.idle_passes) {
    reporter_.error("gcode.endless-loop", jump.span,
                    fmt::format("the program began again {} times without any operation", options_.idle_passes),
                    "a program that moves, or M2 in place of M99");
    finish(End::error);
    return true;
  }
  open_.clear();
  begun_ = false;
  file_->reader.seek({});
  return true;
}

bool ProgramFlow::check_style(const SubPlace& place, Symbol label, Span span, bool called_by_m98) {
  if (place.numbered == called_by_m98) return true;
  const std::string name = label_text(label);
  reporter_.error("gcode.mixed-subs", span,
                  called_by_m98
                      ? fmt::format("M98 calls o{} sub, at line {}", name, place.at.line)
                      : fmt::format("O{} at line {} is a numbered program, called like a sub", name, place.at.line),
                  called_by_m98 ? fmt::format("o{} call", name) : fmt::format("M98 P{}", name));
  return false;
}

}  // namespace passo
