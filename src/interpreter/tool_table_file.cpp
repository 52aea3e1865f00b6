#include "passo/interpreter/tool_table_file.hpp"

#include <cmath>

#include "code_table.hpp"
#include "file_fields.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr double largest_length = 1e6;  // millimetres
constexpr std::int32_t highest_number = 99999;
constexpr std::int32_t highest_orientation = 9;

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
    seen_ = {};
    bool good = true;
    while (fields_.next_field(field)) {
      const std::size_t remark = field.text.find(';');
      if (remark != std::string_view::npos) field.text = field.text.substr(0, remark);
      if (!field.text.empty()) {
        if (upper(field.text.front()) == 'T') number = field;
        good = read_word(field, tool) && good;
      }
      if (remark != std::string_view::npos) break;
    }
    if (!good || !seen_.any()) return;
    if (!seen_.has('T') || !seen_.has('P')) {
      fields_.error("tools.missing-number", fmt::format("a tool without {}", seen_.has('T') ? "P, its pocket" : "T"),
                    "T and P in each line, as in T1 P1 Z0.5 D3");
      return;
    }
    add(tool, number);
  }

  void add(const Tool& tool, const Field& number) {
    if (table_.add(tool)) return;
    if (table_.find(tool.number) != nullptr) {
      fields_.error("tools.repeated-tool", number, fmt::format("a second tool {}", tool.number),
                    "each number once in a table");
    } else {
      fields_.error("tools.too-many", number, fmt::format("more than {} tools", ToolTable::most_tools),
                    "a shorter table");
    }
  }

  bool read_word(const Field& field, Tool& tool) {
    const char letter = upper(field.text.front());
    const std::string_view digits = field.text.substr(1);
    if (std::string_view("TPXYZABCUVWDIJQ").find(letter) == std::string_view::npos) {
      fields_.error("tools.unknown-word", field, fmt::format("{} is no word of a tool table", quoted(field.text)),
                    "T P X Y Z A B C U V W D I J Q with a number behind, or ';' before a remark");
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
      case 'Q': return read_whole(field, 0, highest_orientation, tool.orientation);
      default: break;
    }
    const std::optional<double> value = number_of(digits);
    if (!value || std::abs(*value) * unit_ > largest_length) {
      fields_.error("tools.bad-number", field, fmt::format("{} is not a number of a tool", quoted(field.text)),
                    fmt::format("{} and a number, as in {}2.5", letter, letter));
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
    problem.expected = "a tool table, a line a tool: T1 P1 Z0.5 D3";
    diagnostics.add(std::move(problem));
    return false;
  }
  const std::size_t before = diagnostics.errors();
  TableReader(std::move(*reader), units, table, diagnostics).read();
  return diagnostics.errors() == before;
}

}  // namespace passo
