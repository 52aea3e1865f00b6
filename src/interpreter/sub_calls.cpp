// ProgramFlow: calling subs, and finding them.
#include <filesystem>

#include "program_flow.hpp"
#include <fmt/format.h>

namespace passo {

void ProgramFlow::call(Symbol label, const Control& control) {
  if (!has_room_for_call(control.span)) return;
  if (control.arguments.size() > sub_parameters) {
    reporter_.error("gcode.too-many-arguments", control.span,
                    fmt::format("a call with {} arguments", control.arguments.size()), "30 at most: #1 to #30");
    return;
  }
  std::array<double, sub_parameters> arguments{};
  for (std::size_t i = 0; i < control.arguments.size(); ++i) {
    if (!value_of(block_, control.arguments[i], parameters_, reporter_, arguments[i])) return;
  }

  Frame frame{file_, file_->reader.position(), label, {}, open_.size(), 1};
  File* const file = find_sub(label);
  if (file == nullptr) return report_unknown_sub(label, control.span, false);
  frame.place = file->subs.at(label.id);
  if (!check_style(frame.place, label, control.span, {})) return;
  parameters_.enter_sub({arguments.data(), control.arguments.size()});
  enter(frame, file);
}

bool ProgramFlow::has_room_for_call(Span span) {
  if (frames_.size() < deepest_call) return true;
  reporter_.error("gcode.calls-too-deep", span, fmt::format("calls are nested more than {} deep", deepest_call),
                  "a sub that does not call itself for ever");
  finish(End::error);
  return false;
}

// Says where it was looked for.
void ProgramFlow::report_unknown_sub(Symbol label, Span span, bool numbered) {
  const std::string_view name = symbols_.name(label);
  reporter_.error("gcode.unknown-sub", span,
                  fmt::format("there is no {} {}", numbered ? "program" : "sub", label_text(label)),
                  fmt::format("{}{}{} in this file, or in a file {}.ngc {}", numbered ? "O" : "o", label_text(label),
                              numbered ? "" : " sub", name, places_looked_at()));
  finish(closing_percent_ ? End::percent : End::error);
}

void ProgramFlow::enter(const Frame& frame, File* file) {
  frames_.push_back(frame);
  state_.call_depth = static_cast<int>(frames_.size());
  file_ = file;
  file_->reader.seek(frame.place.after);
  reporter_.look_at(block_, file_->name);
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

// Whether the file has the sub. Reads on from where subs are known, once, and comes back.
bool ProgramFlow::find_in(File& file, Symbol label) {
  if (file.subs.contains(label.id)) return true;
  if (file.seen_all) return false;
  File* const reading = file_;
  const Block current = block_;  // the call's, which the search overwrites
  const ReaderPosition here = file.reader.position();
  const ReaderPosition call_at = block_at_;
  file_ = &file;
  file.reader.seek(file.seen);
  Symbol found;
  while (!file.seen_all && !file.subs.contains(label.id)) {
    if (!read_control(found, true)) {
      file.seen_all = true;
    } else if (block_.control->kind == ControlKind::sub || block_.control->kind == ControlKind::program) {
      const bool numbered = block_.control->kind == ControlKind::program;
      file.subs.try_emplace(found.id, SubPlace{block_at_, file.reader.position(), numbered});
    }
  }
  file.seen = file.reader.position();
  file.reader.seek(here);
  file_ = reading;
  block_ = current;
  block_at_ = call_at;
  if (&file == file_) {
    reread_block_text();
    file.reader.seek(here);
  }
  return file.subs.contains(label.id);
}

// The first file of that name counts, as in LinuxCNC.
ProgramFlow::File* ProgramFlow::open_named(Symbol label) {
  constexpr std::size_t most_files = 64;
  const std::string name = std::string(symbols_.name(label)) + ".ngc";
  const auto open_in = [&](const std::filesystem::path& folder) -> File* {
    const std::filesystem::path path = folder / name;
    std::error_code problem;
    if (files_.size() >= most_files || !std::filesystem::is_regular_file(path, problem)) return nullptr;
    auto reader = ProgramReader::open(path.string());
    if (!reader) return nullptr;
    files_.push_back(std::make_unique<File>(std::move(*reader), symbols_));
    return files_.back().get();
  };
  File* file = open_in(std::filesystem::path(files_.front()->name).parent_path());
  for (std::size_t i = 0; file == nullptr && i < options_.sub_folders.size(); ++i) {
    file = open_in(options_.sub_folders[i]);
  }
  return file != nullptr && find_in(*file, label) ? file : nullptr;
}

std::string ProgramFlow::places_looked_at() const {
  std::string places = "beside the program";
  for (const std::string& folder : options_.sub_folders) places += " or in " + folder;
  return places;
}

// As it is written behind the O: 100, <name>.
std::string ProgramFlow::label_text(Symbol label) const {
  const std::string_view name = symbols_.name(label);
  const bool number = name.find_first_not_of("0123456789") == std::string_view::npos;
  return number ? std::string(name) : fmt::format("<{}>", name);
}

}  // namespace passo
