#include "control_flow.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ControlKind;

// Whether a line that is being skipped may hold an O-word: cheap, and wrong only on the safe side.
bool may_be_o_word(std::string_view line) {
  std::size_t i = 0;
  const auto skip = [&](std::string_view characters) {
    while (i < line.size() && characters.find(line[i]) != std::string_view::npos) ++i;
  };
  skip(" \t/");
  if (i < line.size() && (line[i] == 'n' || line[i] == 'N')) {
    ++i;
    skip(" \t0123456789.");
  }
  return i < line.size() && (line[i] == 'o' || line[i] == 'O');
}

std::string directory_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

const char* closing_word(ControlKind kind) {
  switch (kind) {
    case sub: return "endsub";
    case while_: return "endwhile";
    case do_: return "while";
    case repeat: return "endrepeat";
    default: return "endif";
  }
}

}  // namespace

ControlFlow::ControlFlow(ProgramReader main, SymbolTable& symbols, Parameters& parameters, Diagnostics& diagnostics,
                         std::uint64_t idle_passes)
    : symbols_(symbols), parameters_(parameters), diagnostics_(diagnostics), most_passes_(idle_passes) {
  const std::string name = main.name();
  files_.push_back(std::make_unique<File>(File{std::move(main), BlockParser(name, symbols)}));
}

bool ControlFlow::next(Block& block, bool block_delete) {
  for (;;) {
    if (!read(block)) return report_unclosed();
    if (block.block_delete && block_delete) continue;
    if (!block.control) return true;
    if (!follow(block)) return false;
  }
}

// The next block that parses; what does not is reported.
bool ControlFlow::read(Block& block) {
  File& file = *files_[current_];
  for (;;) {
    line_ = {.file = current_, .position = file.reader.position()};
    std::string_view text;
    std::uint32_t line = 0;
    if (diagnostics_.full() || !file.reader.next_line(text, line, diagnostics_)) return false;
    if (file.parser.parse(text, line, block, diagnostics_)) return true;
  }
}

bool ControlFlow::follow(Block& block) {
  Symbol label;
  if (!label_of(block, label)) return false;
  switch (block.control->kind) {
    case sub: return on_sub(block, label);
    case call: return on_call(block, label);
    case endsub:
    case return_: return on_return(block, label);
    case do_: return open(block, label);
    case while_: return on_while(block, label);
    case repeat: return on_repeat(block, label);
    case if_: return on_if(block, label);
    case elseif:
    case else_:
    case endwhile:
    case endrepeat:
    case endif: return on_end(block, label);
    case break_:
    case continue_: return on_break(block, label);
    case program:
      return error(block, "gcode.unsupported-code", block.control->span,
                   "numbered subprograms (M98) are not supported by this release", "o<name> sub and o<name> call");
  }
  return false;
}

bool ControlFlow::error(const Block& block, const char* code, Span span, std::string message,
                        std::string expected) const {
  return Reporter(file(), block, diagnostics_).error(code, span, std::move(message), std::move(expected));
}

bool ControlFlow::label_of(const Block& block, Symbol& label) {
  label = block.control->label;
  if (!block.control->computed_label) return true;
  double value = 0;
  const Reporter reporter(file(), block, diagnostics_);
  if (!evaluate(block, *block.control->computed_label, parameters_, reporter, value)) return false;
  label = symbols_.intern(fmt::format("{}", std::llround(value)));
  return true;
}

bool ControlFlow::argument(const Block& block, std::size_t i, double& value) {
  return evaluate(block, block.control->arguments[i], parameters_, Reporter(file(), block, diagnostics_), value);
}

bool ControlFlow::condition(const Block& block, bool& holds) {
  double value = 0;
  if (!argument(block, 0, value)) return false;
  holds = value != 0;
  return true;
}

ControlFlow::Opening ControlFlow::opening_at(const Block& block, Symbol label) const {
  return {.kind = block.control->kind,
          .label = label,
          .at = line_,
          .after = {.file = current_, .position = files_[current_]->reader.position()},
          .span = block.control->span};
}

bool ControlFlow::open(const Block& block, Symbol label, std::uint64_t left) {
  if (openings_.size() == deepest_nesting) {
    return error(block, "gcode.nesting-too-deep", block.control->span, "loops and branches are nested too deeply",
                 fmt::format("at most {}", deepest_nesting));
  }
  openings_.push_back(opening_at(block, label));
  openings_.back().left = left;
  return true;
}

void ControlFlow::go_to(const Place& place) {
  current_ = place.file;
  files_[current_]->reader.seek(place.position);
}

bool ControlFlow::jump_back(const Block& block, const Place& place) {
  if (++passes_ > most_passes_) {
    return error(block, "gcode.endless-loop", block.control->span,
                 fmt::format("the loop went round {} times and did nothing", most_passes_),
                 "a condition that ends, or something to do in it");
  }
  go_to(place);
  return true;
}

// Reads on until an O-word of this label and one of these kinds.
bool ControlFlow::skip_to(Block& block, Symbol label, std::initializer_list<ControlKind> kinds, const Opening& from) {
  File& file = *files_[current_];
  std::string_view text;
  std::uint32_t line = 0;
  for (;;) {
    line_ = {.file = current_, .position = file.reader.position()};
    if (diagnostics_.full() || !file.reader.next_line(text, line, diagnostics_)) break;
    if (!may_be_o_word(text) || !file.parser.parse(text, line, block, diagnostics_) || !block.control) continue;
    if (std::ranges::find(kinds, block.control->kind) == kinds.end()) continue;
    Symbol found;
    if (!label_of(block, found)) return false;
    if (found == label) return true;
  }
  openings_.push_back(from);
  return report_unclosed();
}

// The program is at its end: whatever is open was never closed.
bool ControlFlow::report_unclosed() {
  const std::size_t base = calls_.empty() ? 0 : calls_.back().openings;
  if (openings_.size() <= base || diagnostics_.full()) return false;
  const Opening opening = openings_.back();
  openings_.resize(base);
  go_to(opening.at);
  Block block;
  std::string_view text;
  if (files_[current_]->reader.next_line(text, block.line, diagnostics_)) {
    block.text = text;
    error(block, "gcode.unclosed-o-word", opening.span, fmt::format("{} is never closed", name(opening.label)),
          fmt::format("{} {} after it", name(opening.label), closing_word(opening.kind)));
  }
  return false;
}

bool ControlFlow::on_sub(Block& block, Symbol label) {
  const Opening opening = opening_at(block, label);
  subs_[label.id] = opening.after;
  return skip_to(block, label, {endsub}, opening);
}

bool ControlFlow::on_call(const Block& block, Symbol label) {
  if (calls_.size() == deepest_call) {
    return error(block, "gcode.calls-too-deep", block.control->span, "subroutines call each other too deeply",
                 fmt::format("at most {} calls within calls", deepest_call));
  }
  std::vector<double> arguments(block.control->arguments.size());
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!argument(block, i, arguments[i])) return false;
  }
  const Place back = opening_at(block, label).after;
  const Span span = block.control->span;
  Place place;
  if (!find_sub(label, place)) {
    // Looking for it has overwritten the line.
    go_to(line_);
    std::string_view text;
    Block again;
    if (files_[current_]->reader.next_line(text, again.line, diagnostics_)) again.text = text;
    return error(again, "gcode.missing-sub", span, fmt::format("there is no subroutine {}", name(label)),
                 fmt::format("{} sub in this program, or a file {}{}.ngc", name(label), directory_of(file()),
                             symbols_.name(label)));
  }
  calls_.push_back({.label = label, .back = back, .openings = openings_.size()});
  parameters_.enter(arguments);
  go_to(place);
  return true;
}

bool ControlFlow::find_sub(Symbol label, Place& place) {
  if (const auto known = subs_.find(label.id); known != subs_.end()) {
    place = known->second;
    return true;
  }
  const Place here{.file = current_, .position = files_[current_]->reader.position()};
  bool found = find_sub_in(current_, label, here.position, place);
  std::size_t file = 0;
  if (!found && open_file(label, file)) found = find_sub_in(file, label, ReaderPosition(), place);
  go_to(here);
  if (found) subs_[label.id] = place;
  return found;
}

bool ControlFlow::find_sub_in(std::size_t file_index, Symbol label, ReaderPosition from, Place& place) {
  File& file = *files_[file_index];
  file.reader.seek(from);
  Block block;
  Diagnostics ignored;
  std::string_view text;
  std::uint32_t line = 0;
  while (file.reader.next_line(text, line, ignored)) {
    if (!may_be_o_word(text) || !file.parser.parse(text, line, block, ignored) || !block.control) continue;
    if (block.control->kind != sub || block.control->label != label) continue;
    place = {.file = file_index, .position = file.reader.position()};
    return true;
  }
  return false;
}

bool ControlFlow::open_file(Symbol label, std::size_t& file) {
  const std::string path = directory_of(files_.front()->reader.name()) + std::string(symbols_.name(label)) + ".ngc";
  Result<ProgramReader, Diagnostic> reader = ProgramReader::open(path);
  if (!reader) return false;
  file = files_.size();
  files_.push_back(std::make_unique<File>(File{std::move(*reader), BlockParser(path, symbols_)}));
  return true;
}

bool ControlFlow::on_return(const Block& block, Symbol label) {
  if (calls_.empty() || calls_.back().label != label) {
    return error(block, "gcode.return-outside-sub", block.control->span,
                 fmt::format("{} is not being called here", name(label)), "the label of the subroutine that runs");
  }
  double value = 0;
  const bool returns = !block.control->arguments.empty();
  if (returns && !argument(block, 0, value)) return false;
  parameters_.leave();
  if (returns) parameters_.set_named(symbols_.intern("_value"), value);
  openings_.resize(calls_.back().openings);
  go_to(calls_.back().back);
  calls_.pop_back();
  return true;
}

bool ControlFlow::on_while(Block& block, Symbol label) {
  bool holds = false;
  if (!condition(block, holds)) return false;
  const bool is_open = !openings_.empty() && openings_.back().label == label;
  if (is_open && openings_.back().kind == do_) {
    if (holds) return jump_back(block, openings_.back().after);
    openings_.pop_back();
    return true;
  }
  // A while that is open already is the same one, come round again.
  if (holds) return is_open && openings_.back().kind == while_ ? true : open(block, label);
  const Opening opening = opening_at(block, label);
  if (is_open) openings_.pop_back();
  return skip_to(block, label, {endwhile}, opening);
}

bool ControlFlow::on_repeat(Block& block, Symbol label) {
  double count = 0;
  if (!argument(block, 0, count)) return false;
  if (count >= 0.5) return open(block, label, static_cast<std::uint64_t>(std::min(std::round(count), 1e18)));
  return skip_to(block, label, {endrepeat}, opening_at(block, label));
}

bool ControlFlow::on_if(Block& block, Symbol label) {
  const Opening opening = opening_at(block, label);
  for (;;) {
    bool holds = block.control->kind == else_;
    if (block.control->kind == endif) return true;
    if (!holds && !condition(block, holds)) return false;
    if (holds) {
      openings_.push_back(opening);
      return true;
    }
    if (!skip_to(block, label, {elseif, else_, endif}, opening)) return false;
  }
}

// A word that closes what is open: an end, or the next branch of an if whose first one was taken.
bool ControlFlow::on_end(const Block& block, Symbol label) {
  const ControlKind kind = block.control->kind;
  const ControlKind opened_by = kind == endwhile ? while_ : kind == endrepeat ? repeat : if_;
  const std::size_t base = calls_.empty() ? 0 : calls_.back().openings;
  if (openings_.size() <= base || openings_.back().label != label || openings_.back().kind != opened_by) {
    return error(block, "gcode.unopened-o-word", block.control->span, fmt::format("{} is not open here", name(label)),
                 "what it closes, with the same label, before it");
  }
  Opening& opening = openings_.back();
  if (kind == endwhile) return jump_back(block, opening.at);
  if (kind == endrepeat && --opening.left > 0) return jump_back(block, opening.after);
  const Opening closed = opening;
  openings_.pop_back();
  if (kind != elseif && kind != else_) return true;
  Block end;
  return skip_to(end, label, {endif}, closed);
}

bool ControlFlow::on_break(Block& block, Symbol label) {
  const std::size_t base = calls_.empty() ? 0 : calls_.back().openings;
  const auto is_it = [&](const Opening& opening) { return opening.label == label && opening.kind != if_; };
  while (openings_.size() > base && !is_it(openings_.back())) openings_.pop_back();
  if (openings_.size() <= base) {
    return error(block, "gcode.unopened-o-word", block.control->span,
                 fmt::format("there is no loop {} around this", name(label)), "the label of a loop that runs");
  }
  const Opening loop = openings_.back();
  const ControlKind end = loop.kind == do_ ? while_ : loop.kind == while_ ? endwhile : endrepeat;
  if (block.control->kind == break_) {
    openings_.pop_back();
    return skip_to(block, label, {end}, loop);
  }
  if (loop.kind == while_) return jump_back(block, loop.at);
  return skip_to(block, label, {end}, loop) && follow(block);
}

}  // namespace passo
