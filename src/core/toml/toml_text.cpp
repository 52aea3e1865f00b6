#include "passo/toml/toml_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "toml_tree.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace passo {
namespace {

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

// 0: it is no number.
std::size_t number_of(std::string_view digits) {
  constexpr std::size_t most_digits = 6;
  if (digits.empty() || digits.size() > most_digits) return 0;
  std::size_t number = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return 0;
    number = number * 10 + static_cast<std::size_t>(c - '0');
  }
  return number;
}

bool has_comment(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      return true;
    }
  }
  return false;
}

// Sets the value of a path, or erases it: the tree that a changed text must have.
void change_tree(toml::table& root, const std::vector<std::string_view>& parts, const toml::node* value) {
  toml::table* table = &root;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    toml::node* next = table->get(parts[i]);
    if (next == nullptr) {
      table->insert(parts[i], toml::table());
      next = table->get(parts[i]);
    }
    if (toml::array* const list = next->as_array()) {
      const std::size_t index = number_of(parts[++i]);
      next = index > 0 ? list->get(index - 1) : nullptr;
    }
    table = next != nullptr ? next->as_table() : nullptr;
    if (table == nullptr) return;
  }
  if (value != nullptr) {
    table->insert_or_assign(parts.back(), *value);
  } else {
    table->erase(parts.back());
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
      : text_(text), places_(text), root_(root), path_(path), parts_(parts_of_path(path)) {}

  Result<Change, TomlTextError> change(const std::string& words) const;
  // Removes the key with its value. Empty: there is no such key.
  Result<std::optional<Change>, TomlTextError> removal() const;

 private:
  enum class Kind : std::uint8_t {
    headed,   // [axis.X]
    implied,  // only tables below it have heads
    dotted,   // torque.friction_n = 1
    in_line,  // torque = { friction_n = 1 }
  };
  struct Found {
    const toml::table* table = nullptr;
    std::optional<toml::source_region> key;  // of an element of a list: the element itself; empty: the root
    std::string path;
    bool is_element = false;  // of a list: [[operation]]
    bool is_in_list = false;  // an element, or inside of one
  };

  Result<Found, TomlTextError> element_of(const toml::array& list, const Found& around, std::string_view number) const;

  Kind kind_of(const Found& found) const;
  Result<Change, TomlTextError> replace(const toml::node& node, const std::string& words) const;
  Result<Change, TomlTextError> add_to(const Found& found, const std::string& key, const std::string& words) const;
  Change add_table(const std::string& path, const std::string& key, const std::string& words) const;
  Change in_line(const Found& found, const std::string& key, const std::string& words) const;
  Change after_line(toml::source_index line, const std::string& added) const;
  toml::source_index last_line_of(const toml::table& table) const;
  std::string indent_of(toml::source_index line) const;
  std::string_view line_end() const { return line_end_of(text_); }
  Change out_of_line(const toml::key& key, const toml::node& value) const;

  std::string_view text_;
  TomlPlaces places_;
  const toml::table& root_;
  std::string_view path_;
  std::vector<std::string_view> parts_;
};

Setter::Kind Setter::kind_of(const Found& found) const {
  if (!found.key) return Kind::headed;
  if (found.table->is_inline()) return Kind::in_line;
  if (found.is_element) return Kind::headed;
  if (!places_.begins_with_bracket(found.key->begin.line)) return Kind::dotted;
  const std::size_t next = text_.find_first_not_of(" \t", places_.of(found.key->end));
  return next != std::string_view::npos && text_[next] == ']' ? Kind::headed : Kind::implied;
}

Result<Setter::Found, TomlTextError> Setter::element_of(const toml::array& list, const Found& around,
                                                        std::string_view number) const {
  const std::size_t index = number_of(number);
  const toml::table* const table = index > 0 && index <= list.size() ? list[index - 1].as_table() : nullptr;
  if (table == nullptr) return text_refusal(fmt::format("{} has no table number {}", around.path, number));
  return Found{.table = table,
               .key = table->source(),
               .path = fmt::format("{}.{}", around.path, number),
               .is_element = true,
               .is_in_list = true};
}

Result<Change, TomlTextError> Setter::change(const std::string& words) const {
  Found found{.table = &root_, .key = {}, .path = ""};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const bool last = i + 1 == parts_.size();
    const auto next = found.table->find(parts_[i]);
    if (next == found.table->end()) {
      const auto first = static_cast<std::size_t>(parts_[i].data() - path_.data());
      if (last) return add_to(found, std::string(parts_[i]), words);
      const bool within =
          found.is_in_list || (found.key && (kind_of(found) == Kind::in_line || kind_of(found) == Kind::dotted));
      if (within) return add_to(found, std::string(path_.substr(first)), words);
      const std::string_view table = path_.substr(0, path_.size() - parts_.back().size() - 1);
      return add_table(std::string(table), std::string(parts_.back()), words);
    }
    if (last) return replace(next->second, words);
    found.path += found.path.empty() ? parts_[i] : fmt::format(".{}", parts_[i]);
    found.is_element = false;
    if (const toml::array* const list = next->second.as_array()) {
      auto element = element_of(*list, found, parts_[++i]);
      if (!element) return Failure{element.error()};
      if (i + 1 == parts_.size()) return text_refusal(fmt::format("{} is a table", path_));
      found = std::move(*element);
      continue;
    }
    const toml::table* table = next->second.as_table();
    if (table == nullptr) return text_refusal(fmt::format("{} is not a table", found.path));
    found.table = table;
    found.key = next->first.source();
  }
  return text_refusal("an empty path");
}

Result<std::optional<Change>, TomlTextError> Setter::removal() const {
  const toml::table* table = &root_;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto next = table->find(parts_[i]);
    if (next == table->end()) return std::optional<Change>();
    if (i + 1 == parts_.size()) {
      const toml::table* const whole = next->second.as_table();
      if (whole != nullptr && !whole->is_inline()) return text_refusal(fmt::format("{} is a table", path_));
      if (next->second.is_array_of_tables() && places_.begins_with_bracket(next->second.source().begin.line)) {
        return text_refusal(fmt::format("{} is a list of tables", path_));
      }
      return std::optional(out_of_line(next->first, next->second));
    }
    table = next->second.as_table();
    if (const toml::array* const list = next->second.as_array()) {
      const std::size_t index = number_of(parts_[++i]);
      table = index > 0 && index <= list->size() ? (*list)[index - 1].as_table() : nullptr;
    }
    if (table == nullptr) return std::optional<Change>();
  }
  return std::optional<Change>();
}

// Whole lines, or the entry of a table in one line with one of the commas beside it.
Change Setter::out_of_line(const toml::key& key, const toml::node& value) const {
  const toml::source_index first = key.source().begin.line;
  const std::size_t start = places_.start(first);
  const std::size_t at = places_.of(key.source().begin);
  const std::size_t end = places_.of(value.source().end);
  std::size_t before = at;
  while (before > start && text_[before - 1] != ',' && text_[before - 1] != '{') --before;
  if (before == start) return {.at = start, .length = places_.end(value.source().end.line) - start, .words = ""};
  const std::size_t next = std::min(text_.find_first_not_of(" \t", end), text_.size());
  if (next < text_.size() && text_[next] == ',') {
    const std::size_t entry = std::min(text_.find_first_not_of(" \t", before), text_.size());
    const std::size_t other = std::min(text_.find_first_not_of(" \t", next + 1), text_.size());
    return {.at = entry, .length = other - entry, .words = ""};
  }
  if (text_[before - 1] == ',') --before;
  return {.at = before, .length = end - before, .words = ""};
}

Result<Change, TomlTextError> Setter::replace(const toml::node& node, const std::string& words) const {
  if (node.is_table()) return text_refusal(fmt::format("{} is a table", path_));
  Change change{.at = places_.of(node.source().begin), .words = words};
  change.length = places_.of(node.source().end) - change.at;
  if (node.is_array() && has_comment(text_.substr(change.at, change.length))) {
    return text_refusal(fmt::format("{} is a list with comments inside", path_));
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
    case Kind::implied:
      if (found.is_in_list) break;
      return add_table(found.path, key, words);
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
      if (found.key) return after_line(found.key->begin.line, indent_of(found.key->begin.line) + line);
      return Change{.at = places_.start(1), .words = line + std::string(line_end())};
  }
  return text_refusal(fmt::format("{} cannot hold {}", found.path, key));
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
    } else if (auto setting = is_plain_key(key.str()) ? setting_of(node) : std::nullopt) {
      all.push_back({key.source().begin, {path, std::move(*setting)}});
    }
  }
}

}  // namespace

std::vector<std::string_view> parts_of_path(std::string_view path) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    parts.push_back(path.substr(0, dot));
    if (dot == path.size()) return parts;
    path.remove_prefix(dot + 1);
  }
}

bool is_same_but_empty(const toml::table& some, const toml::table& all) {
  for (const auto& [key, node] : all) {
    const toml::table* const inner = node.as_table();
    const toml::node* const other = some.get(key.str());
    if (other == nullptr && (inner == nullptr || !inner->empty())) return false;
    if (other == nullptr) continue;
    const bool is_same = inner != nullptr && other->is_table()
                             ? is_same_but_empty(*other->as_table(), *inner)
                             : some.size() <= all.size() && toml::node_view(*other) == toml::node_view(node);
    if (!is_same) return false;
  }
  return some.size() <= all.size();
}

bool is_plain_key(std::string_view key) {
  return !key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::optional<toml::table> tree_of_value(const std::string& words) {
  if (words.find_first_of("\r\n") != std::string::npos || has_comment(words)) return std::nullopt;
  auto tree = tree_of("x = " + words);
  return tree && tree->size() == 1 ? std::optional(std::move(*tree)) : std::nullopt;
}

Result<TomlText, TomlTextError> TomlText::read(std::string text) {
  if (auto tree = tree_of(text); !tree) return Failure{tree.error()};
  return TomlText(std::move(text));
}

std::vector<TomlText::Value> TomlText::values() const {
  std::vector<Placed> all;
  if (const auto tree = tree_of(text_)) collect(*tree, "", all);
  std::ranges::stable_sort(all, [](const Placed& a, const Placed& b) { return a.at < b.at; });
  std::vector<Value> values;
  for (Placed& one : all) values.push_back(std::move(one.value));
  return values;
}

std::string TomlText::words_of(const Setting& setting) {
  return describe(setting);
}

Status<TomlTextError> TomlText::set(std::string_view path, const Setting& setting) {
  const std::string words = describe(setting);
  if (words.empty()) return text_refusal(fmt::format("{} must be finite", path));
  return set_words(path, words);
}

Status<TomlTextError> TomlText::set_words(std::string_view path, const std::string& words) {
  const std::vector<std::string_view> parts = parts_of_path(path);
  // The parser recurses as deep as a key has parts.
  if (parts.size() > most_parts) return text_refusal(fmt::format("a key has more than {} parts", most_parts));
  if (!std::ranges::all_of(parts, is_plain_key)) return text_refusal(fmt::format("'{}' is not a key", path));
  const auto value = tree_of_value(words);
  if (!value) return text_refusal(fmt::format("{} cannot be {}", path, words));
  auto tree = tree_of(text_);
  if (!tree) return Failure{tree.error()};
  const auto change = Setter(text_, *tree, path).change(words);
  if (!change) return Failure{change.error()};
  std::string changed = text_;
  changed.replace(change->at, change->length, change->words);
  // The parser has the last word: the file is still TOML, the value is there, and nothing else has changed.
  const auto again = tree_of(changed);
  if (!again) return text_refusal(fmt::format("{} cannot be set: {}", path, again.error().message));
  change_tree(*tree, parts, value->get("x"));
  if (*again != *tree) return text_refusal(fmt::format("{} cannot be set at its position in the file", path));
  text_ = std::move(changed);
  return Unit{};
}

Status<TomlTextError> TomlText::remove(std::string_view path) {
  auto tree = tree_of(text_);
  if (!tree) return Failure{tree.error()};
  const auto change = Setter(text_, *tree, path).removal();
  if (!change) return Failure{change.error()};
  if (!*change) return Unit{};
  std::string changed = text_;
  changed.erase((*change)->at, (*change)->length);
  const auto again = tree_of(changed);
  change_tree(*tree, parts_of_path(path), nullptr);
  // A table of which only dotted keys are written is gone with the last of them.
  if (!again || !is_same_but_empty(*again, *tree)) return text_refusal(fmt::format("{} cannot be removed", path));
  text_ = std::move(changed);
  return Unit{};
}

}  // namespace passo
