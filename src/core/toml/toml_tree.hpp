// The parsed tree of a text that TomlText edits, and the places of its nodes in bytes. Private to toml/.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "passo/toml/toml_parse.hpp"
#include "passo/toml/toml_text.hpp"

namespace passo {

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

inline Failure<TomlTextError> text_refusal(std::string message) {
  return Failure{TomlTextError{std::move(message)}};
}

// What the parser tells of a text, or why it is not TOML.
inline Result<toml::table, TomlTextError> tree_of(std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  auto table = parsed_toml(text);
  if (table) return std::move(*table);
  const toml::parse_error& error = table.error();
  return text_refusal(fmt::format("this is not TOML: {}, in line {}", error.description(), error.source().begin.line));
}

// Where the parser's places are in the text, in bytes. The parser counts characters.
class TomlPlaces {
 public:
  explicit TomlPlaces(std::string_view text) : text_(text) {
    starts_.push_back(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') starts_.push_back(i + 1);
    }
  }

  std::size_t of(const toml::source_position& position) const {
    std::size_t at = starts_[std::min<std::size_t>(position.line, starts_.size()) - 1];
    for (toml::source_index left = position.column - 1; left > 0 && at < text_.size(); --left) {
      ++at;
      while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U) ++at;
    }
    return at;
  }
  // Where the line begins, and where it ends with its line end. Lines count from 1.
  std::size_t start(toml::source_index line) const { return starts_[line - 1]; }
  std::size_t end(toml::source_index line) const { return line < starts_.size() ? starts_[line] : text_.size(); }
  // The last line that has a character, or a line end.
  toml::source_index line_count() const {
    const auto count = static_cast<toml::source_index>(starts_.size());
    return count > 1 && starts_.back() == text_.size() ? count - 1 : count;
  }
  std::string_view line(toml::source_index number) const {
    return text_.substr(start(number), end(number) - start(number));
  }
  bool begins_with_bracket(toml::source_index number) const { return first_of(number) == '['; }
  // The first character that is not blank; 0: there is none.
  char first_of(toml::source_index number) const {
    const std::string_view all = line(number);
    const std::size_t first = all.find_first_not_of(" \t\r\n");
    return first == std::string_view::npos ? '\0' : all[first];
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;  // of the lines
};

// Letters, digits, '_' and '-'.
bool is_plain_key(std::string_view key);
// Whether a text is a value of TOML on one line, without a comment. Returns its tree with the key "x".
std::optional<toml::table> tree_of_value(const std::string& words);

// Whether two trees differ at most by tables without content.
bool is_same_but_empty(const toml::table& some, const toml::table& all);
// The keys of a path, "axis.X".
std::vector<std::string_view> parts_of_path(std::string_view path);

// A new line ends as the others do.
inline std::string_view line_end_of(std::string_view text) {
  return text.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
}

}  // namespace passo
