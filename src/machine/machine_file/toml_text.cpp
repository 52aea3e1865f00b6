#include "passo/machine_file/toml_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/toml/toml_parse.hpp"

namespace passo {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

Failure<TomlTextError> refusal(std::string message) {
  return Failure{TomlTextError{std::move(message)}};
}

// What the parser tells of a text, or why it is not TOML.
Result<toml::table, TomlTextError> parsed(std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  auto table = parsed_toml(text);
  if (table) return std::move(*table);
  const toml::parse_error& error = table.error();
  return refusal(fmt::format("this is not TOML: {}, in line {}", error.description(), error.source().begin.line));
}

// Where the parser's places are in the text, in bytes. The parser counts characters.
class Places {
 public:
  explicit Places(std::string_view text) : text_(text) {
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
  // Where the line begins, and where it ends with its line end.
  std::size_t start(toml::source_index line) const { return starts_[line - 1]; }
  std::size_t end(toml::source_index line) const { return line < starts_.size() ? starts_[line] : text_.size(); }
  bool begins_with_bracket(toml::source_index line) const {
    const std::size_t first = text_.find_first_not_of(" \t", start(line));
    return first != std::string_view::npos && text_[first] == '[';
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;  // of the lines
};

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

// As TOML has it. Empty: a number that is not finite.
std::string describe(const TomlText::Setting& setting) {
  struct Writer {
    std::string operator()(double number) const { return std::isfinite(number) ? fmt::format("{}", number) : ""; }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(const std::string& text) const { return quoted(text); }
    std::string operator()(const std::vector<double>& list) const {
      const bool finite = std::ranges::all_of(list, [](double number) { return std::isfinite(number); });
      return finite ? fmt::format("[{}]", fmt::join(list, ", ")) : "";
    }
  };
  return std::visit(Writer{}, setting);
}

bool is_plain(std::string_view part) {
  return !part.empty() && std::ranges::all_of(part, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::vector<std::string_view> parts_of(std::string_view path) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    parts.push_back(path.substr(0, dot));
    if (dot == path.size()) return parts;
    path.remove_prefix(dot + 1);
  }
}

// One change of the text.
struct Change {
  std::size_t at = 0;
  std::size_t length = 0;  // what is taken away
  std::string words;
};

class Setter {
 public:
  Setter(std::string_view text, const toml::table& root, std::string_view path)
      : text_(text), places_(text), root_(root), path_(path), parts_(parts_of(path)) {}

  Result<Change, TomlTextError> change(const std::string& words) const;

 private:
  enum class Kind : std::uint8_t {
    headed,   // [axis.X]
    implied,  // only tables below it have heads
    dotted,   // torque.friction_n = 1
    in_line,  // torque = { friction_n = 1 }
  };
  struct Found {
    const toml::table* table = nullptr;
    std::optional<toml::source_region> key;  // empty: the root
    std::string path;
  };

  Kind kind_of(const Found& found) const;
  Result<Change, TomlTextError> replace(const toml::node& node, const std::string& words) const;
  Result<Change, TomlTextError> add_to(const Found& found, const std::string& key, const std::string& words) const;
  Change add_table(const std::string& path, const std::string& key, const std::string& words) const;
  Change in_line(const Found& found, const std::string& key, const std::string& words) const;
  Change after_line(toml::source_index line, const std::string& added) const;
  toml::source_index last_line_of(const toml::table& table) const;
  std::string indent_of(toml::source_index line) const;
  std::string_view line_end() const { return text_.find("\r\n") != std::string_view::npos ? "\r\n" : "\n"; }

  std::string_view text_;
  Places places_;
  const toml::table& root_;
  std::string_view path_;
  std::vector<std::string_view> parts_;
};

Setter::Kind Setter::kind_of(const Found& found) const {
  if (!found.key) return Kind::headed;
  if (found.table->is_inline()) return Kind::in_line;
  if (!places_.begins_with_bracket(found.key->begin.line)) return Kind::dotted;
  const std::size_t next = text_.find_first_not_of(" \t", places_.of(found.key->end));
  return next != std::string_view::npos && text_[next] == ']' ? Kind::headed : Kind::implied;
}

Result<Change, TomlTextError> Setter::change(const std::string& words) const {
  Found found{.table = &root_, .key = {}, .path = ""};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const bool last = i + 1 == parts_.size();
    const auto next = found.table->find(parts_[i]);
    if (next == found.table->end()) {
      const auto first = static_cast<std::size_t>(parts_[i].data() - path_.data());
      if (last) return add_to(found, std::string(parts_[i]), words);
      const bool within = found.key && (kind_of(found) == Kind::in_line || kind_of(found) == Kind::dotted);
      if (within) return add_to(found, std::string(path_.substr(first)), words);
      const std::string_view table = path_.substr(0, path_.size() - parts_.back().size() - 1);
      return add_table(std::string(table), std::string(parts_.back()), words);
    }
    if (last) return replace(next->second, words);
    const toml::table* table = next->second.as_table();
    found.path += found.path.empty() ? parts_[i] : fmt::format(".{}", parts_[i]);
    if (table == nullptr) return refusal(fmt::format("{} is not a table", found.path));
    found.table = table;
    found.key = next->first.source();
  }
  return refusal("an empty path");
}

Result<Change, TomlTextError> Setter::replace(const toml::node& node, const std::string& words) const {
  if (node.is_table()) return refusal(fmt::format("{} is a table", path_));
  Change change{.at = places_.of(node.source().begin), .words = words};
  change.length = places_.of(node.source().end) - change.at;
  if (text_.substr(change.at, change.length).find('#') != std::string_view::npos && node.is_array()) {
    return refusal(fmt::format("{} is a list with comments inside", path_));
  }
  // A comment keeps its column.
  const std::size_t end = change.at + change.length;
  const std::size_t comment = text_.find_first_not_of(' ', end);
  if (comment == std::string_view::npos || text_[comment] != '#' || comment == end) return change;
  const std::size_t columns = comment - change.at;
  change.length = columns;
  change.words.resize(std::max(columns, words.size() + 1), ' ');
  return change;
}

std::string Setter::indent_of(toml::source_index line) const {
  const std::size_t start = places_.start(line);
  const std::size_t first = std::min(text_.find_first_not_of(" \t", start), text_.size());
  return std::string(text_.substr(start, first - start));
}

// The last line of what stands in a table, without the tables that have heads of their own. 0: there is nothing.
toml::source_index Setter::last_line_of(const toml::table& table) const {
  toml::source_index last = 0;
  for (const auto& [key, node] : table) {
    const toml::table* inner = node.as_table();
    const bool is_list_of_tables = node.is_array_of_tables() && places_.begins_with_bracket(node.source().begin.line);
    if (is_list_of_tables) continue;
    if (inner == nullptr || inner->is_inline()) {
      last = std::max(last, node.source().end.line);
    } else if (!places_.begins_with_bracket(key.source().begin.line)) {
      last = std::max(last, last_line_of(*inner));
    }
  }
  return last;
}

Change Setter::after_line(toml::source_index line, const std::string& added) const {
  Change change{.at = places_.end(line), .words = added};
  if (change.at == text_.size() && !text_.empty() && text_.back() != '\n') {
    change.words = std::string(line_end()) + change.words;
  }
  change.words += line_end();
  return change;
}

Result<Change, TomlTextError> Setter::add_to(const Found& found, const std::string& key,
                                             const std::string& words) const {
  const toml::source_index last = last_line_of(*found.table);
  const std::string line = fmt::format("{} = {}", key, words);
  switch (kind_of(found)) {
    case Kind::in_line: return in_line(found, key, words);
    case Kind::implied: return add_table(found.path, key, words);
    case Kind::dotted: {
      // What stands before the key of another value of this table: "torque." or "  axis.X.".
      const auto value = std::ranges::find_if(*found.table, [](const auto& entry) { return !entry.second.is_table(); });
      if (value == found.table->end()) break;
      const std::size_t start = places_.start(value->first.source().begin.line);
      const std::string_view before = text_.substr(start, places_.of(value->first.source().begin) - start);
      return after_line(last, std::string(before) + line);
    }
    case Kind::headed:
      if (last > 0) return after_line(last, indent_of(last) + line);
      if (found.key) return after_line(found.key->end.line, indent_of(found.key->end.line) + line);
      return Change{.at = places_.start(1), .words = line + std::string(line_end())};
  }
  return refusal(fmt::format("{} cannot hold {}", found.path, key));
}

Change Setter::in_line(const Found& found, const std::string& key, const std::string& words) const {
  const std::size_t brace = places_.of(found.table->source().end) - 1;
  const std::size_t last = text_.find_last_not_of(" \t", brace - 1);
  const std::string entry = fmt::format("{} = {}", key, words);
  return {.at = last + 1, .words = found.table->empty() ? fmt::format(" {} ", entry) : fmt::format(", {}", entry)};
}

Change Setter::add_table(const std::string& path, const std::string& key, const std::string& words) const {
  const std::string_view end = line_end();
  std::string added = text_.empty() || text_.back() == '\n' ? "" : std::string(end);
  if (!text_.empty()) added += end;
  return {.at = text_.size(), .words = added + fmt::format("[{}]{}{} = {}{}", path, end, key, words, end)};
}

std::optional<TomlText::Setting> setting_of(const toml::node& node) {
  if (const auto flag = node.as_boolean()) return TomlText::Setting(flag->get());
  if (const auto text = node.as_string()) return TomlText::Setting(text->get());
  if (node.is_number()) return TomlText::Setting(node.value<double>().value_or(0));
  const toml::array* const array = node.as_array();
  if (array == nullptr) return {};
  std::vector<double> list;
  for (const toml::node& one : *array) {
    if (!one.is_number()) return {};
    list.push_back(one.value<double>().value_or(0));
  }
  return TomlText::Setting(std::move(list));
}

struct Placed {
  toml::source_position at;
  TomlText::Value value;
};

void collect(const toml::table& table, const std::string& before, std::vector<Placed>& all) {
  for (const auto& [key, node] : table) {
    const std::string path = before + std::string(key.str());
    if (const toml::table* const inner = node.as_table()) {
      collect(*inner, path + ".", all);
    } else if (auto setting = is_plain(key.str()) ? setting_of(node) : std::nullopt) {
      all.push_back({key.source().begin, {path, std::move(*setting)}});
    }
  }
}

}  // namespace

Result<TomlText, TomlTextError> TomlText::read(std::string text) {
  if (auto tree = parsed(text); !tree) return Failure{tree.error()};
  return TomlText(std::move(text));
}

std::vector<TomlText::Value> TomlText::values() const {
  std::vector<Placed> all;
  if (const auto tree = parsed(text_)) collect(*tree, "", all);
  std::ranges::stable_sort(all, [](const Placed& a, const Placed& b) { return a.at < b.at; });
  std::vector<Value> values;
  for (Placed& one : all) values.push_back(std::move(one.value));
  return values;
}

Status<TomlTextError> TomlText::set(std::string_view path, const Setting& setting) {
  const std::string words = describe(setting);
  if (words.empty()) return refusal(fmt::format("{} must be finite", path));
  if (!std::ranges::all_of(parts_of(path), is_plain)) return refusal(fmt::format("'{}' is not a key", path));
  const auto tree = parsed(text_);
  if (!tree) return Failure{tree.error()};
  const auto change = Setter(text_, *tree, path).change(words);
  if (!change) return Failure{change.error()};
  std::string changed = text_;
  changed.replace(change->at, change->length, change->words);
  // The parser has the last word: the file is still TOML, and the value is there.
  const auto again = parsed(changed);
  if (!again) return refusal(fmt::format("{} cannot be set: {}", path, again.error().message));
  const auto there = again->at_path(path);
  if (!there || there.is_table()) return refusal(fmt::format("{} cannot be set at its position in the file", path));
  text_ = std::move(changed);
  return Unit{};
}

}  // namespace passo
