#include "passo/pendant/pendant_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/toml/fit_for_parser.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {
namespace {

constexpr NumberKey vendor_key{"vendor", 0, 0xFFFF, "0x0B33"};
constexpr NumberKey product_key{"product", 0, 0xFFFF, "0x0020"};
constexpr NumberKey length_key{"length", 1, PendantTable::longest_report, "5"};
constexpr NumberKey id_key{"id", 0, 255, "4"};
constexpr NumberKey silence_key{"silence_s", 0.02, 60, "0.1"};
constexpr NumberKey byte_key{"byte", 0, PendantTable::longest_report - 1, "1"};
constexpr NumberKey percent_key{"speed_percent", 100 * PendantTable::least_share, 100, "50"};
constexpr NumberKey pause_key{"pause_s", 0.02, 0.1, "0.05"};
constexpr double largest_step = 100;
constexpr std::size_t longest_name = 60;
constexpr std::size_t longest_ring = 100;

// Reads a whole number. Empty: the value is something else.
std::optional<unsigned> whole(const TomlValue& value, double most) {
  const auto* const number = std::get_if<double>(&value.content);
  if (number == nullptr || !(*number >= 0 && *number <= most) || *number != std::floor(*number)) return {};
  return static_cast<unsigned>(*number);
}

class PendantTableReader {
 public:
  PendantTableReader(const TomlDocument& document, const TomlReporter& reporter)
      : document_(document), reporter_(reporter), top_(document.root, "", {}, reporter) {}

  PendantTable read() {
    table_.name = top_.text("name", "ShuttleXpress", Need::required).value_or("").substr(0, longest_name);
    in_table("usb", Need::required, [this](TableReader& usb) {
      table_.vendor = static_cast<std::uint16_t>(usb.whole_number(vendor_key, Need::required).value_or(0));
      table_.product = static_cast<std::uint16_t>(usb.whole_number(product_key, Need::required).value_or(0));
    });
    in_table("report", Need::required, [this](TableReader& report) { read_report(report); });
    in_table("wheel", Need::optional, [this](TableReader& wheel) { read_wheel(wheel); });
    in_table("ring", Need::optional, [this](TableReader& ring) { read_ring(ring); });
    in_table("axis", Need::optional, [this](TableReader& axis) { read_axis(axis); });
    in_table("steps", Need::optional, [this](TableReader& steps) { read_steps(steps); });
    in_table("keys", Need::optional, [this](TableReader& keys) { read_keys(keys); });
    read_each_key();
    in_table("display", Need::optional, [this](TableReader& display) { read_display(display); });
    if (table_.wheel && table_.steps.empty() && document_.complete) {
      reporter_.error("pendant.no-steps", top_.place_of("wheel"), "the wheel has no steps",
                      "a table [steps], e.g. positions = [[0, 0.01, 5], [1, 0.1, 20]]");
    }
    top_.finish(document_.complete, {});
    return std::move(table_);
  }

 private:
  template <class Read>
  void in_table(std::string_view key, Need need, const Read& read) {
    const TomlEntry* const entry = top_.table(key, fmt::format("a table [{}]", key), need);
    if (entry == nullptr) return;
    TableReader reader(std::get<TomlTable>(entry->value.content), std::string(key), entry->place, reporter_);
    read(reader);
    reader.finish(document_.complete, {});
  }

  // Every byte lies in the report.
  std::size_t checked(TableReader& reader, std::string_view key, std::size_t byte) const {
    if (table_.length == 0 || byte < table_.length) return byte;
    reader.error("pendant.byte", key, fmt::format("byte {}", byte),
                 fmt::format("a byte of the report, 0 to {}", table_.length - 1));
    return 0;
  }
  std::size_t read_byte(TableReader& reader) {
    const auto byte = reader.whole_number(byte_key, Need::required);
    return byte ? checked(reader, byte_key.name, static_cast<std::size_t>(*byte)) : 0;
  }

  // The lists of numbers in a list; each has `width` numbers from 0 to `most`.
  std::vector<std::vector<double>> rows(TableReader& reader, const TomlTable& table, std::string_view key,
                                        std::size_t width, double most, const std::string& expected) const {
    reader.know(key);
    const TomlEntry* const entry = find(table, key);
    if (entry == nullptr) return {};
    std::vector<std::vector<double>> all;
    const auto* const list = std::get_if<TomlArray>(&entry->value.content);
    bool is_good = list != nullptr;
    for (std::size_t i = 0; is_good && i < list->size(); ++i) {
      const auto* const row = std::get_if<TomlArray>(&(*list)[i].content);
      is_good = row != nullptr && row->size() == width;
      std::vector<double>& numbers = all.emplace_back();
      for (std::size_t k = 0; is_good && k < width; ++k) {
        const auto* const number = std::get_if<double>(&(*row)[k].content);
        is_good = number != nullptr && *number >= 0 && *number <= most;
        if (is_good) numbers.push_back(*number);
      }
    }
    if (is_good) return all;
    reader.error("pendant.wrong-list", key, fmt::format("{} is {}", key, kind_of(entry->value)), expected);
    return {};
  }

  // A list of whole numbers.
  std::vector<unsigned> numbers(TableReader& reader, const TomlTable& table, std::string_view key, double most,
                                const std::string& expected) const {
    reader.know(key);
    const TomlEntry* const entry = find(table, key);
    if (entry == nullptr) return {};
    std::vector<unsigned> all;
    const auto* const list = std::get_if<TomlArray>(&entry->value.content);
    bool is_good = list != nullptr && !list->empty() && list->size() <= PendantTable::longest_report;
    for (std::size_t i = 0; is_good && i < list->size(); ++i) {
      const auto number = whole((*list)[i], most);
      is_good = number.has_value();
      if (number) all.push_back(*number);
    }
    if (is_good) return all;
    reader.error("pendant.wrong-list", key, fmt::format("{} is {}", key, kind_of(entry->value)), expected);
    return {};
  }

  const TomlTable& content(std::string_view key) const {
    return std::get<TomlTable>(find(document_.root, key)->value.content);
  }

  void read_report(TableReader& report) {
    table_.length = static_cast<std::size_t>(report.whole_number(length_key, Need::required).value_or(0));
    if (const auto id = report.whole_number(id_key, Need::optional)) table_.id = static_cast<std::uint8_t>(*id);
    if (const auto silence = report.number(silence_key, Need::optional)) table_.silence = Seconds(*silence);
    for (const std::vector<double>& row :
         rows(report, content("report"), "no_link", 2, 255, "bytes and their values, e.g. [[4, 0], [5, 0]]")) {
      table_.no_link.push_back({.byte = checked(report, "no_link", static_cast<std::size_t>(row[0])),
                                .value = static_cast<unsigned>(row[1])});
    }
  }

  void read_wheel(TableReader& wheel) {
    PendantTable::Wheel read{.byte = read_byte(wheel)};
    read.is_counter = wheel.is_second_of("pendant.wheel", "kind", "delta", "counter", Need::optional).value_or(false);
    read.is_reversed = wheel.flag("reversed").value_or(false);
    if (const auto percent = wheel.number(percent_key, Need::optional)) table_.step_share = *percent / 100;
    if (const auto pause = wheel.number(pause_key, Need::optional)) read.pause = Seconds(*pause);
    table_.wheel = read;
  }

  void read_ring(TableReader& ring) {
    PendantTable::Ring read{.byte = read_byte(ring), .shares = {}};
    const std::string expected =
        fmt::format("percentages of the highest speed, {} to 100, e.g. [2, 10, 50, 100]", percent_key.least);
    for (const unsigned percent : numbers(ring, content("ring"), "speeds_percent", 100, expected)) {
      read.shares.push_back(percent / 100.0);
    }
    if (read.shares.empty() || read.shares.size() > longest_ring ||
        *std::ranges::min_element(read.shares) < PendantTable::least_share) {
      ring.error("pendant.ring", "speeds_percent", "the speeds of the ring", expected);
    }
    table_.ring = std::move(read);
  }

  void read_axis(TableReader& axis) {
    PendantTable::AxisSelector selector{.byte = read_byte(axis), .positions = {}};
    for (const Axis one : all_axes) {
      const std::string_view letter = std::string_view("XYZABCUVW").substr(index_of(one), 1);
      const auto value = axis.whole_number({letter, 0, 255, "0x11"}, Need::optional);
      if (value) selector.positions.push_back({.value = static_cast<unsigned>(*value), .axis = one});
    }
    if (selector.positions.empty()) {
      axis.error("pendant.no-axes", "byte", "the selector has no axes", "the value of each axis, e.g. X = 0x11");
    }
    table_.axis_selector = std::move(selector);
  }

  void read_steps(TableReader& steps) {
    if (steps.has(byte_key.name)) table_.step_byte = read_byte(steps);
    const std::string expected =
        "value, step in mm (0: none) and percentage of the highest speed in continuous mode, with "
        "ascending steps, e.g. [[0x0D, 0.001, 2], [0x0E, 0.01, 5]]";
    double before = 0;
    bool is_good = true;
    for (const std::vector<double>& row : rows(steps, content("steps"), "positions", 3, 255, expected)) {
      const PendantStep step{.value = static_cast<unsigned>(row[0]), .step = row[1], .share = row[2] / 100};
      const bool is_larger = step.step == 0 || (step.step > before && step.step <= largest_step);
      is_good = is_good && is_larger && step.share >= PendantTable::least_share && step.share <= 1;
      before = std::max(before, step.step);
      table_.steps.push_back(step);
    }
    if (!is_good || table_.steps.empty() || table_.steps.size() > PendantTable::most_steps) {
      steps.error("pendant.steps", "positions", fmt::format("{} positions", table_.steps.size()), expected);
    }
  }

  void read_keys(TableReader& keys) {
    const std::string expected =
        fmt::format("bytes of the report, 0 to {}", std::max<std::size_t>(table_.length, 1) - 1);
    const double last = static_cast<double>(std::max<std::size_t>(table_.length, 1) - 1);
    const auto codes = numbers(keys, content("keys"), "code_bytes", last, expected);
    const auto bits = numbers(keys, content("keys"), "bit_bytes", last, expected);
    if (codes.empty() == bits.empty()) {
      keys.error("pendant.keys", "code_bytes", codes.empty() ? "neither code_bytes nor bit_bytes" : "both forms",
                 "code_bytes, if a byte is the code of the key that is held, or bit_bytes, if each key is a bit");
    }
    table_.keys.are_bits = !bits.empty();
    for (const unsigned byte : bits.empty() ? codes : bits) table_.keys.bytes.push_back(byte);
  }

  void read_each_key() {
    const TomlEntry* const keys = top_.table("key", "a table [key.NAME] for each key", Need::optional);
    if (keys == nullptr) return;
    const auto& entries = std::get<TomlTable>(keys->value.content).entries;
    if (entries.size() > PendantTable::most_keys) {
      reporter_.error("pendant.too-many-keys", keys->place, fmt::format("{} keys", entries.size()),
                      fmt::format("at most {}", PendantTable::most_keys));
      return;
    }
    for (const TomlEntry& one : entries) {
      if (const auto* const table = std::get_if<TomlTable>(&one.value.content)) {
        table_.keys.all.push_back(read_key(one, *table));
      } else {
        reporter_.error("pendant.key", one.place, fmt::format("key.{} is {}", one.key, kind_of(one.value)),
                        fmt::format("a table [key.{}]", one.key));
      }
    }
  }

  PendantKey read_key(const TomlEntry& entry, const TomlTable& table) {
    TableReader reader(table, fmt::format("key.{}", entry.key), entry.place, reporter_);
    const double bits = 8.0 * static_cast<double>(table_.keys.bytes.size());
    const NumberKey number =
        table_.keys.are_bits ? NumberKey{"bit", 0, std::max(bits, 1.0) - 1, "4"} : NumberKey{"code", 1, 255, "2"};
    PendantKey key{.name = entry.key.substr(0, longest_name), .action = {}, .with_modifier = {}};
    key.number = static_cast<unsigned>(reader.whole_number(number, Need::required).value_or(0));
    key.action = read_action(reader, "action", Need::required);
    key.with_modifier = read_action(reader, "with_modifier", Need::optional);
    reader.finish(document_.complete, {});
    return key;
  }

  static PendantAction read_action(TableReader& reader, std::string_view key, Need need) {
    const auto text = reader.text(key, "stop", need);
    if (!text) return {};
    auto action = parse_pendant_action(*text);
    if (action) return std::move(*action);
    reader.error("pendant.action", key, fmt::format("{} = \"{}\"", key, text->substr(0, longest_name)),
                 "one of " + pendant_actions_in_words());
    return {};
  }

  void read_display(TableReader& display) {
    PendantTable::Display read;
    read.is_feature =
        display.is_second_of("pendant.display", "report", "output", "feature", Need::optional).value_or(false);
    read.id = static_cast<std::uint8_t>(display.whole_number(id_key, Need::required).value_or(0));
    read.length = static_cast<std::size_t>(
        display.whole_number({"length", 2, PendantTable::longest_report, "8"}, Need::required).value_or(2));
    display.know("contents");
    const TomlEntry* const contents = find(content("display"), "contents");
    const auto* const list = contents != nullptr ? std::get_if<TomlArray>(&contents->value.content) : nullptr;
    bool is_good = list != nullptr && list->size() <= PendantTable::most_display_fields;
    for (std::size_t i = 0; is_good && i < list->size(); ++i) {
      const auto field = display_field((*list)[i]);
      is_good = field.has_value();
      if (field) read.fields.push_back(*field);
    }
    if (!is_good || read.fields.empty()) {
      display.error("pendant.display", "contents", "the contents of the display",
                    fmt::format("a list of at most {} bytes and of \"mode\", \"axis 1\" to \"axis 3\", \"feed\" and "
                                "\"spindle\", e.g. [0xFE, 0xFD, \"mode\", \"axis 1\"]",
                                PendantTable::most_display_fields));
    }
    table_.display = std::move(read);
  }

  static std::optional<PendantTable::DisplayField> display_field(const TomlValue& value) {
    using Kind = PendantTable::DisplayField::Kind;
    PendantTable::DisplayField field;
    if (const auto literal = whole(value, 255)) {
      field.literal = static_cast<std::uint8_t>(*literal);
      return field;
    }
    const auto* const word = std::get_if<std::string>(&value.content);
    if (word == nullptr) return {};
    if (*word == "mode") field.kind = Kind::mode;
    if (*word == "feed") field.kind = Kind::feed;
    if (*word == "spindle") field.kind = Kind::spindle;
    if (word->starts_with("axis ") && word->size() == 6 && word->back() >= '1' && word->back() <= '3') {
      field.kind = Kind::axis;
      field.axis = static_cast<unsigned>(word->back() - '0');
    }
    return field.kind != Kind::literal ? std::optional(field) : std::nullopt;
  }

  const TomlDocument& document_;
  const TomlReporter& reporter_;
  TableReader top_;
  PendantTable table_;
};

}  // namespace

std::optional<PendantTable> parse_pendant_table(std::string text, const std::string& file, Diagnostics& diagnostics) {
  Diagnostics found;
  const TomlReporter reporter(text, file, found, {.area = "pendant", .words = "the table of a pendant"});
  std::optional<PendantTable> table;
  if (is_fit_for_parser(reporter)) table = PendantTableReader(parse_toml(text, reporter), reporter).read();
  const bool is_good = table && !found.any_error();
  hand_over(found, diagnostics);
  return is_good ? std::move(table) : std::nullopt;
}

}  // namespace passo
