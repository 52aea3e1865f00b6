// TomlText: tables of a list, as blocks of lines.
#include <algorithm>
#include <optional>
#include <set>

#include "toml_tree.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using Line = toml::source_index;

// Lines of a file, both included.
struct Block {
  Line first = 0;  // with the comments above the head
  Line head = 0;
  Line last = 0;
};

// The lines inside of a value, e.g. of a list over several lines.
void collect_inner_lines(const toml::node& node, const TomlPlaces& places, std::set<Line>& lines) {
  const auto visit = [&](const toml::node& inner) { collect_inner_lines(inner, places, lines); };
  const toml::source_region& region = node.source();
  const toml::array* const list = node.as_array();
  const bool has_heads = node.is_array_of_tables() && places.begins_with_bracket(region.begin.line);
  if (list != nullptr && !has_heads) {
    for (Line line = region.begin.line + 1; line <= region.end.line; ++line) lines.insert(line);
  }
  if (list != nullptr) {
    for (const toml::node& inner : *list) visit(inner);
  }
  if (const toml::table* const table = node.as_table()) {
    for (const auto& [key, inner] : *table) visit(inner);
  }
}

// The first key of a head: "operation" of "[[ operation . list ]]".
std::string_view first_key_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t["), line.size()));
  if (line.empty()) return line;
  if (line.front() == '"' || line.front() == '\'') return line.substr(1, line.find(line.front(), 1) - 1);
  return line.substr(0, line.find_first_of(" \t.]"));
}

// The keys of a head: "tool", "3" of "[tool.3] # a drill", and those of a list's head.
std::vector<std::string> keys_of_head(std::string_view line) {
  std::vector<std::string> keys;
  const auto tree = tree_of(line);
  const toml::table* table = tree ? &*tree : nullptr;
  while (table != nullptr && !table->empty()) {
    const auto only = table->begin();  // what it refers to lives as long as it does
    keys.emplace_back(only->first.str());
    const toml::array* const list = only->second.as_array();
    table = list != nullptr && !list->empty() ? (*list)[0].as_table() : only->second.as_table();
  }
  return keys;
}

class Blocks {
 public:
  Blocks(std::string_view text, const toml::table& root, std::string_view list)
      : places_(text), list_(root.get_as<toml::array>(list)), name_(list) {
    collect_inner_lines(root, places_, inner_);
    for (Line line = 1; line <= places_.line_count(); ++line) {
      if (places_.begins_with_bracket(line) && !inner_.contains(line)) heads_.push_back(line);
    }
  }

  // The error: the list is written in another way.
  Result<std::vector<Block>, TomlTextError> find() const;
  // Those of the heads that begin with these keys.
  std::vector<Block> find(const std::vector<std::string_view>& keys) const;

 private:
  // `next`: the head that ends it; 0: the end of the file does.
  Block block_of(Line head, Line next) const;
  Line comments_above(Line head) const;
  bool is_comment(Line line) const { return places_.first_of(line) == '#' && !inner_.contains(line); }

  TomlPlaces places_;
  const toml::array* list_;
  std::string_view name_;
  std::set<Line> inner_;
  std::vector<Line> heads_;
};

Line Blocks::comments_above(Line head) const {
  Line first = head;
  while (first > 1 && is_comment(first - 1)) --first;
  return first;
}

Result<std::vector<Block>, TomlTextError> Blocks::find() const {
  std::vector<Block> blocks;
  if (list_ == nullptr) return blocks;
  std::set<Line> own;
  for (const toml::node& element : *list_) {
    const Line head = element.source().begin.line;
    if (!std::ranges::binary_search(heads_, head)) {
      return text_refusal(fmt::format("the tables of {0} have no heads [[{0}]]", name_));
    }
    own.insert(head);
  }
  for (const Line head : own) {
    auto next = std::ranges::upper_bound(heads_, head);
    while (next != heads_.end() && !own.contains(*next) && first_key_of(places_.line(*next)) == name_) ++next;
    blocks.push_back(block_of(head, next == heads_.end() ? 0 : *next));
  }
  return blocks;
}

Block Blocks::block_of(Line head, Line next) const {
  const Line end = next == 0 ? places_.line_count() + 1 : comments_above(next);
  Block block{.first = comments_above(head), .head = head, .last = head};
  for (Line line = head + 1; line < end; ++line) {
    const bool has_words = inner_.contains(line) || (places_.first_of(line) != '\0' && !is_comment(line));
    if (has_words) block.last = line;
  }
  while (block.last + 1 < end && is_comment(block.last + 1)) ++block.last;
  return block;
}

std::vector<Block> Blocks::find(const std::vector<std::string_view>& keys) const {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < heads_.size(); ++i) {
    const std::vector<std::string> head = keys_of_head(places_.line(heads_[i]));
    if (head.size() < keys.size() || !std::equal(keys.begin(), keys.end(), head.begin())) continue;
    blocks.push_back(block_of(heads_[i], i + 1 < heads_.size() ? heads_[i + 1] : 0));
  }
  return blocks;
}

// A text in three pieces around a block: before it, the block, and what follows. Blank lines beside it are apart.
struct Cut {
  std::string before;
  std::string block;
  std::string blank;  // the blank lines after it, or before it at the end of the file
  std::string after;
};

Cut cut_out(const std::string& text, Line first, Line last) {
  const TomlPlaces places(text);
  Cut cut;
  Line from = first;
  Line to = last;
  while (to < places.line_count() && places.first_of(to + 1) == '\0') ++to;
  cut.blank = text.substr(places.end(last), places.end(to) - places.end(last));
  const bool is_at_end = to == places.line_count();
  if (is_at_end && cut.blank.empty()) {
    while (from > 1 && places.first_of(from - 1) == '\0') --from;
    cut.blank = text.substr(places.start(from), places.start(first) - places.start(from));
  }
  cut.before = text.substr(0, places.start(from));
  cut.block = text.substr(places.start(first), places.end(last) - places.start(first));
  cut.after = text.substr(places.end(to));
  return cut;
}

std::string with_end(std::string text, std::string_view line_end) {
  if (!text.empty() && text.back() != '\n') text += line_end;
  return text;
}

// Puts a block at the start of a line. `blank`: the lines between it and its neighbour.
std::string put_before(const std::string& text, Line line, const std::string& block, const std::string& blank) {
  std::string result = text;
  return result.insert(TomlPlaces(text).start(line), block + blank);
}
std::string put_after(const std::string& text, Line line, const std::string& block, const std::string& blank) {
  const TomlPlaces places(text);
  const std::string_view line_end = line_end_of(text);
  const std::size_t at = places.end(line);
  return with_end(text.substr(0, at), line_end) + blank + block + text.substr(at);
}

std::vector<std::size_t> all_numbers(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = i + 1;
  return numbers;
}

Result<std::vector<Block>, TomlTextError> blocks_of(const std::string& text, std::string_view list) {
  const auto tree = tree_of(text);
  if (!tree) return Failure{tree.error()};
  return Blocks(text, *tree, list).find();
}

Failure<TomlTextError> no_table(std::string_view list, std::size_t number) {
  return text_refusal(fmt::format("{} has no table number {}", list, number));
}

}  // namespace

Status<TomlTextError> TomlText::take(std::string changed, std::string_view list,
                                     const std::vector<std::size_t>& numbers) {
  auto tree = tree_of(text_);
  const auto again = tree_of(changed);
  if (!tree || !again) return text_refusal(fmt::format("the tables of {} cannot be changed here", list));
  const toml::array* const before = tree->get_as<toml::array>(list);
  const toml::array* const now = again->get_as<toml::array>(list);
  bool is_good = (now == nullptr ? 0 : now->size()) == numbers.size();
  for (std::size_t i = 0; is_good && i < numbers.size(); ++i) {
    is_good = numbers[i] == 0 || *(*now)[i].as_table() == *(*before)[numbers[i] - 1].as_table();
  }
  // All else is as before.
  toml::table rest = *again;
  rest.erase(list);
  tree->erase(list);
  if (!is_good || rest != *tree) return text_refusal(fmt::format("the tables of {} cannot be changed here", list));
  text_ = std::move(changed);
  return Unit{};
}

Status<TomlTextError> TomlText::insert_table(std::string_view list, std::size_t number,
                                             const std::vector<NewKey>& keys) {
  const auto blocks = blocks_of(text_, list);
  if (!blocks) return Failure{blocks.error()};
  if (number < 1 || number > blocks->size() + 1) return no_table(list, number);
  const std::string_view end = line_end_of(text_);
  std::string block = fmt::format("[[{}]]{}", list, end);
  for (const NewKey& key : keys) {
    if (!is_plain_key(key.key)) return text_refusal(fmt::format("'{}' is not a key", key.key));
    if (!tree_of_value(key.words)) return text_refusal(fmt::format("{} cannot be {}", key.key, key.words));
    block += fmt::format("{} = {}{}", key.key, key.words, end);
  }
  std::vector<std::size_t> numbers = all_numbers(blocks->size());
  numbers.insert(numbers.begin() + static_cast<std::ptrdiff_t>(number) - 1, 0);
  const std::string blank(end);
  if (number <= blocks->size())
    return take(put_before(text_, (*blocks)[number - 1].first, block, blank), list, numbers);
  const Line last = blocks->empty() ? TomlPlaces(text_).line_count() : blocks->back().last;
  return take(put_after(text_, last, block, text_.empty() ? "" : blank), list, numbers);
}

Status<TomlTextError> TomlText::copy_table(std::string_view list, std::size_t number) {
  const auto blocks = blocks_of(text_, list);
  if (!blocks) return Failure{blocks.error()};
  if (number < 1 || number > blocks->size()) return no_table(list, number);
  const Block& block = (*blocks)[number - 1];
  const std::string_view end = line_end_of(text_);
  const std::string copy = with_end(cut_out(text_, block.head, block.last).block, end);
  std::vector<std::size_t> numbers = all_numbers(blocks->size());
  numbers.insert(numbers.begin() + static_cast<std::ptrdiff_t>(number), number);
  return take(put_after(text_, block.last, copy, std::string(end)), list, numbers);
}

Status<TomlTextError> TomlText::move_table(std::string_view list, std::size_t number, std::size_t to) {
  const auto blocks = blocks_of(text_, list);
  if (!blocks) return Failure{blocks.error()};
  if (number < 1 || number > blocks->size()) return no_table(list, number);
  if (to < 1 || to > blocks->size()) return no_table(list, to);
  if (number == to) return Unit{};
  const std::string_view end = line_end_of(text_);
  const Block& block = (*blocks)[number - 1];
  const Cut cut = cut_out(text_, block.first, block.last);
  const std::string moved = with_end(cut.block, end);
  const std::string blank = cut.blank.empty() ? std::string(end) : cut.blank;
  const std::string rest = cut.before + cut.after;
  const auto left = blocks_of(rest, list);
  if (!left) return Failure{left.error()};
  std::vector<std::size_t> numbers = all_numbers(blocks->size());
  numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(number) - 1);
  numbers.insert(numbers.begin() + static_cast<std::ptrdiff_t>(to) - 1, number);
  const bool is_last = to > left->size();
  return take(is_last ? put_after(rest, left->back().last, moved, blank)
                      : put_before(rest, (*left)[to - 1].first, moved, blank),
              list, numbers);
}

Status<TomlTextError> TomlText::remove_table(std::string_view list, std::size_t number) {
  const auto blocks = blocks_of(text_, list);
  if (!blocks) return Failure{blocks.error()};
  if (number < 1 || number > blocks->size()) return no_table(list, number);
  const Block& block = (*blocks)[number - 1];
  const Cut cut = cut_out(text_, block.first, block.last);
  std::vector<std::size_t> numbers = all_numbers(blocks->size());
  numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(number) - 1);
  return take(cut.before + cut.after, list, numbers);
}

Status<TomlTextError> TomlText::remove_table(std::string_view path) {
  const auto tree = tree_of(text_);
  if (!tree) return Failure{tree.error()};
  const std::vector<std::string_view> keys = parts_of_path(path);
  toml::table wanted = *tree;
  toml::table* around = &wanted;
  for (std::size_t i = 0; around != nullptr && i + 1 < keys.size(); ++i) around = around->get_as<toml::table>(keys[i]);
  if (around == nullptr || !around->contains(keys.back())) return text_refusal(fmt::format("there is no {}", path));
  if (around->get_as<toml::table>(keys.back()) == nullptr) return text_refusal(fmt::format("{} is no table", path));
  const std::vector<Block> blocks = Blocks(text_, *tree, "").find(keys);
  if (blocks.empty()) return remove(path);
  std::string changed = text_;
  for (auto block = blocks.rbegin(); block != blocks.rend(); ++block) {
    const Cut cut = cut_out(changed, block->first, block->last);
    changed = cut.before + cut.after;
  }
  around->erase(keys.back());
  const auto again = tree_of(changed);
  if (!again || !is_same_but_empty(*again, wanted)) return text_refusal(fmt::format("{} cannot be removed", path));
  text_ = std::move(changed);
  return Unit{};
}

}  // namespace passo
