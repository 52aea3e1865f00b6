#include "passo/macro/macro.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/toml/table_reader.hpp"

namespace passo {
namespace {

constexpr double farthest = 1e6;
constexpr NumberKey low_key{"least", -farthest, farthest, "1"};
constexpr NumberKey high_key{"most", -farthest, farthest, "400"};
constexpr NumberKey usual_key{"default", -farthest, farthest, "100"};
constexpr std::string_view first_key = "title";
constexpr std::string_view value_table = "value";
constexpr std::size_t longest_title = 100;
constexpr std::array<std::string_view, 7> units{"", "mm", "mm/min", "deg", "rpm", "s", "%"};
constexpr std::array<std::string_view, 2> inputs{"cycle_start", "feed_hold"};
constexpr int function_keys = 12;

constexpr SentenceRow missing_value{"macro.missing-value", "{title}: a value from {low} to {high} is needed"};
constexpr SentenceRow wrong_value{"macro.wrong-value", "{title}: expected {low} to {high}, not {value}"};
constexpr SentenceRow whole_value{"macro.whole-value", "{title}: expected a whole number, not {value}"};
constexpr SentenceRow unknown_value{"macro.unknown-value", "the macro has no value {name}"};

// The lines of the head: those before the first line that does not begin with ';'.
struct Head {
  std::size_t bytes = 0;
  std::uint32_t lines = 0;
};

Head head_of(std::string_view text) {
  Head head;
  while (head.bytes < text.size() && text[head.bytes] == ';') {
    const std::size_t end = text.find('\n', head.bytes);
    head.bytes = end == std::string_view::npos ? text.size() : end + 1;
    ++head.lines;
  }
  return head;
}

// The head as TOML: columns stay as they are.
std::string toml_of(std::string_view text, const Head& head) {
  std::string toml(text.substr(0, head.bytes));
  for (std::size_t i = 0; i < toml.size(); ++i) {
    if (toml[i] == ';' && (i == 0 || toml[i - 1] == '\n')) toml[i] = ' ';
  }
  return toml;
}

bool is_parameter_name(std::string_view name) {
  constexpr std::size_t longest_name = 40;
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && name.size() <= longest_name && std::ranges::all_of(name, fits) &&
         !(name.front() >= '0' && name.front() <= '9');
}

class MacroReader {
 public:
  MacroReader(const TomlDocument& document, const TomlReporter& reporter) : document_(document), reporter_(reporter) {}

  Macro read() {
    TableReader top(document_.root, "", {}, reporter_);
    Macro macro;
    macro.title = top.text(first_key, "Face the stock", Need::required).value_or("").substr(0, longest_title);
    macro.key = top.text("key", "F6", Need::optional).value_or("");
    if (!macro.key.empty() && !is_key(macro.key)) {
      top.error("macro.key", "key", fmt::format("key = \"{}\"", macro.key.substr(0, 40)), "\"F1\" to \"F12\"");
    }
    macro.input = top.text("input", "cycle_start", Need::optional).value_or("");
    if (!macro.input.empty() && std::ranges::find(inputs, macro.input) == inputs.end()) {
      top.error("macro.input", "input", fmt::format("input = \"{}\"", macro.input.substr(0, 40)),
                fmt::format("\"{}\"", fmt::join(inputs, "\" or \"")));
    }
    if (const TomlEntry* const values = top.table(value_table, "a table [value.NAME] for each value", Need::optional)) {
      read_values(*values, macro);
    }
    top.finish(document_.complete, {});
    return macro;
  }

 private:
  static bool is_key(const std::string& key) {
    for (int i = 1; i <= function_keys; ++i) {
      if (key == fmt::format("F{}", i)) return true;
    }
    return false;
  }

  void read_values(const TomlEntry& entry, Macro& macro) {
    for (const TomlEntry& one : std::get<TomlTable>(entry.value.content).entries) {
      const auto* const table = std::get_if<TomlTable>(&one.value.content);
      if (table == nullptr || !is_parameter_name(one.key)) {
        reporter_.error("macro.value-name", one.place, fmt::format("[value.{}]", one.key.substr(0, 40)),
                        "a table [value.NAME], with a name of small letters, digits and _");
        continue;
      }
      macro.values.push_back(read_value(one, *table));
    }
    if (macro.values.size() > Macro::most_values) {
      reporter_.error("macro.too-many-values", entry.place, fmt::format("{} values", macro.values.size()),
                      fmt::format("at most {}", Macro::most_values));
    }
  }

  MacroValue read_value(const TomlEntry& entry, const TomlTable& table) {
    TableReader reader(table, fmt::format("value.{}", entry.key), entry.place, reporter_);
    MacroValue value{.name = entry.key, .title = {}, .unit = {}};
    value.title = reader.text("title", "Width", Need::optional).value_or(entry.key).substr(0, longest_title);
    value.unit = reader.text("unit", "mm", Need::optional).value_or("");
    if (std::ranges::find(units, value.unit) == units.end()) {
      reader.error("macro.unit", "unit", fmt::format("unit = \"{}\"", value.unit.substr(0, 40)),
                   fmt::format("one of \"{}\"", fmt::join(units.begin() + 1, units.end(), "\", \"")));
    }
    value.low = reader.number(low_key, Need::required).value_or(0);
    value.high = reader.number(high_key, Need::required).value_or(0);
    value.is_whole = reader.flag("whole").value_or(false);
    value.usual = reader.number(usual_key, Need::optional);
    const bool is_inside = !value.usual || (*value.usual >= value.low && *value.usual <= value.high);
    if (value.low > value.high || !is_inside) {
      reader.error("macro.range", is_inside ? low_key.name : usual_key.name,
                   fmt::format("{:g} to {:g}, default {:g}", value.low, value.high, value.usual.value_or(value.low)),
                   "least, then most, and a default between them");
    }
    reader.finish(document_.complete, {});
    return value;
  }

  const TomlDocument& document_;
  const TomlReporter& reporter_;
};

// A '%' of the macro's own would end the program before its time.
std::optional<std::uint32_t> line_with_percent(std::string_view text) {
  std::uint32_t number = 1;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != std::string_view::npos && line[first] == '%') return number;
    text.remove_prefix(end);
    ++number;
  }
  return {};
}

std::optional<Sentence> refuse(const MacroValue& value, double given) {
  const auto as_text = [](double number) { return fmt::format("{:g}", number); };
  if (!(given >= value.low && given <= value.high)) {
    return wrong_value.with({{"title", value.title},
                             {"low", as_text(value.low)},
                             {"high", as_text(value.high)},
                             {"value", as_text(given)}});
  }
  if (value.is_whole && given != std::floor(given)) {
    return whole_value.with({{"title", value.title}, {"value", as_text(given)}});
  }
  return {};
}

}  // namespace

bool has_macro_head(std::string_view text) {
  if (!text.starts_with(';')) return false;
  const std::size_t first = text.find_first_not_of("; \t");
  return first != std::string_view::npos && text.substr(first).starts_with(first_key);
}

std::optional<Macro> parse_macro(std::string_view text, const std::string& name, const std::string& file,
                                 Diagnostics& diagnostics) {
  Diagnostics found;
  const Head head = head_of(text);
  const std::string toml = toml_of(text, head);
  const TomlReporter reporter(toml, file, found, {.area = "macro", .words = "the head of a macro"});
  Macro macro = MacroReader(parse_toml(toml, reporter), reporter).read();
  if (text.size() > Macro::longest) {
    reporter.error("macro.too-long", {}, fmt::format("{} bytes", text.size()),
                   fmt::format("at most {} bytes", Macro::longest));
  }
  if (const auto line = line_with_percent(text)) {
    reporter.error("macro.percent", {}, fmt::format("'%' in line {}", *line), "a macro without '%'");
  }
  // Each value has its assignment in a line of the head.
  if (head.lines < macro.values.size() + 1) {
    reporter.error("macro.short-head", {}, fmt::format("a head of {} lines", head.lines), "a line for each value");
  }
  const bool is_good = !found.any_error();
  for (const Diagnostic& one : found.all()) diagnostics.add(one);
  if (!is_good) return {};
  macro.name = name;
  macro.text = text;
  macro.head_lines = head.lines;
  return macro;
}

Result<std::string, Sentence> macro_program(const Macro& macro, const MacroValues& given) {
  for (const auto& [name, value] : given) {
    if (std::ranges::find(macro.values, name, &MacroValue::name) == macro.values.end()) {
      return Failure{unknown_value.with({{"name", name.substr(0, 40)}})};
    }
  }
  std::string program = "%\n";
  for (const MacroValue& one : macro.values) {
    const auto found = given.find(one.name);
    const std::optional<double> value = found != given.end() ? std::optional(found->second) : one.usual;
    if (!value) {
      return Failure{missing_value.with(
          {{"title", one.title}, {"low", fmt::format("{:g}", one.low)}, {"high", fmt::format("{:g}", one.high)}})};
    }
    if (auto refused = refuse(one, *value)) return Failure{std::move(*refused)};
    program += fmt::format("#<{}> = {:.6f}\n", one.name, *value);
  }
  for (std::size_t line = macro.values.size() + 1; line < macro.head_lines; ++line) program += '\n';
  program += std::string_view(macro.text).substr(head_of(macro.text).bytes);
  if (program.back() != '\n') program += '\n';
  return program + "%\n";
}

}  // namespace passo
