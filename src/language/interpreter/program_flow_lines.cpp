// ProgramFlow: the lines. A line is read and parsed, or its block was kept from an earlier pass.
#include <algorithm>

#include "grbl_dialect.hpp"
#include "program_flow.hpp"

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

}  // namespace

// Whether an 'O' comes first, after white space, '/' and N with its number. Nothing else is looked at in a skipped
// line.
bool ProgramFlow::may_be_control(std::string_view text) {
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
bool ProgramFlow::names_control(std::string_view text) {
  std::string small;
  for (const char c : text) small += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  constexpr std::string_view names[] = {"sub", "call", "return", "while", "repeat", "if", "else", "do"};
  return std::ranges::any_of(names, [&](std::string_view name) { return small.find(name) != std::string::npos; });
}

ProgramFlow::Read ProgramFlow::read() {
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
bool ProgramFlow::recall() {
  if (block_at_.offset >= file_->read_to) return false;
  KeptBlock* const kept = kept_.find(file_->number, block_at_);
  if (kept == nullptr) return false;
  file_->reader.seek(kept->after);
  set_block(kept->block);
  return true;
}

bool ProgramFlow::next_line(std::string_view& text, std::uint32_t& line) {
  const bool good = file_->reader.next_line(text, line, faults_);
  if (!faults_.all().empty()) reporter_.pass_on(faults_);
  return good;
}

// A line that is no G-code is reported once, however often a loop reads it. A line that is read a second time is kept.
bool ProgramFlow::parse(std::string_view text, std::uint32_t line) {
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
void ProgramFlow::doubt_label() {
  const bool is_control = may_be_control(block_->text);
  if (!is_control && !names_control(block_->text)) return;
  const bool is_named = !faults_.all().empty() && faults_.all().front().code != "gcode.bad-o-word";
  if (is_control && is_named && block_->control && block_->control->label) {
    doubtful_labels_.insert(block_->control->label.id);
  } else {
    all_labels_doubtful_ = true;
  }
}

void ProgramFlow::set_block(Block& block) {
  block_ = &block;
  reporter_.set_block(block, file_->name);
}

// grbl reads word by word, so of several errors it tells the first.
bool ProgramFlow::is_readable(std::string_view text, std::uint32_t line) {
  const bool good = file_->parser.parse(text, line, *block_, faults_);
  if (options_.dialect == Dialect::linuxcnc) return good;
  // Senders send no '%' of a file.
  if (good && !options_.open_ended) block_->percent = false;
  if (good) return accept_as_grbl(*block_, state_, reporter_, options_.more_grbl_axes);
  if (refuse_as_grbl(*block_, state_, reporter_, options_.more_grbl_axes)) faults_ = Diagnostics();
  return false;
}

// Reads on to the next line with an O-word. False: there is none.
bool ProgramFlow::read_control(Symbol& label, bool within_percents) {
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

// For use after another place of the file was read. The text of a block that is not kept belongs to the reader, and is
// lost.
void ProgramFlow::reread_block_text() {
  if (block_ != &line_) return;
  std::uint32_t line = 0;
  file_->reader.seek(block_at_);
  if (!file_->reader.next_line(block_->text, line, reporter_.diagnostics())) block_->text = {};
}

// True: the line is the closing '%' of the main file. What follows is not part of the program.
bool ProgramFlow::closes_program(std::string_view text) {
  if (!opened_percent_ || file_ != files_.front().get() || !is_percent(text)) return false;
  return std::exchange(file_->seen_percent, true);
}

// Subs and numbered programs may stand behind the end. Nothing that is read is executed, and so nothing else is
// reported.
void ProgramFlow::report_moves_after_end() {
  if (options_.open_ended || !frames_.empty()) return;
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
    reporter_.warning_at("gcode.move-after-end", line, text, axis_word->span,
                         "this move comes after the end of the program, and is never made",
                         "M2 or M30 in the last line");
  }
  file_->reader.seek(here);
}

bool ProgramFlow::lacks_closing_percent() {
  if (!opened_percent_) return false;
  ProgramReader& reader = files_.front()->reader;
  if (!frames_.empty()) reader.seek(frames_.front().return_to);
  std::string_view text;
  std::uint32_t line = 0;
  while (reader.next_line(text, line, reporter_.diagnostics())) {
    if (is_percent(text)) return false;
  }
  return true;
}

}  // namespace passo
