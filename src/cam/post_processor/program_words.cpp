#include "program_words.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace passo {
namespace {

bool is_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

// The end of an expression "[...]", or of a parameter "#5" or "#<name>".
std::size_t end_of_expression(std::string_view line, std::size_t at) {
  int depth = 0;
  for (; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '[' || c == '<') ++depth;
    if ((c == ']' || c == '>') && --depth <= 0) return at + 1;
    if (depth == 0 && c != '#' && !is_of_number(c)) return at;
  }
  return at;
}

}  // namespace

const ProgramWord* ProgramWords::find(char letter) const {
  const auto found = std::ranges::find(words, letter, &ProgramWord::letter);
  return found == words.end() ? nullptr : &*found;
}

bool ProgramWords::has(char letter, double value) const {
  return std::ranges::any_of(words, [&](const ProgramWord& word) {
    return word.letter == letter && !word.digits.empty() && word.value == value;
  });
}

void read_words(std::string_view line, ProgramWords& read) {
  read.words.clear();
  read.comment = {};
  read.bad_column = 0;
  std::size_t at = 0;
  while (at < line.size()) {
    const char c = line[at];
    if (c == ' ' || c == '\t' || c == '\r') {
      ++at;
      continue;
    }
    if (c == ';') {
      read.comment = line.substr(at + 1);
      return;
    }
    if (c == '(') {
      const std::size_t end = std::min(line.find(')', at), line.size());
      read.comment = line.substr(at + 1, end - at - 1);
      at = end + 1;
      continue;
    }
    const bool is_small = c >= 'a' && c <= 'z';
    if (!is_small && !(c >= 'A' && c <= 'Z')) {
      read.bad_column = at + 1;
      return;
    }
    ProgramWord word{.letter = is_small ? static_cast<char>(c - 'a' + 'A') : c, .digits = {}, .column = at + 1};
    ++at;
    while (at < line.size() && line[at] == ' ') ++at;
    if (at < line.size() && (line[at] == '[' || line[at] == '#')) {
      at = end_of_expression(line, at);
      read.words.push_back(word);
      continue;
    }
    const std::size_t begin = at;
    while (at < line.size() && is_of_number(line[at])) ++at;
    word.digits = line.substr(begin, at - begin);
    std::string_view digits = word.digits;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), word.value);
    if (error != std::errc() || end != digits.data() + digits.size()) {
      read.bad_column = word.column;
      return;
    }
    read.words.push_back(word);
  }
}

std::string code_number(double value) {
  return fmt::format("{:g}", value);
}

}  // namespace passo
