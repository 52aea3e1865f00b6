#include "hpgl_words.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace passo {
namespace {

constexpr char hpgl_escape = '\x1B';
constexpr std::size_t most_hpgl_numbers = 8'000'000;

bool is_letter_of_hpgl(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 0x80;
}
bool is_between_hpgl(char c) {
  return c == ';' || c == ',' || static_cast<unsigned char>(c) <= ' ' || c == '\x7F';
}

}  // namespace

// "ESC . I 81 ; ; 17 :" sets up the line, "ESC % 0 B" and "ESC E" are words for printers, "ESC %-12345X@PJL ..." lines
// of words.
void HpglWords::skip_escape() {
  ++at_;
  if (at_end()) return;
  const char kind = text_[at_++];
  if (kind == '.') {
    if (at_end()) return;
    const char order = text_[at_++];
    constexpr std::string_view with_numbers = "@HIMNPST";
    if (with_numbers.find(order) == std::string_view::npos) return;
    const auto is_number = [](char c) { return (c >= '0' && c <= '9') || c == ';' || c == '-' || c == ' '; };
    while (!at_end() && is_number(text_[at_])) ++at_;
    if (!at_end() && text_[at_] == ':') ++at_;
    return;
  }
  if (is_letter_of_hpgl(kind) || (kind >= '0' && kind <= '9')) return;
  // Ends with a capital letter.
  while (!at_end() && !(text_[at_] >= '@' && text_[at_] <= 'Z')) ++at_;
  if (!at_end()) ++at_;
  while (text_.substr(std::min(at_, text_.size()), 4) == "@PJL") {
    static_cast<void>(until('\n'));
  }
}

void HpglWords::skip_between() {
  while (!at_end()) {
    if (text_[at_] == hpgl_escape) {
      skip_escape();
    } else if (is_between_hpgl(text_[at_])) {
      ++at_;
    } else {
      return;
    }
  }
}

std::optional<HpglCommand> HpglWords::command() {
  skip_between();
  HpglCommand command{.place = at_};
  for (char& letter : command.letters) {
    // Blanks between the two letters are none of the plotter's business.
    while (!at_end() && text_[at_] == ' ') ++at_;
    if (at_end() || !is_letter_of_hpgl(text_[at_])) return std::nullopt;
    letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text_[at_++])));
  }
  return command;
}

std::optional<std::vector<double>> HpglWords::numbers() {
  std::vector<double> all;
  while (!at_end() && all.size() < most_hpgl_numbers) {
    const char c = text_[at_];
    if (c == ';') {
      ++at_;
      break;
    }
    if (is_letter_of_hpgl(c) || c == hpgl_escape) break;
    if (is_between_hpgl(c)) {
      ++at_;
      continue;
    }
    const std::size_t from = at_ + (c == '+' ? 1U : 0U);
    const char* const begin = text_.data() + from;
    double value = 0;
    const auto [end, fault] = std::from_chars(begin, text_.data() + text_.size(), value, std::chars_format::fixed);
    constexpr double most = 1e9;
    if (fault != std::errc() || !(std::abs(value) <= most)) return std::nullopt;
    all.push_back(value);
    at_ = from + static_cast<std::size_t>(end - begin);
  }
  return all;
}

std::string_view HpglWords::until(char end) {
  const std::size_t found = std::min(text_.find(end, std::min(at_, text_.size())), text_.size());
  const std::string_view taken = text_.substr(std::min(at_, text_.size()), found - std::min(at_, text_.size()));
  at_ = std::min(found + 1, text_.size());
  return taken;
}

std::optional<char> HpglWords::character() {
  if (at_end() || text_[at_] == ';') return std::nullopt;
  return text_[at_++];
}

void HpglWords::skip_comment() {
  while (!at_end() && text_[at_] == ' ') ++at_;
  const bool is_quoted = !at_end() && text_[at_] == '"';
  if (is_quoted) ++at_;
  static_cast<void>(until(is_quoted ? '"' : ';'));
}

void HpglWords::skip_to_end_of_command() {
  while (!at_end() && text_[at_] != ';' && !is_letter_of_hpgl(text_[at_]) && text_[at_] != hpgl_escape) ++at_;
}

}  // namespace passo
