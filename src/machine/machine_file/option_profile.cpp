#include "passo/machine_file/option_profile.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/toml/fit_for_parser.hpp"
#include "passo/toml/toml_document.hpp"

namespace passo {
namespace {

// The words of one option. False: the value is of a kind that no option takes.
bool add_words(const std::string& key, const TomlValue& value, std::vector<std::string>& words) {
  if (const bool* flag = std::get_if<bool>(&value.content)) {
    if (*flag) words.push_back("--" + key);
    return true;
  }
  if (const auto* items = std::get_if<TomlArray>(&value.content)) {
    return std::ranges::all_of(*items, [&](const TomlValue& item) { return add_words(key, item, words); });
  }
  const auto* number = std::get_if<double>(&value.content);
  const auto* text = std::get_if<std::string>(&value.content);
  if (number == nullptr && text == nullptr) return false;
  // One word with '=': a value such as -0.05 is no option.
  words.push_back(fmt::format("--{}={}", key, text != nullptr ? *text : fmt::format("{}", *number)));
  return true;
}

}  // namespace

std::optional<std::vector<OptionSection>> read_option_profile(const std::string& path,
                                                              const std::vector<std::string>& known,
                                                              Diagnostics& diagnostics) {
  constexpr std::size_t most_bytes = 1U << 20U;
  const std::optional<std::string> text = read_bytes(
      path, {.area = "profile", .expected = "an option profile: tables and keys in TOML", .most = most_bytes},
      diagnostics);
  if (!text) return std::nullopt;
  Diagnostics found;
  const TomlReporter reporter(*text, path, found, {.area = "profile", .words = "a profile"});
  TomlDocument document;
  if (is_fit_for_parser(reporter)) document = parse_toml(*text, reporter);
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "[" : ", [") + name + "]";
  std::vector<OptionSection> sections;
  for (const TomlEntry& entry : document.root.entries) {
    const auto* table = std::get_if<TomlTable>(&entry.value.content);
    if (table == nullptr || std::ranges::find(known, entry.key) == known.end()) {
      reporter.error("profile.unknown-table", entry.place, fmt::format("'{}' is not a table of a profile", entry.key),
                     names);
      continue;
    }
    OptionSection section{entry.key, entry.place.line, {}};
    for (const TomlEntry& option : table->entries) {
      if (add_words(option.key, option.value, section.words)) continue;
      reporter.error("profile.bad-value", option.value.place,
                     fmt::format("{} is not a valid option value", kind_of(option.value)),
                     "a number, a string, true or false, or a list of these");
    }
    sections.push_back(std::move(section));
  }
  for (const Diagnostic& one : found.all()) diagnostics.add(one);
  if (found.any_error()) return std::nullopt;
  return sections;
}

}  // namespace passo
