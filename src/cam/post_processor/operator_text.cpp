#include "passo/post_processor/operator_text.hpp"

#include <algorithm>
#include <array>

#include "program_words.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace passo {
namespace {

constexpr std::array<std::string_view, 10> names{"tool", "tool_name", "diameter", "rpm",     "x",
                                                 "y",    "z",         "units",    "program", "seconds"};
constexpr std::size_t most_lines = 1000;
constexpr std::size_t longest_text_line = 1000;

// Replaces each placeholder by what `value_of` returns for its name and column.
template <class ValueOf>
std::string filled(std::string_view line, ValueOf value_of) {
  std::string text;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t open = line.find('{', at);
    const std::size_t close = open == std::string_view::npos ? open : line.find('}', open);
    if (close == std::string_view::npos) break;
    text += line.substr(at, open - at);
    text += value_of(line.substr(open + 1, close - open - 1), open + 1);
    at = close + 1;
  }
  return text += line.substr(std::min(at, line.size()));
}

class OperatorTextCheck {
 public:
  OperatorTextCheck(const std::string& file, OperatorText::Place place, const ControllerWords& controller,
                    Diagnostics& findings)
      : file_(file), place_(place), controller_(controller), findings_(findings) {}

  void check(std::string_view line, std::uint32_t number, bool is_last);
  bool ends_program() const { return ends_program_; }

 private:
  void check_braces();
  void check_words(const ProgramWords& words);
  void check_characters();
  void add(const char* code, std::size_t column, std::size_t length, std::string message, std::string expected) {
    findings_.add({.code = code,
                   .file = file_,
                   .place = {number_, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(length)},
                   .message = std::move(message),
                   .expected = std::move(expected),
                   .text = std::string(line_)});
  }

  const std::string& file_;
  OperatorText::Place place_;
  const ControllerWords& controller_;
  Diagnostics& findings_;
  std::string_view line_;
  std::uint32_t number_ = 0;
  bool is_last_ = false;
  bool ends_program_ = false;
};

void OperatorTextCheck::check(std::string_view line, std::uint32_t number, bool is_last) {
  line_ = line;
  number_ = number;
  is_last_ = is_last;
  const std::size_t before = findings_.errors();
  check_braces();
  check_characters();
  // Each placeholder becomes a number of its own length, so that the columns of the words do not change.
  const std::string sample =
      filled(line, [](std::string_view name, std::size_t) { return std::string(name.size() + 1, '0') + "1"; });
  const bool is_special = sample.starts_with('$') || sample.starts_with('#') || sample.starts_with('%') ||
                          sample.starts_with('/') || sample.starts_with('o') || sample.starts_with('O');
  if (is_special || findings_.errors() > before) return;
  ProgramWords words;
  read_words(sample, words);
  check_words(words);
}

void OperatorTextCheck::check_braces() {
  bool is_open = false;
  std::size_t open = 0;
  for (std::size_t i = 0; i < line_.size(); ++i) {
    const char c = line_[i];
    if (c == '{' && !is_open) {
      is_open = true;
      open = i;
    } else if (c == '}' && is_open) {
      is_open = false;
      const std::string_view name = line_.substr(open + 1, i - open - 1);
      if (std::ranges::find(names, name) != names.end()) continue;
      const std::string_view meant = suggestion(name, {names.begin(), names.end()});
      add("post.unknown-placeholder", open + 1, i - open + 1,
          fmt::format("there is no placeholder {{{}}}{}", name,
                      meant.empty() ? std::string() : fmt::format("; did you mean {{{}}}?", meant)),
          fmt::format("{{{}}}", fmt::join(names, "}, {")));
    } else if (c == '{' || c == '}') {
      add("post.open-placeholder", i + 1, 1, fmt::format("'{}' without its counterpart", c),
          "a placeholder such as {tool}");
      return;
    }
  }
  if (is_open) {
    add("post.open-placeholder", open + 1, 1, "'{' without its counterpart", "a placeholder such as {tool}");
  }
}

void OperatorTextCheck::check_characters() {
  for (std::size_t i = 0; i < line_.size(); ++i) {
    const auto byte = static_cast<unsigned char>(line_[i]);
    const bool acts = controller_.comments.realtime.find(line_[i]) != std::string_view::npos;
    const bool is_foreign = controller_.comments.is_ascii && byte >= 0x80;
    if (!acts && !is_foreign && (byte >= ' ' || byte == '\t' || byte == '\r')) continue;
    add("post.bad-character", i + 1, 1,
        acts ? fmt::format("{} acts on '{}' at once, also in a comment", controller_.title, line_[i])
             : "this character is not allowed",
        "ASCII letters, digits and signs");
    return;
  }
}

void OperatorTextCheck::check_words(const ProgramWords& words) {
  // Passo has expressions and parameters too; passo check examines them.
  if (words.bad_column > 0 && controller_.knows_all()) return;
  if (words.bad_column > 0) {
    add("post.bad-word", words.bad_column, 1, "this is not a G-code word", "a letter with a number, or a comment");
    return;
  }
  for (const ProgramWord& word : words.words) {
    const std::string number = code_number(word.value);
    const bool is_code = !word.digits.empty() && (word.letter == 'G' || word.letter == 'M');
    // LinuxCNC runs a program of the operator for M100 to M199.
    const bool is_user_code =
        controller_.name == "linuxcnc" && word.letter == 'M' && word.value >= 100 && word.value < 200;
    const bool is_known =
        controller_.knows_all() || is_user_code ||
        (controller_.knows_letter(word.letter) &&
         (!is_code || (word.letter == 'G' ? controller_.knows_g(number) : controller_.knows_m(number))));
    if (!is_known) {
      add("post.unknown-word", word.column, 1 + word.digits.size(),
          fmt::format("{} does not know {}{}", controller_.title, word.letter, is_code ? number : ""),
          fmt::format("words of {}", controller_.documentation));
    }
    const bool ends = is_code && word.letter == 'M' && (word.value == 2 || word.value == 30);
    if (!ends) continue;
    ends_program_ = true;
    if (place_ == OperatorText::Place::end && is_last_) continue;
    add("post.early-end", word.column, 1 + word.digits.size(), fmt::format("M{} ends the program here", number),
        "M2 or M30 only in the last line of --end-text");
  }
}

}  // namespace

std::vector<std::string_view> placeholder_names() {
  return {names.begin(), names.end()};
}

OperatorText OperatorText::read(std::string_view text, const std::string& file, Place place,
                                const ControllerWords& controller, Diagnostics& findings) {
  OperatorText read;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (line.ends_with('\r') || line.ends_with(' ')) line.remove_suffix(1);
    read.lines_.emplace_back(line);
  }
  while (!read.lines_.empty() && read.lines_.back().empty()) read.lines_.pop_back();
  if (read.lines_.size() > most_lines) {
    findings.add({.code = "post.too-long",
                  .file = file,
                  .place = {static_cast<std::uint32_t>(most_lines + 1), 1},
                  .message = fmt::format("the file has {} lines", read.lines_.size()),
                  .expected = fmt::format("at most {}", most_lines),
                  .text = {}});
    return read;
  }
  OperatorTextCheck check(file, place, controller, findings);
  for (std::size_t i = 0; i < read.lines_.size() && !findings.full(); ++i) {
    const std::string& line = read.lines_[i];
    if (line.size() > longest_text_line) {
      findings.add({.code = "post.too-long",
                    .file = file,
                    .place = {static_cast<std::uint32_t>(i + 1), 1},
                    .message = fmt::format("this line has {} characters", line.size()),
                    .expected = fmt::format("at most {}", longest_text_line),
                    .text = {}});
      continue;
    }
    check.check(line, static_cast<std::uint32_t>(i + 1), i + 1 == read.lines_.size());
  }
  read.ends_program_ = check.ends_program();
  return read;
}

std::vector<std::string> OperatorText::lines_with(const Values& values) const {
  std::vector<std::string> lines;
  for (const std::string& line : lines_) {
    lines.push_back(filled(line, [&](std::string_view name, std::size_t) {
      const auto found = std::ranges::find(values, name, &std::pair<std::string_view, std::string>::first);
      return found == values.end() ? std::string() : found->second;
    }));
  }
  return lines;
}

}  // namespace passo
