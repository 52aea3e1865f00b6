#include "program_lines.hpp"

#include <algorithm>

#include "block_words.hpp"
#include "file_place.hpp"
#include "grbl_dialect.hpp"
#include "interpreter_sentences.hpp"
#include "whole_number.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

bool is_deleted(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first != std::string_view::npos && text[first] == '/';
}

bool is_percent(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first != std::string_view::npos && text.find_last_not_of(" \t") == first && text[first] == '%';
}

// Whether the words of the line have M2 or M30. Comments do not count.
bool is_program_end(std::string_view text) {
  for (std::size_t i = 0; i < text.size() && text[i] != ';'; ++i) {
    if (text[i] == '(') {
      i = std::min(text.find(')', i), text.size());
      continue;
    }
    if (text[i] != 'M' && text[i] != 'm') continue;
    std::string number;
    for (std::size_t k = i + 1; k < text.size() && (text[k] == ' ' || (text[k] >= '0' && text[k] <= '9')); ++k) {
      if (text[k] != ' ' && !(number.empty() && text[k] == '0')) number += text[k];
    }
    if (number == "2" || number == "30") return true;
  }
  return false;
}

constexpr double highest_label = 1e9;

}  // namespace

ProgramLines::ProgramLines(ProgramReader reader, Options options, const ProgramState& state,
                           const Parameters& parameters, SymbolTable& symbols, Reporter& reporter)
    : options_(std::move(options)), state_(state), parameters_(parameters), symbols_(symbols), reporter_(reporter) {
  files_.push_back(std::make_unique<File>(std::move(reader), 0, symbols_));
  if (options_.dialect == Dialect::grbl) files_.front()->parser.accept_line_numbers_anywhere();
  file_ = files_.front().get();
  set_block(line_);
}

void ProgramLines::seek(File& file, ReaderPosition place) {
  file_ = &file;
  file_->reader.seek(place);
  set_block(*block_);
}

// Whether an 'O' comes first, after white space, '/' and N with its number. Nothing else is looked at in a skipped
// line.
bool ProgramLines::may_be_control(std::string_view text) {
  std::size_t i = 0;
  const auto at = [&](std::string_view any) { return i < text.size() && any.find(text[i]) != std::string_view::npos; };
  while (at(" \t/")) ++i;
  if (at("nN")) {
    ++i;
    while (at(" \t0123456789.")) ++i;
  }
  return at("oO");
}

// Whether a line that cannot be read has a word of the O-words, as "20 while [1]" has, which lacks its O.
bool ProgramLines::names_control(std::string_view text) {
  std::string small;
  for (const char c : text) small += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  constexpr std::string_view names[] = {"sub", "call", "return", "while", "repeat", "if", "else", "do"};
  return std::ranges::any_of(names, [&](std::string_view name) { return small.find(name) != std::string::npos; });
}

ProgramLines::Read ProgramLines::read() {
  block_at_ = file_->reader.position();
  if (reporter_.full()) return Read::end;
  if (recall()) return Read::block;
  std::string_view text;
  std::uint32_t line = 0;
  if (!next_line(text, line)) return Read::end;
  const bool good = !(options_.block_delete && is_deleted(text)) && parse(text, line);
  file_->read_to = std::max(file_->read_to, block_at_.offset + 1);
  return good ? Read::block : Read::skipped;
}

// Takes the block of the next line, if it is kept.
bool ProgramLines::recall() {
  if (block_at_.offset >= file_->read_to) return false;
  KeptBlock* const kept = kept_.find(file_->number, block_at_);
  if (kept == nullptr) return false;
  file_->reader.seek(kept->after);
  set_block(kept->block);
  return true;
}

bool ProgramLines::next_line(std::string_view& text, std::uint32_t& line) {
  const bool good = file_->reader.next_line(text, line, faults_);
  if (!faults_.all().empty()) reporter_.pass_on(faults_);
  return good;
}

// A line that is no G-code is reported once, however often a loop reads it. A line that is read a second time is kept.
bool ProgramLines::parse(std::string_view text, std::uint32_t line) {
  std::set<std::uint32_t>& unreadable = file_->unreadable;
  if (!unreadable.empty() && unreadable.contains(line)) {
    reporter_.meet_again();
    return false;
  }
  KeptBlock* kept = nullptr;
  if (block_at_.offset < file_->read_to && text.size() <= KeptBlocks::longest_text) {
    kept = &kept_.make_room(file_->number, block_at_, file_->reader.position(), text);
    text = kept->text;
  }
  set_block(kept != nullptr ? kept->block : line_);
  if (is_readable(text, line)) return true;
  doubt_label();
  reporter_.pass_on(faults_);
  reporter_.doubt();
  if (kept != nullptr) KeptBlocks::drop(*kept);
  if (!options_.open_ended) unreadable.insert(line);  // such a line never comes again
  return false;
}

// An O-word that cannot be read may begin or end a construct. Its label is known if the fault comes after its keyword.
void ProgramLines::doubt_label() {
  const bool is_control = may_be_control(block_->text);
  if (!is_control && !names_control(block_->text)) return;
  const bool is_named = !faults_.all().empty() && faults_.all().front().code != "gcode.bad-o-word";
  if (is_control && is_named && block_->control && block_->control->label) {
    unreadable_labels_.add(block_->control->label);
  } else {
    unreadable_labels_.add_all();
  }
}

void ProgramLines::set_block(Block& block) {
  block_ = &block;
  reporter_.set_block(block, file_->name);
}

// grbl reads word by word, so of several errors it tells the first.
bool ProgramLines::is_readable(std::string_view text, std::uint32_t line) {
  const bool good = file_->parser.parse(text, line, *block_, faults_);
  if (options_.dialect == Dialect::linuxcnc) return good;
  // Senders send no '%' of a file.
  if (good && !options_.open_ended) block_->percent = false;
  if (good) return accept_as_grbl(*block_, state_, reporter_, options_.more_grbl_axes);
  if (refuse_as_grbl(*block_, state_, reporter_, options_.more_grbl_axes)) faults_ = Diagnostics();
  return false;
}

bool ProgramLines::read_control(Symbol& label, bool within_percents) {
  for (;;) {
    std::string_view text;
    std::uint32_t line = 0;
    block_at_ = file_->reader.position();
    if (within_percents || !recall()) {
      if (reporter_.full() || !next_line(text, line)) return false;
      if (within_percents && closes_program(text)) return false;
      if (!may_be_control(text) || (options_.block_delete && is_deleted(text)) || !parse(text, line)) continue;
    }
    if (!block_->control) continue;
    if (label_of_skipped(*block_->control, label)) return true;
  }
}

void ProgramLines::reread_block_text() {
  if (block_ != &line_) return;
  std::uint32_t line = 0;
  file_->reader.seek(block_at_);
  if (!file_->reader.next_line(block_->text, line, reporter_.diagnostics())) block_->text = {};
}

// True: the line is the closing '%' of the main file. What follows is not part of the program.
bool ProgramLines::closes_program(std::string_view text) {
  if (!percent_signs_.opened() || file_ != files_.front().get() || !is_percent(text)) return false;
  return std::exchange(file_->seen_percent, true);
}

// Subs and numbered programs may stand behind the end. Nothing that is read is executed, and so nothing else is
// reported.
void ProgramLines::report_moves_after_end() {
  const ReaderPosition here = file_->reader.position();
  Block block;
  Diagnostics unheeded;
  std::string_view text;
  std::uint32_t line = 0;
  int subs = 0;
  bool numbered = false;
  while (file_->reader.next_line(text, line, unheeded) && !is_percent(text)) {
    if ((options_.block_delete && is_deleted(text)) || !file_->parser.parse(text, line, block, unheeded)) continue;
    if (block.control) {
      if (block.control->kind == ControlKind::sub) ++subs;
      if (block.control->kind == ControlKind::endsub) --subs;
      if (block.control->kind == ControlKind::program) numbered = true;
      continue;
    }
    if (subs > 0 || numbered) continue;
    const auto axis_word =
        std::ranges::find_if(block.words, [](const Word& word) { return axis_letters.has(word.letter); });
    if (axis_word == block.words.end()) continue;
    reporter_.warning_at("gcode.move-after-end", line, text, axis_word->span, interpreter_says::move_after_end,
                         interpreter_says::end_after_moves);
  }
  file_->reader.seek(here);
}

bool ProgramLines::has_end() {
  ProgramReader& reader = files_.front()->reader;
  std::string_view text;
  std::uint32_t line = 0;
  Diagnostics unheeded;
  bool found = false;
  while (!found && reader.next_line(text, line, unheeded)) found = is_program_end(text);
  reader.seek({});
  return found;
}

bool ProgramLines::lacks_closing_percent(ReaderPosition from) {
  if (!percent_signs_.opened()) return false;
  ProgramReader& reader = files_.front()->reader;
  reader.seek(from);
  std::string_view text;
  std::uint32_t line = 0;
  while (reader.next_line(text, line, reporter_.diagnostics())) {
    if (is_percent(text)) return false;
  }
  return true;
}

// A line that is skipped is not executed, so its label may have no value. False: it has none, or is no label.
bool ProgramLines::label_of_skipped(const Control& control, Symbol& label) const {
  label = control.label;
  if (!control.computed_label) return true;
  const Evaluation value = evaluate(*block_, *control.computed_label, parameters_);
  const std::optional<Symbol> computed = value ? label_of_value(*value, symbols_) : std::nullopt;
  label = computed.value_or(label);
  return computed.has_value();
}

ProgramLines::File* ProgramLines::find_sub(Symbol label) {
  if (!options_.machine_programs.empty()) {
    if (File* const found = find_machine_program(label)) return found;
  }
  if (find_in(*file_, label)) return file_;
  for (const auto& file : files_) {
    if (file.get() != file_ && find_in(*file, label)) return file.get();
  }
  return open_named(label);
}

// Whether the file has the sub. Reads the part of the file whose subs are not known yet, once, and goes back to where
// the file was.
bool ProgramLines::find_in(File& file, Symbol label) {
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
ProgramLines::File* ProgramLines::open_named(Symbol label) {
  const std::string name = std::string(symbols_.name(label)) + ".ngc";
  File* file = open_in(folder_of_file(files_.front()->name), name);
  for (std::size_t i = 0; file == nullptr && i < options_.sub_folders.size(); ++i) {
    file = open_in(options_.sub_folders[i], name);
  }
  return file != nullptr && find_in(*file, label) ? file : nullptr;
}

// Null: there is no such program of the machine.
ProgramLines::File* ProgramLines::find_machine_program(Symbol label) {
  const auto found = std::ranges::find_if(options_.machine_programs, [&](const MachineProgram& one) {
    return symbols_.name(label) == fmt::format("{}", one.number);
  });
  if (found == options_.machine_programs.end()) return nullptr;
  for (const auto& file : files_) {
    if (file->name == found->name) return file.get();
  }
  const std::string text = fmt::format("O{}\n{}M99\n", found->number, found->lines);
  files_.push_back(std::make_unique<File>(ProgramReader::from_text(found->name, text), files_.size(), symbols_));
  return find_in(*files_.back(), label) ? files_.back().get() : nullptr;
}

ProgramLines::File* ProgramLines::open_in(const std::string& folder, const std::string& name) {
  constexpr std::size_t most_files = 64;
  const std::string path = file_in_folder(folder, name);
  for (const auto& file : files_) {
    if (file->name == path) return file.get();
  }
  if (files_.size() >= most_files || !is_regular_file(path)) return nullptr;
  auto reader = ProgramReader::open(path);
  if (!reader) return nullptr;
  files_.push_back(std::make_unique<File>(std::move(*reader), files_.size(), symbols_));
  return files_.back().get();
}

// Files that have the right name but not the sub are named too, because the sub may be spelled differently there.
std::string ProgramLines::places_looked_at(const std::string& file) const {
  std::string places = "next to the program";
  for (const std::string& folder : options_.sub_folders) places += " or in " + folder;
  for (const auto& open : files_) {
    if (open.get() == file_) continue;
    const bool has_its_name = name_without_folder(open->name) == file;
    places += fmt::format("; {} {}", open->name, has_its_name ? "exists, but does not contain it" : "was searched");
  }
  return places;
}

std::string label_text(const SymbolTable& symbols, Symbol label) {
  const std::string_view name = symbols.name(label);
  const bool number = name.find_first_not_of("0123456789") == std::string_view::npos;
  return number ? std::string(name) : fmt::format("<{}>", name);
}

std::optional<Symbol> label_of_value(double value, SymbolTable& symbols) {
  const std::optional<double> whole = whole_within(value, 0, highest_label);
  if (!whole) return {};
  return symbols.intern(plain_number(*whole));
}

}  // namespace passo
