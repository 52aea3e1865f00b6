// ProgramFlow: calling subs, leaving them, and finding them.
#include <filesystem>

#include "program_flow.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {

void ProgramFlow::call(Symbol label, const Control& control) {
  if (!may_call(control.span)) return;
  if (control.arguments.size() > sub_parameters) {
    reporter_.error("gcode.too-many-arguments", control.span,
                    fmt::format("a call with {} arguments", control.arguments.size()), "30 at most: #1 to #30");
    return;
  }
  std::array<double, sub_parameters> arguments{};
  for (std::size_t i = 0; i < control.arguments.size(); ++i) {
    if (!value_of(*block_, control.arguments[i], parameters_, reporter_, arguments[i])) return;
  }

  Frame frame{file_, file_->reader.position(), label, {}, open_.size(), reporter_.errors()};
  File* const file = find_sub(label);
  if (file == nullptr) return report_unknown_sub(label, control.span, false);
  frame.place = file->subs.at(label.id);
  if (!check_style(frame.place, label, control.span, {})) return;
  parameters_.enter_sub({arguments.data(), control.arguments.size()});
  enter(frame, file);
}

// False: calls are nested too deep, or the program called too often.
bool ProgramFlow::may_call(Span span) {
  if (is_outermost()) steps_ = 0;
  const bool idles = ++idle_calls_ > options_.idle_passes;
  if (frames_.size() >= deepest_call) {
    reporter_.error("gcode.calls-too-deep", span, fmt::format("calls are nested more than {} deep", deepest_call),
                    "a sub that does not call itself for ever");
  } else if (idles || ++steps_ > options_.repeated_steps) {
    reporter_.error(
        "gcode.endless-calls", span,
        idles ? fmt::format("the program called {}, and the machine did nothing", counted(options_.idle_passes, "time"))
              : fmt::format("the call from line {} came to {} passes, calls and operations",
                            frames_.empty() ? block_at_.line : frames_.front().return_to.line - 1,
                            options_.repeated_steps),
        "a sub that does not call itself again and again");
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
  if (is_doubtful(label)) {
    reporter_.meet_again();
  } else {
    reporter_.error("gcode.unknown-sub", span,
                    fmt::format("there is no {} {}", numbered ? "program" : "sub", label_text(label)),
                    fmt::format("{} in this file, or in a file {} {}", sub, file, places_looked_at(file)));
  }
  // The run goes on to find more errors, but not for ever with a loop of calls that lead nowhere.
  constexpr std::uint64_t most_unknown_calls = 1000;
  if (++unknown_calls_ == most_unknown_calls) finish(End::error);
}

void ProgramFlow::enter(const Frame& frame, File* file) {
  frames_.push_back(frame);
  state_.call_depth = static_cast<int>(frames_.size());
  file_ = file;
  file_->reader.seek(frame.place.after);
  set_block(*block_);
}

void ProgramFlow::leave_frame() {
  const Frame frame = frames_.back();
  open_.resize(frame.first_open);
  frames_.pop_back();
  parameters_.leave_sub();
  state_.call_depth = static_cast<int>(frames_.size());
  file_ = frame.caller;
  file_->reader.seek(frame.return_to);
  set_block(*block_);
  left_sub_ = frame.return_to.line - 1;
}

std::vector<CallPlace> ProgramFlow::calls() const {
  std::vector<CallPlace> calls;
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

ProgramFlow::File* ProgramFlow::find_sub(Symbol label) {
  if (find_in(*file_, label)) return file_;
  for (const auto& file : files_) {
    if (file.get() != file_ && find_in(*file, label)) return file.get();
  }
  return open_named(label);
}

// Whether the file has the sub. Reads the part of the file whose subs are not known yet, once, and goes back to where
// the file was.
bool ProgramFlow::find_in(File& file, Symbol label) {
  if (file.subs.contains(label.id)) return true;
  if (file.seen_all) return false;
  File* const reading = file_;
  const Block current = *block_;  // the block of the call, which the search overwrites
  const ReaderPosition here = file.reader.position();
  const ReaderPosition call_at = block_at_;
  file_ = &file;
  file.reader.seek(file.seen);
  Symbol found;
  while (!file.seen_all && !file.subs.contains(label.id)) {
    if (!read_control(found, true)) {
      file.seen_all = true;
    } else if (block_->control->kind == ControlKind::sub || block_->control->kind == ControlKind::program) {
      const bool numbered = block_->control->kind == ControlKind::program;
      file.subs.try_emplace(found.id, SubPlace{block_at_, file.reader.position(), numbered});
    }
  }
  file.seen = file.reader.position();
  file.reader.seek(here);
  file_ = reading;
  line_ = current;
  set_block(line_);
  block_at_ = call_at;
  const ReaderPosition next = file_->reader.position();
  reread_block_text();
  file_->reader.seek(next);
  return file.subs.contains(label.id);
}

// The first file of that name counts, as in LinuxCNC.
ProgramFlow::File* ProgramFlow::open_named(Symbol label) {
  const std::string name = std::string(symbols_.name(label)) + ".ngc";
  File* file = open_in(std::filesystem::path(files_.front()->name).parent_path().string(), name);
  for (std::size_t i = 0; file == nullptr && i < options_.sub_folders.size(); ++i) {
    file = open_in(options_.sub_folders[i], name);
  }
  return file != nullptr && find_in(*file, label) ? file : nullptr;
}

ProgramFlow::File* ProgramFlow::open_in(const std::string& folder, const std::string& name) {
  constexpr std::size_t most_files = 64;
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  for (const auto& file : files_) {
    if (file->name == path.string()) return file.get();
  }
  std::error_code problem;
  if (files_.size() >= most_files || !std::filesystem::is_regular_file(path, problem)) return nullptr;
  auto reader = ProgramReader::open(path.string());
  if (!reader) return nullptr;
  files_.push_back(std::make_unique<File>(std::move(*reader), files_.size(), symbols_));
  return files_.back().get();
}

// Files that have the right name but not the sub are named too, because the sub may be spelled differently there.
std::string ProgramFlow::places_looked_at(const std::string& file) const {
  std::string places = "beside the program";
  for (const std::string& folder : options_.sub_folders) places += " or in " + folder;
  for (const auto& open : files_) {
    if (open.get() == file_) continue;
    const bool has_its_name = std::filesystem::path(open->name).filename() == file;
    places += fmt::format("; {} {}", open->name, has_its_name ? "is there without it" : "was looked through");
  }
  return places;
}

// The label as it is written after the O: 100, <name>.
std::string ProgramFlow::label_text(Symbol label) const {
  const std::string_view name = symbols_.name(label);
  const bool number = name.find_first_not_of("0123456789") == std::string_view::npos;
  return number ? std::string(name) : fmt::format("<{}>", name);
}

}  // namespace passo
