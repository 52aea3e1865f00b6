#include "passo/toml/toml_document.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/toml/toml_parse.hpp"

namespace passo {
namespace {

TomlTable convert(const toml::table& table, const TomlReporter& reporter);

SourceLocation place_of(const toml::source_region& region, const TomlReporter& reporter) {
  const bool one_line = region.begin.line == region.end.line;
  const std::uint32_t end = one_line ? region.end.column : UINT16_MAX;
  return reporter.place(region.begin.line, region.begin.column, end);
}

TomlValue convert(const toml::node& node, const TomlReporter& reporter) {
  TomlValue value;
  value.place = place_of(node.source(), reporter);
  if (const auto* table = node.as_table()) {
    value.content = convert(*table, reporter);
  } else if (const auto* array = node.as_array()) {
    TomlArray items;
    for (const toml::node& item : *array) items.push_back(convert(item, reporter));
    value.content = std::move(items);
  } else if (const auto* text = node.as_string()) {
    value.content = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.content = static_cast<double>(integer->get());
  } else if (const auto* real = node.as_floating_point()) {
    value.content = real->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.content = flag->get();
  }
  return value;
}

TomlTable convert(const toml::table& table, const TomlReporter& reporter) {
  TomlTable result;
  for (const auto& [key, node] : table) {
    result.entries.push_back({std::string(key.str()), place_of(key.source(), reporter), convert(node, reporter)});
  }
  std::ranges::sort(result.entries, [](const TomlEntry& a, const TomlEntry& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  return result;
}

// Guesses what was meant. The parser only knows that it cannot go on.
std::string advice(std::string_view line, std::size_t offset) {
  const auto is_digit = [&](std::size_t i) {
    return i < line.size() && std::isdigit(static_cast<unsigned char>(line[i])) != 0;
  };
  if (offset < line.size() && line[offset] == ',' && offset > 0 && is_digit(offset - 1) && is_digit(offset + 1)) {
    return "a decimal point, e.g. 2.5";
  }
  if (std::ranges::count(line, '"') % 2 == 1) return "a quote at the end of the text, too";
  std::size_t before = offset;
  while (before > 0 && line[before - 1] == ' ') --before;
  const bool after_equals = line.substr(0, offset).find('=') != std::string_view::npos;
  if (after_equals && before > 0 && is_digit(before - 1) && offset < line.size() &&
      std::isalpha(static_cast<unsigned char>(line[offset])) != 0) {
    return "only the number; the unit is part of the key's name";
  }
  return "lines like 'key = 1.5', 'key = \"text\"' or '[table]'; a comment starts with #";
}

void report(const toml::parse_error& error, const TomlReporter& reporter) {
  std::string_view description = error.description();
  const SourceLocation place = place_of(error.source(), reporter);
  if (const std::size_t start = description.find("cannot redefine existing "); start != std::string_view::npos) {
    const std::size_t quote = std::min(description.find('\'', start), description.size());
    const std::string_view line = reporter.line(place.line);
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    SourceLocation whole = place;
    whole.column = static_cast<std::uint32_t>(first + 1);
    whole.length = static_cast<std::uint32_t>(std::max<std::size_t>(1, std::min(line.find('#'), line.size()) - first));
    reporter.error("machine.duplicate", whole, fmt::format("{} is given twice", description.substr(quote)),
                   "each key once in its table, and each table once");
    return;
  }
  if (description.starts_with("Error while parsing ")) {
    description.remove_prefix(std::min(description.find(": "), description.size() - 2) + 2);
  }
  const bool is_utf8 = description.find("utf-8") == std::string_view::npos;
  reporter.error("machine.syntax", place, fmt::format("this is not TOML: {}", description),
                 !is_utf8 ? "a text file in UTF-8" : advice(reporter.line(place.line), place.column - 1));
}

struct Attempt {
  std::optional<toml::table> table;
  std::uint32_t wrong_line = 0;  // 0: the error may have begun on an earlier line than where it shows
};

Attempt attempt(std::string_view text, const TomlReporter& reporter) {
  auto table = parsed_toml(text);
  if (table) return {std::move(*table), 0};
  const toml::parse_error& error = table.error();
  report(error, reporter);
  const std::string_view description = error.description();
  const bool begun_before = description.find("parsing array") != std::string_view::npos ||
                            description.find("parsing inline table") != std::string_view::npos ||
                            description.find("end-of-file") != std::string_view::npos;
  return {std::nullopt, begun_before ? 0 : error.source().begin.line};
}

// Overwrites a line with spaces, so that all other lines keep their places. Returns false where that would not help:
// the line is blank already, or is the head of a table (the keys below it would go to another table).
bool leave_out(std::string& text, std::uint32_t line) {
  std::size_t first = 0;
  for (std::uint32_t i = 1; i < line; ++i) {
    first = text.find('\n', first);
    if (first == std::string::npos) return false;
    ++first;
  }
  const std::size_t end = std::min(text.find('\n', first), text.size());
  const std::size_t visible = text.find_first_not_of(" \t\r", first);
  if (visible >= end || text[visible] == '[') return false;
  std::fill(text.begin() + static_cast<std::ptrdiff_t>(first), text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  return true;
}

}  // namespace

const TomlEntry* find(const TomlTable& table, std::string_view key) {
  const auto found = std::ranges::find(table.entries, key, &TomlEntry::key);
  return found == table.entries.end() ? nullptr : &*found;
}

std::string kind_of(const TomlValue& value) {
  struct Namer {
    std::string operator()(TomlDate) const { return "a date or time"; }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(double number) const { return fmt::format("the number {}", number); }
    std::string operator()(const std::string& text) const {
      return text.size() > 40 ? "a long text" : fmt::format("the text \"{}\"", text);
    }
    std::string operator()(const TomlArray& array) const { return "a list of " + counted(array.size(), "value"); }
    std::string operator()(const TomlTable&) const { return "a table"; }
  };
  return std::visit(Namer{}, value.content);
}

TomlDocument parse_toml(std::string text, const TomlReporter& reporter) {
  constexpr int most_attempts = 20;
  TomlDocument document;
  for (int i = 0; i < most_attempts; ++i) {
    const Attempt result = attempt(text, reporter);
    if (result.table) {
      document.root = convert(*result.table, reporter);
      return document;
    }
    document.complete = false;
    if (result.wrong_line == 0 || !leave_out(text, result.wrong_line)) break;
  }
  return document;
}

}  // namespace passo
