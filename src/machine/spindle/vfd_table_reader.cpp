#include <charconv>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/spindle/vfd_table.hpp"
#include "passo/toml/fit_for_parser.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {
namespace {

constexpr std::size_t largest_table = 1U << 16U;
constexpr std::size_t longest_fault_text = 200;  // bytes
constexpr NumberKey register_key{"register", 0, 65535, "8193"};
constexpr NumberKey value_key{"value", 0, 65535, "1"};
constexpr NumberKey function_key{"function", 3, 16, "6"};
constexpr NumberKey mask_key{"mask", 1, 65535, "0xFF"};
constexpr NumberKey scale_key{"scale", 1e-6, 1e6, "100"};
constexpr const char* function_code = "vfd.function";

class VfdTableReader {
 public:
  VfdTableReader(const TomlDocument& document, const TomlReporter& reporter)
      : document_(document), reporter_(reporter) {}

  VfdTable read() {
    VfdTable table;
    TableReader top(document_.root, "", {}, reporter_);
    table.name = top.text("name", "Delta MS300", Need::required).value_or("");
    table.timeout_setting = top.text("timeout_setting", "09-03 = 1.0", Need::optional).value_or("");
    const auto find_table = [&](std::string_view key, Need need) {
      return top.table(key, fmt::format("a table [{}]", key), need);
    };
    if (const auto* entry = find_table("speed", Need::required)) table.speed = read_register(*entry, true, true);
    if (const auto* entry = find_table("forward", Need::required)) table.forward = read_command(*entry);
    if (const auto* entry = find_table("reverse", Need::optional)) table.reverse = read_command(*entry);
    if (const auto* entry = find_table("stop", Need::required)) table.stop = read_command(*entry);
    if (const auto* entry = find_table("reset", Need::optional)) table.reset = read_command(*entry);
    if (const auto* entry = find_table("actual_speed", Need::required)) {
      table.actual_speed = read_register(*entry, true, false);
    }
    if (const auto* entry = find_table("current", Need::optional)) table.current = read_register(*entry, false, false);
    if (const auto* entry = find_table("load", Need::optional)) table.load = read_register(*entry, false, false);
    if (const auto* entry = find_table("fault", Need::optional)) table.fault = read_fault(*entry);
    if (const auto* entry = find_table("fault_text", Need::optional)) read_texts(*entry, table);
    top.finish(document_.complete, {});
    return table;
  }

 private:
  TableReader reader_of(const TomlEntry& entry) const {
    return {std::get<TomlTable>(entry.value.content), entry.key, entry.place, reporter_};
  }

  // Writing: 5 (a coil), 6 (a register) or 16 (registers). Reading: 3 (holding registers) or 4 (input registers).
  void read_function(TableReader& reader, bool writes, bool may_be_coil, int& function) const {
    const auto number = reader.whole_number(function_key, Need::optional);
    if (!number) return;
    function = static_cast<int>(*number);
    const bool is_possible =
        writes ? function == 6 || function == 16 || (may_be_coil && function == 5) : function == 3 || function == 4;
    if (is_possible) return;
    reader.error(function_code, function_key.name,
                 fmt::format("{} = {}", reader.full_name(function_key.name), function),
                 !writes       ? "3 (read holding registers) or 4 (read input registers)"
                 : may_be_coil ? "5 (write a coil), 6 (write a register) or 16 (write registers)"
                               : "6 (write a register) or 16 (write registers)");
  }

  VfdRegister read_register(const TomlEntry& entry, bool is_speed, bool writes) const {
    TableReader reader = reader_of(entry);
    VfdRegister read{.function = writes ? 6 : 3};
    read_function(reader, writes, false, read.function);
    if (const auto address = reader.whole_number(register_key, Need::required)) {
      read.address = static_cast<std::uint16_t>(*address);
    }
    if (const auto scale = reader.number(scale_key, Need::optional)) read.scale = *scale;
    if (is_speed) {
      read.is_in_hertz = !reader.is_second_of("vfd.unit", "unit", "hz", "rpm", Need::required).value_or(false);
    }
    reader.finish(document_.complete, {});
    return read;
  }

  VfdRegister read_fault(const TomlEntry& entry) const {
    TableReader reader = reader_of(entry);
    VfdRegister read;
    read_function(reader, false, false, read.function);
    if (const auto address = reader.whole_number(register_key, Need::required)) {
      read.address = static_cast<std::uint16_t>(*address);
    }
    if (const auto mask = reader.whole_number(mask_key, Need::optional)) read.mask = static_cast<std::uint16_t>(*mask);
    reader.finish(document_.complete, {});
    return read;
  }

  VfdCommand read_command(const TomlEntry& entry) const {
    TableReader reader = reader_of(entry);
    VfdCommand command;
    read_function(reader, true, true, command.function);
    if (const auto address = reader.whole_number(register_key, Need::required)) {
      command.address = static_cast<std::uint16_t>(*address);
    }
    if (const auto value = reader.whole_number(value_key, Need::required)) {
      command.value = static_cast<std::uint16_t>(*value);
    }
    reader.finish(document_.complete, {});
    return command;
  }

  void read_texts(const TomlEntry& entry, VfdTable& table) const {
    TableReader reader = reader_of(entry);
    for (const TomlEntry& one : std::get<TomlTable>(entry.value.content).entries) {
      reader.know(one.key);
      int number = 0;
      const char* const end = one.key.data() + one.key.size();
      const auto parsed = std::from_chars(one.key.data(), end, number);
      if (parsed.ec != std::errc() || parsed.ptr != end || number < 1 || number > 65535) {
        reader.error("vfd.fault-text", one.key, fmt::format("the key {}", one.key.substr(0, 40)),
                     "the number of a fault, 1 to 65535");
        continue;
      }
      if (auto text = reader.text(one.key, "overcurrent", Need::optional)) {
        table.fault_texts[number] = text->substr(0, longest_fault_text);
      }
    }
    reader.finish(document_.complete, {});
  }

  const TomlDocument& document_;
  const TomlReporter& reporter_;
};

}  // namespace

std::optional<VfdTable> parse_vfd_table(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Diagnostics found(most_sorted_errors);
  const TomlReporter reporter(text, file, found, {.area = "vfd", .words = "a table of a drive"});
  VfdTable table;
  if (is_fit_for_parser(reporter)) table = VfdTableReader(parse_toml(std::string(text), reporter), reporter).read();
  hand_over(found, diagnostics);
  if (found.any_error()) return std::nullopt;
  return table;
}

std::optional<VfdTable> load_vfd_table(const std::string& path, Diagnostics& diagnostics) {
  const FileKind kind{.area = "vfd", .expected = "a table file of a drive (TOML)", .most = largest_table};
  const auto text = read_bytes(path, kind, diagnostics);
  if (!text) return std::nullopt;
  return parse_vfd_table(*text, path, diagnostics);
}

}  // namespace passo
