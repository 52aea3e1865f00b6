#include "gerber_text.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr std::size_t longest_shown_line = 4096;

bool is_control(char c) {
  return static_cast<unsigned char>(c) < ' ' || c == '\x7F';
}

}  // namespace

GerberText::GerberText(std::string_view text) : text_(text) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = line_begin_ = 3;
}

void GerberText::step() {
  const char c = text_[at_++];
  if (c != '\n' && (c != '\r' || (at_ < text_.size() && text_[at_] == '\n'))) return;
  ++line_;
  line_begin_ = at_;
}

void GerberText::skip_blanks() {
  while (at_ < text_.size() && (is_control(text_[at_]) || text_[at_] == ' ')) step();
}

// A comment may hold a '%'. Elsewhere a '%' also ends a command that has no '*'.
std::size_t GerberText::end_of_command() const {
  const std::string_view begin = text_.substr(at_, 3);
  const bool is_comment = !in_extended_ && (begin == "G04" || begin.substr(0, 2) == "G4");
  return std::min(text_.find_first_of(is_comment ? "*" : "*%", at_), text_.size());
}

bool GerberText::next(GerberCommand& command) {
  for (skip_blanks(); at_ < text_.size() && (text_[at_] == '%' || text_[at_] == '*'); skip_blanks()) {
    if (text_[at_] == '%') in_extended_ = !in_extended_;
    ++at_;
  }
  if (at_ >= text_.size()) return false;
  command = {.words = {},
             .is_extended = in_extended_,
             .is_last = !in_extended_,
             .begin = at_,
             .line = line_,
             .line_begin = line_begin_};
  const std::size_t end = end_of_command();
  command.words = text_.substr(at_, end - at_);
  const bool is_long = std::ranges::any_of(command.words, is_control);
  if (is_long) {
    joined_.clear();
    std::ranges::copy_if(command.words, std::back_inserter(joined_), [](char c) { return !is_control(c); });
    command.words = joined_;
  }
  if (!is_long) at_ = end;
  while (at_ < end) step();
  // A lone * before the % is the end of nothing.
  for (; at_ < text_.size() && text_[at_] == '*'; skip_blanks()) ++at_;
  skip_blanks();
  if (in_extended_) command.is_last = at_ >= text_.size() || text_[at_] == '%';
  return true;
}

GerberText::Spot GerberText::spot(const GerberCommand& command, std::size_t at) const {
  Spot spot{command.line, command.line_begin, command.begin};
  for (std::size_t kept = 0; spot.byte < text_.size(); ++spot.byte) {
    const char c = text_[spot.byte];
    if (!is_control(c)) {
      if (kept == at) break;
      ++kept;
      continue;
    }
    if (c != '\n' && (c != '\r' || text_.substr(spot.byte + 1, 1) == "\n")) continue;
    ++spot.line;
    spot.line_begin = spot.byte + 1;
  }
  return spot;
}

SourceLocation GerberText::place(const GerberCommand& command, std::size_t at, std::size_t length) const {
  const Spot where = spot(command, at);
  return {where.line, static_cast<std::uint32_t>(where.byte - where.line_begin + 1),
          static_cast<std::uint32_t>(std::max<std::size_t>(1, length))};
}

std::string_view GerberText::line_of(const GerberCommand& command, std::size_t at) const {
  const Spot where = spot(command, at);
  const std::size_t end = std::min(text_.find_first_of("\r\n", where.byte), text_.size());
  const std::size_t length = end - where.line_begin;
  return length > longest_shown_line ? std::string_view() : text_.substr(where.line_begin, length);
}

}  // namespace passo
