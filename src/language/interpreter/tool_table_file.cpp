#include "passo/interpreter/tool_table_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "code_table.hpp"
#include "file_fields.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr double largest_length = 1e6;  // millimetres
constexpr std::int32_t highest_number = 99999;

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

class TableReader {
 public:
  TableReader(ProgramReader reader, LengthUnits units, ToolTable& table, Diagnostics& diagnostics)
      : fields_(std::move(reader), diagnostics), unit_(units == LengthUnits::inch ? mm_per_inch : 1), table_(table) {}

  void read() {
    while (fields_.next_line()) read_tool();
  }

 private:
  void read_tool() {
    Tool tool;
    Field field;
    Field number;
    std::string words;
    seen_ = {};
    bool good = true;
    while (fields_.next_field(field)) {
      const std::size_t remark = field.text.find(';');
      if (remark != std::string_view::npos) {
        words = field.text.substr(remark + 1);
        if (const Field rest = fields_.rest(); !rest.text.empty()) {
          words += (words.empty() ? "" : " ") + std::string(rest.text);
        }
        field.text = field.text.substr(0, remark);
      }
      if (!field.text.empty()) {
        if (upper(field.text.front()) == 'T') number = field;
        good = read_word(field, tool) && good;
      }
      if (remark != std::string_view::npos) break;
    }
    if (!good || !seen_.any()) return;
    if (!seen_.has('T') || !seen_.has('P')) {
      fields_.error("tools.missing-number",
                    fmt::format("a tool without {}", seen_.has('T') ? "P, the pocket of the tool" : "T"),
                    "T and P in each line, e.g. T1 P1 Z0.5 D3");
      return;
    }
    if (add(tool, number) && !words.empty()) table_.remarks[tool.number] = std::move(words);
  }

  bool add(const Tool& tool, const Field& number) {
    if (table_.add(tool)) return true;
    if (table_.find(tool.number) != nullptr) {
      fields_.error("tools.repeated-tool", number, fmt::format("a second tool {}", tool.number),
                    "each tool number once in a table");
    } else {
      fields_.error("tools.too-many", number, fmt::format("more than {} tools", ToolTable::most_tools),
                    "a shorter table");
    }
    return false;
  }

  bool read_word(const Field& field, Tool& tool) {
    const char letter = upper(field.text.front());
    const std::string_view digits = field.text.substr(1);
    if (std::string_view("TPXYZABCUVWDIJQ").find(letter) == std::string_view::npos) {
      fields_.error("tools.unknown-word", field, fmt::format("{} is not a word of a tool table", quoted(field.text)),
                    "T P X Y Z A B C U V W D I J Q, each followed by a number, or ';' before a remark");
      return false;
    }
    if (seen_.has(letter)) {
      fields_.error("tools.repeated-word", field, fmt::format("a second {} for one tool", letter), "each letter once");
      return false;
    }
    seen_.add(letter);
    switch (letter) {
      case 'T': return read_whole(field, 1, highest_number, tool.number);
      case 'P': return read_whole(field, 0, highest_number, tool.pocket);
      case 'Q': return read_whole(field, 0, highest_tool_orientation, tool.orientation);
      default: break;
    }
    const std::optional<double> value = number_of(digits);
    if (!value || std::abs(*value) * unit_ > largest_length) {
      fields_.error("tools.bad-number", field, fmt::format("{} is not a valid tool number", quoted(field.text)),
                    fmt::format("{} and a number, e.g. {}2.5", letter, letter));
      return false;
    }
    switch (letter) {
      case 'D': tool.diameter = Mm(*value * unit_); break;
      case 'I': tool.front_angle_deg = *value; break;
      case 'J': tool.back_angle_deg = *value; break;
      default: {
        const Axis axis = *axis_of(letter);
        tool.offset[axis] = is_rotary(axis) ? *value : *value * unit_;
      }
    }
    return true;
  }

  bool read_whole(const Field& field, std::int32_t lowest, std::int32_t highest, std::int32_t& value) {
    const std::optional<std::int32_t> number = whole_number_of(field.text.substr(1));
    if (number && *number >= lowest && *number <= highest) {
      value = *number;
      return true;
    }
    fields_.error("tools.not-whole", field, fmt::format("{} is out of range", quoted(field.text)),
                  fmt::format("{} with a whole number, {} to {}", upper(field.text.front()), lowest, highest));
    return false;
  }

  FieldReader fields_;
  double unit_;
  ToolTable& table_;
  LetterSet seen_;
};

}  // namespace

bool read_tool_table(const std::string& path, LengthUnits units, ToolTable& table, Diagnostics& diagnostics) {
  Result<ProgramReader, Diagnostic> reader = ProgramReader::open(path);
  table = {};
  table.name = path;
  if (!reader) {
    Diagnostic problem = reader.error();
    if (problem.code == "file.empty") return true;  // a table without tools
    problem.expected = "a tool table with one line per tool, e.g. T1 P1 Z0.5 D3";
    diagnostics.add(std::move(problem));
    return false;
  }
  return read_tool_table(std::move(*reader), units, table, diagnostics);
}

bool read_tool_table(ProgramReader reader, LengthUnits units, ToolTable& table, Diagnostics& diagnostics) {
  table = {};
  table.name = reader.name();
  const std::size_t before = diagnostics.errors();
  TableReader(std::move(reader), units, table, diagnostics).read();
  return diagnostics.errors() == before;
}

namespace {

constexpr std::string_view blank_characters = " \t\r";
constexpr std::string_view value_letters = "XYZABCUVWDIJQ";
constexpr double written_alike = 5e-7;  // six decimals are written

// The number that belongs behind this letter in the tool's line, in the file's units.
double value_of(const Tool& tool, char letter, double unit) {
  switch (letter) {
    case 'D': return tool.diameter.value() / unit;
    case 'I': return tool.front_angle_deg;
    case 'J': return tool.back_angle_deg;
    case 'Q': return tool.orientation;
    default: break;
  }
  const Axis axis = *axis_of(letter);
  return tool.offset[axis] / (is_rotary(axis) ? 1 : unit);
}

std::string written(char letter, double value, bool plus) {
  std::string text = fmt::format("{:.6f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  if (text == "-0") text = "0";
  return letter + (plus && text.front() != '-' ? "+" + text : text);
}

// The words of a line without its remark.
std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(blank_characters); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blank_characters, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blank_characters, end);
  }
  return words;
}

const Tool* tool_of(const std::vector<std::string_view>& words, const ToolTable& table) {
  for (const std::string_view word : words) {
    const auto number = upper(word.front()) == 'T' ? whole_number_of(word.substr(1)) : std::nullopt;
    if (number) return table.find(*number);
  }
  return nullptr;
}

std::string line_with(const Tool& tool, std::string_view line, const std::vector<std::string_view>& words,
                      double unit) {
  std::string text;
  LetterSet seen;
  std::size_t copied = 0;
  for (const std::string_view word : words) {
    const auto at = static_cast<std::size_t>(word.data() - line.data());
    const char letter = upper(word.front());
    text += line.substr(copied, at - copied);
    copied = at + word.size();
    seen.add(letter);
    const std::optional<double> old = number_of(word.substr(1));
    const bool has_value = value_letters.find(letter) != std::string_view::npos && old;
    const double value = has_value ? value_of(tool, letter, unit) : 0;
    text += !has_value || std::abs(value - *old) < written_alike
                ? std::string(word)
                : written(word.front(), value, word.size() > 1 && word[1] == '+');
  }
  for (const char letter : value_letters) {
    const double value = value_of(tool, letter, unit);
    if (!seen.has(letter) && std::abs(value) >= written_alike) text += " " + written(letter, value, false);
  }
  return text += line.substr(copied);
}

}  // namespace

std::string tool_table_text(std::string_view text, LengthUnits units, const ToolTable& table) {
  const double unit = units == LengthUnits::inch ? mm_per_inch : 1;
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    const std::string_view head = line.substr(0, line.find_first_of(";\n"));
    const std::vector<std::string_view> words = split_words(head);
    const Tool* const tool = tool_of(words, table);
    result += tool == nullptr ? std::string(head) : line_with(*tool, head, words, unit);
    result += line.substr(head.size());
  }
  return result;
}

void add_new_tools(std::string& text, const ToolTable& known, const ToolTable& table) {
  for (const auto& [number, tool] : table.all()) {
    if (known.find(number) != nullptr) continue;
    if (!text.empty() && text.back() != '\n') text += '\n';
    text += fmt::format("T{} P{}\n", number, tool.pocket);
  }
}

std::string tool_table_text(const ToolTable& table) {
  std::string lines;
  add_new_tools(lines, ToolTable(), table);
  return tool_table_text(lines, LengthUnits::mm, table);
}

}  // namespace passo
