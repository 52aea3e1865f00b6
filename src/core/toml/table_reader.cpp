#include "passo/toml/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/toml/toml_sentences.hpp"

namespace passo {
namespace {

bool contains(const std::vector<std::string_view>& keys, std::string_view key) {
  return std::ranges::find(keys, key) != keys.end();
}

Sentence range_in_words(const SentenceRow& row, const NumberKey& key) {
  return row.with({{"low", fmt::format("{}", key.least)}, {"high", fmt::format("{}", key.most)}});
}

}  // namespace

TableReader::TableReader(const TomlTable& table, std::string path, const SourceLocation& place,
                         const TomlReporter& reporter)
    : table_(table), path_(std::move(path)), place_(place), reporter_(reporter) {}

std::string TableReader::full_name(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

SourceLocation TableReader::place_of(std::string_view key) const {
  const TomlEntry* entry = find(table_, key);
  return entry != nullptr ? entry->value.place : place_;
}

void TableReader::error(std::string_view code, std::string_view key, const FindingWords& message,
                        const FindingWords& expected) const {
  reporter_.error(code, place_of(key), message, expected);
}

void TableReader::missing(std::string_view key, std::string example) {
  missing_.push_back({key, std::move(example)});
}

const TomlEntry* TableReader::ask(std::string_view key, std::string example, Need need) {
  known_.push_back(key);
  const TomlEntry* entry = find(table_, key);
  if (entry == nullptr && need == Need::required) missing(key, std::move(example));
  return entry;
}

void TableReader::wrong_type(const TomlEntry& entry, std::string expected) const {
  reporter_.error("machine.wrong-type", entry.value.place,
                  toml_says::key_is.with({{"key", full_name(entry.key)}, {"value", kind_of(entry.value)}}),
                  std::move(expected));
}

bool TableReader::in_range(const NumberKey& key, double value, const SourceLocation& place) const {
  if (value >= key.least && value <= key.most) return true;  // a NaN gives false
  reporter_.error("machine.out-of-range", place,
                  toml_says::key_is.with({{"key", full_name(key.name)}, {"value", fmt::format("{}", value)}}),
                  range_in_words(toml_says::number_within, key));
  return false;
}

std::optional<double> TableReader::number(const NumberKey& key, Need need) {
  const TomlEntry* entry = ask(key.name, fmt::format("{} = {}", key.name, key.example), need);
  if (entry == nullptr) return std::nullopt;
  const auto* value = std::get_if<double>(&entry->value.content);
  if (value == nullptr) {
    wrong_type(*entry, fmt::format("a number, e.g. {} = {}", key.name, key.example));
    return std::nullopt;
  }
  if (!in_range(key, *value, entry->value.place)) return std::nullopt;
  return *value;
}

std::optional<double> TableReader::peek(const NumberKey& key) const {
  const TomlEntry* entry = find(table_, key.name);
  const auto* value = entry != nullptr ? std::get_if<double>(&entry->value.content) : nullptr;
  return value != nullptr && *value >= key.least && *value <= key.most ? std::optional(*value) : std::nullopt;
}

std::optional<double> TableReader::whole_number(const NumberKey& key, Need need) {
  const auto value = number(key, need);
  if (!value || *value == std::floor(*value)) return value;
  error("machine.out-of-range", key.name,
        toml_says::key_is.with({{"key", full_name(key.name)}, {"value", fmt::format("{}", *value)}}),
        range_in_words(toml_says::whole_number_within, key));
  return std::nullopt;
}

std::optional<LowHigh> TableReader::low_high(const NumberKey& key, Need need) {
  const TomlEntry* entry = ask(key.name, fmt::format("{} = {}", key.name, key.example), need);
  if (entry == nullptr) return std::nullopt;
  return pair_of(key, entry->value, fmt::format("two numbers, e.g. {} = {}", key.name, key.example));
}

std::optional<std::vector<LowHigh>> TableReader::pairs(const NumberKey& key) {
  const TomlEntry* entry = ask(key.name, fmt::format("{} = {}", key.name, key.example), Need::required);
  if (entry == nullptr) return std::nullopt;
  const std::string expected = fmt::format("pairs of numbers, e.g. {} = {}", key.name, key.example);
  const auto* list = std::get_if<TomlArray>(&entry->value.content);
  if (list == nullptr) {
    wrong_type(*entry, expected);
    return std::nullopt;
  }
  std::vector<LowHigh> all;
  for (const TomlValue& value : *list) {
    const std::optional<LowHigh> pair = pair_of(key, value, expected);
    if (!pair) return std::nullopt;
    all.push_back(*pair);
  }
  return all;
}

std::optional<LowHigh> TableReader::pair_of(const NumberKey& key, const TomlValue& value,
                                            const std::string& expected) const {
  const auto* list = std::get_if<TomlArray>(&value.content);
  if (list == nullptr || list->size() != 2) {
    reporter_.error("machine.wrong-type", value.place,
                    toml_says::key_is.with({{"key", full_name(key.name)}, {"value", kind_of(value)}}), expected);
    return std::nullopt;
  }
  LowHigh ends;
  bool good = true;
  for (const auto& [item, end] : {std::pair(&(*list)[0], &ends.low), std::pair(&(*list)[1], &ends.high)}) {
    if (const auto* number = std::get_if<double>(&item->content)) {
      good = in_range(key, *number, item->place) && good;
      *end = *number;
    } else {
      reporter_.error("machine.wrong-type", item->place,
                      fmt::format("{} has {} in its list", full_name(key.name), kind_of(*item)), expected);
      good = false;
    }
  }
  return good ? std::optional(ends) : std::nullopt;
}

std::optional<bool> TableReader::flag(std::string_view key) {
  const TomlEntry* entry = ask(key, {}, Need::optional);
  if (entry == nullptr) return std::nullopt;
  if (const auto* value = std::get_if<bool>(&entry->value.content)) return *value;
  wrong_type(*entry, fmt::format("{} = true or {} = false", key, key));
  return std::nullopt;
}

bool TableReader::has_text(std::string_view key) const {
  const TomlEntry* const entry = find(table_, key);
  return entry != nullptr && std::holds_alternative<std::string>(entry->value.content);
}

std::optional<std::string> TableReader::text(std::string_view key, std::string_view example, Need need) {
  const std::string line = fmt::format("{} = \"{}\"", key, example);
  const TomlEntry* entry = ask(key, line, need);
  if (entry == nullptr) return std::nullopt;
  if (const auto* value = std::get_if<std::string>(&entry->value.content)) return *value;
  wrong_type(*entry, fmt::format("a string in quotes, e.g. {}", line));
  return std::nullopt;
}

std::optional<bool> TableReader::is_second_of(std::string_view code, std::string_view key, std::string_view first,
                                              std::string_view second, Need need) {
  const bool given = has(key);
  const auto word = text(key, first, need);
  if (!word) return given || need == Need::required ? std::nullopt : std::optional(false);
  if (*word == first || *word == second) return *word == second;
  error(code, key, toml_says::key_is.with({{"key", full_name(key)}, {"value", fmt::format("\"{}\"", *word)}}),
        fmt::format("\"{}\" or \"{}\"", first, second));
  return std::nullopt;
}

std::vector<bool> TableReader::are_second_of(std::string_view code, std::string_view key, std::string_view first,
                                             std::string_view second, std::size_t most) {
  const TomlEntry* entry = ask(key, {}, Need::optional);
  if (entry == nullptr) return {};
  const std::string expected = fmt::format("a list of at most {}, each \"{}\" or \"{}\"", most, first, second);
  const auto* list = std::get_if<TomlArray>(&entry->value.content);
  if (list == nullptr) {
    wrong_type(*entry, expected);
    return {};
  }
  std::vector<bool> all;
  for (const TomlValue& value : *list) {
    const auto* word = std::get_if<std::string>(&value.content);
    if (word == nullptr || (*word != first && *word != second) || all.size() == most) {
      reporter_.error(code, value.place, fmt::format("{} has {} in its list", full_name(key), kind_of(value)),
                      expected);
      return {};
    }
    all.push_back(*word == second);
  }
  return all;
}

const TomlEntry* TableReader::table(std::string_view key, std::string_view what, Need need) {
  const TomlEntry* entry = ask(key, std::string(what), need);
  if (entry == nullptr) return nullptr;
  if (std::holds_alternative<TomlTable>(entry->value.content)) return entry;
  wrong_type(*entry, std::string(what));
  return nullptr;
}

void TableReader::finish(bool report_missing, const std::vector<std::string_view>& top_keys) {
  for (const TomlEntry& entry : table_.entries) {
    if (!contains(known_, entry.key)) report_unknown(entry, top_keys);
  }
  if (report_missing && !missing_.empty()) report_missing_keys();
}

void TableReader::report_unknown(const TomlEntry& entry, const std::vector<std::string_view>& top_keys) {
  const bool is_table = std::holds_alternative<TomlTable>(entry.value.content);
  const std::string_view near = suggestion(entry.key, known_);
  forgive_missing(near);
  std::string expected;
  if (!path_.empty() && contains(top_keys, entry.key)) {
    expected = fmt::format("{} at the top of the file, before the first [table]", entry.key);
  } else if (!near.empty()) {
    expected = fmt::format("perhaps {}", near);
  } else {
    expected = fmt::format("one of {}", fmt::join(known_, ", "));
  }
  reporter_.error(is_table ? "machine.unknown-table" : "machine.unknown-key", entry.place,
                  (is_table ? toml_says::unknown_table : toml_says::unknown_key)
                      .with({{"where", reporter_.kind_in_words()}, {"key", full_name(entry.key)}}),
                  expected);
}

// One mistake makes one diagnostic: a misspelt key is not reported as missing too.
void TableReader::forgive_missing(std::string_view key) {
  const auto found = std::ranges::find(missing_, key, &MissingKey::name);
  if (found != missing_.end()) missing_.erase(found);
}

void TableReader::report_missing_keys() const {
  std::vector<std::string_view> names;
  std::vector<std::string_view> examples;
  for (const MissingKey& key : missing_) {
    names.push_back(key.name);
    examples.push_back(key.example);
  }
  const std::string where = path_.empty() ? "the file" : fmt::format("[{}]", path_);
  reporter_.error("machine.missing-key", place_,
                  toml_says::lacks.with({{"where", where}, {"what", fmt::format("{}", fmt::join(names, ", "))}}),
                  fmt::format("{}", fmt::join(examples, "; ")));
}

}  // namespace passo
