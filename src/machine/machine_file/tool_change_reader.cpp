#include "tool_change_reader.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>

#include "code_lines_reader.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/toml/toml_sentences.hpp"

namespace passo {
namespace {

const char* const change_code = "machine.tool-change";

constexpr NumberKey safe_z_key{"safe_z_mm", -1e5, 1e5, "-5"};
constexpr NumberKey change_at_key{"change_at_mm", -1e5, 1e5, "[10, 10]"};
constexpr NumberKey measure_at_key{"measure_at_mm", -1e5, 1e5, "[290, 20]"};
constexpr NumberKey window_key{"window_mm", -1e5, 1e5, "[-90, -40]"};
constexpr NumberKey seek_key{"seek_mm_s", 1e-3, 1e5, "10"};
constexpr NumberKey latch_key{"latch_mm_s", 1e-3, 1e5, "0.5"};
constexpr NumberKey retract_key{"retract_mm", 0.01, 100, "2"};
constexpr NumberKey touches_key{"touches", 1, 10, "3"};
constexpr NumberKey agreement_key{"touches_within_mm", 0.001, 10, "0.05"};
constexpr NumberKey nose_key{"nose_z_mm", -1e5, 1e5, "-130"};
constexpr NumberKey run_down_key{"spindle_run_down_s", 0, 600, "5"};
constexpr NumberKey wear_key{"wear_mm", 0.001, 100, "0.1"};

constexpr NumberKey collet_wait_key{"collet_wait_s", 0, 60, "1"};
constexpr NumberKey pockets_key{"pockets", 1, 1000, "6"};
constexpr NumberKey first_key{"first_mm", -1e5, 1e5, "[20, 380]"};
constexpr NumberKey step_key{"step_mm", -1e4, 1e4, "[40, 0]"};
constexpr NumberKey rack_z_key{"z_mm", -1e5, 1e5, "-80"};
constexpr NumberKey entry_key{"entry_mm", -1e4, 1e4, "[0, -40]"};
constexpr NumberKey rack_feed_key{"feed_mm_s", 1e-3, 1e5, "10"};
constexpr NumberKey wait_key{"wait_s", 0, 60, "1"};

// How far the second touch may go below the lowest first one; see ToolChangeCycle.
constexpr double below_window = 1;

// The number of the word. An absent or wrong one counts as the first.
std::size_t word_of(TableReader& reader, std::string_view key, std::initializer_list<std::string_view> words,
                    Need need) {
  const auto text = reader.text(key, *words.begin(), need);
  if (!text) return 0;
  const auto* const found = std::ranges::find(words, *text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  reader.error(change_code, key,
               toml_says::key_is.with({{"key", reader.full_name(key)}, {"value", fmt::format("\"{}\"", *text)}}),
               fmt::format("\"{}\"", fmt::join(words, "\" or \"")));
  return 0;
}

class ToolChangeReader {
 public:
  ToolChangeReader(TableReader& reader, TableReader* rack, const TomlValue* macro,
                   const std::vector<AxisDescription>& axes)
      : reader_(reader), rack_(rack), macro_(macro), axes_(axes) {}

  std::shared_ptr<const ToolChangePlan> read();

 private:
  void read_measuring(bool needs_place);
  void read_window();
  void read_rack(TableReader& rack);
  void read_macro();
  std::optional<MachineXy> place(TableReader& reader, const NumberKey& key, Need need);
  void check_pockets(TableReader& rack);
  void check_height(TableReader& reader, const NumberKey& key, double z);
  void check_speed(const NumberKey& key, MmPerSecond speed, MmPerSecond most, std::string_view than);
  void error(TableReader& reader, std::string_view key, std::string message, std::string expected);
  const AxisDescription* axis(Axis letter) const {
    const auto found = std::ranges::find(axes_, letter, &AxisDescription::axis);
    return found == axes_.end() ? nullptr : &*found;
  }
  bool is_in_travel(Axis letter, double value) const {
    const AxisDescription* const one = axis(letter);
    return one == nullptr || (value >= one->travel_low && value <= one->travel_high);
  }

  TableReader& reader_;
  TableReader* rack_;
  const TomlValue* macro_;
  const std::vector<AxisDescription>& axes_;
  ToolChangePlan plan_;
  bool good_ = true;
};

void ToolChangeReader::error(TableReader& reader, std::string_view key, std::string message, std::string expected) {
  reader.error(change_code, key, std::move(message), std::move(expected));
  good_ = false;
}

std::shared_ptr<const ToolChangePlan> ToolChangeReader::read() {
  plan_.way = static_cast<ToolChangeWay>(word_of(reader_, "way", {"setter", "plate", "rack", "macro"}, Need::required));
  plan_.first = static_cast<FirstTool>(word_of(reader_, "first_tool", {"change", "loaded", "trusted"}, Need::optional));
  if (const auto z = reader_.number(safe_z_key, Need::required)) {
    plan_.safe_z = *z;
    check_height(reader_, safe_z_key, *z);
  }
  plan_.change_at = place(reader_, change_at_key, Need::optional);
  plan_.run_down = Seconds(reader_.number(run_down_key, Need::optional).value_or(0));
  plan_.measures = reader_.flag("measures").value_or(true);
  if (plan_.measures) {
    read_measuring(plan_.way != ToolChangeWay::plate);
  } else if (plan_.way != ToolChangeWay::rack && plan_.way != ToolChangeWay::macro) {
    error(reader_, "measures", "tools that are changed by hand are not measured",
          "measures = true, or no table [tool_change]: M6 then only waits");
  }
  if (plan_.way == ToolChangeWay::rack) {
    if (rack_ != nullptr) {
      read_rack(*rack_);
    } else {
      reader_.missing("rack", "a table [tool_change.rack]");
    }
  } else if (rack_ != nullptr) {
    error(reader_, "rack", "[tool_change.rack] has no effect with this way", "way = \"rack\"");
  }
  reader_.know("macro");
  const auto collet_wait = reader_.number(collet_wait_key, Need::optional);
  plan_.macro_collet_wait = collet_wait ? Seconds(*collet_wait) : plan_.macro_collet_wait;
  if (collet_wait && plan_.way != ToolChangeWay::macro) {
    error(reader_, collet_wait_key.name, "tool_change.collet_wait_s has no effect with this way",
          "way = \"macro\"; a rack has wait_s");
  }
  if (plan_.way == ToolChangeWay::macro) {
    read_macro();
  } else if (macro_ != nullptr) {
    error(reader_, "macro", "tool_change.macro has no effect with this way", "way = \"macro\"");
  }
  for (const Axis letter : {Axis::x, Axis::y, Axis::z}) {
    if (axis(letter) == nullptr) {
      error(reader_, "", fmt::format("[tool_change] needs the axis {}, which the machine lacks", letter_of(letter)),
            "a machine with X, Y and Z");
    }
  }
  return good_ ? std::make_shared<const ToolChangePlan>(plan_) : nullptr;
}

void ToolChangeReader::read_measuring(bool needs_place) {
  plan_.measure_at = place(reader_, measure_at_key, needs_place ? Need::required : Need::optional);
  read_window();
  const AxisDescription* const z = axis(Axis::z);
  if (const auto speed = reader_.number(seek_key, Need::required)) {
    plan_.seek = MmPerSecond(*speed);
    check_speed(seek_key, plan_.seek, z != nullptr ? z->velocity : MmPerSecond(0), "the velocity of Z");
  }
  if (const auto speed = reader_.number(latch_key, Need::required)) {
    plan_.latch = MmPerSecond(*speed);
    check_speed(latch_key, plan_.latch, plan_.seek, "at most the seek speed");
  }
  if (const auto touches = reader_.whole_number(touches_key, Need::optional)) {
    plan_.touches = static_cast<std::int32_t>(*touches);
  }
  plan_.agreement = reader_.number(agreement_key, Need::optional).value_or(plan_.agreement);
  plan_.use = static_cast<LengthUse>(word_of(reader_, "lengths", {"reference", "absolute", "work"}, Need::optional));
  const auto nose = reader_.number(nose_key, plan_.use == LengthUse::absolute ? Need::required : Need::optional);
  if (nose && plan_.use != LengthUse::absolute) {
    error(reader_, nose_key.name, fmt::format("{} has no effect with these lengths", reader_.full_name(nose_key.name)),
          "lengths = \"absolute\"");
  }
  plan_.setter_z = nose.value_or(0);
  if (plan_.use == LengthUse::absolute && plan_.way == ToolChangeWay::plate) {
    error(reader_, "lengths", "a touch plate that is moved gives no absolute lengths", "\"reference\" or \"work\"");
  }
  plan_.wear = reader_.number(wear_key, Need::optional);
  if (plan_.wear && plan_.way == ToolChangeWay::plate) {
    error(reader_, wear_key.name, "a used tool is not measured with a touch plate", "no wear_mm, or another way");
  }
  if (plan_.first == FirstTool::trusted && plan_.use != LengthUse::absolute) {
    error(reader_, "first_tool", "the first tool has to be measured, because all lengths are relative to it",
          "\"change\" or \"loaded\", or lengths = \"absolute\"");
  }
}

void ToolChangeReader::read_window() {
  const auto window = reader_.low_high(window_key, Need::required);
  plan_.retract = reader_.number(retract_key, Need::optional).value_or(2);
  if (!window) return;
  plan_.window_low = window->low;
  plan_.window_high = window->high;
  const std::string name = reader_.full_name(window_key.name);
  if (window->low >= window->high) {
    error(reader_, window_key.name, fmt::format("{} goes from {:g} to {:g}", name, window->low, window->high),
          "the lowest Z at which a tool touches, then the highest");
  } else if (reader_.has(safe_z_key.name) && window->high + plan_.retract > plan_.safe_z) {
    error(reader_, window_key.name,
          fmt::format("a tool may touch at {:g} and rise {:g} from there, above safe_z_mm = {:g}", window->high,
                      plan_.retract, plan_.safe_z),
          fmt::format("an upper end of {:g} or less", plan_.safe_z - plan_.retract));
  }
  check_height(reader_, window_key, window->low - below_window);
}

void ToolChangeReader::read_macro() {
  if (macro_ == nullptr) {
    return reader_.missing("macro", "a list of lines of G-code, e.g. macro = [\"G53 G0 X0 Y0\", \"G53 G1 Z-50 F500\"]");
  }
  plan_.macro = read_code_lines(reader_, change_code, "macro", *macro_);
  good_ = good_ && !plan_.macro.empty();
}

std::optional<MachineXy> ToolChangeReader::place(TableReader& reader, const NumberKey& key, Need need) {
  const auto pair = reader.low_high(key, need);
  if (!pair) return std::nullopt;
  const MachineXy at{pair->low, pair->high};
  if (!is_in_travel(Axis::x, at.x) || !is_in_travel(Axis::y, at.y)) {
    error(reader, key.name,
          fmt::format("{} is [{:g}, {:g}], outside the travel", reader.full_name(key.name), at.x, at.y),
          "X and Y in machine coordinates, within the travel of both axes");
  }
  return at;
}

void ToolChangeReader::check_height(TableReader& reader, const NumberKey& key, double z) {
  if (is_in_travel(Axis::z, z)) return;
  const AxisDescription& axis_z = *axis(Axis::z);
  error(reader, key.name, fmt::format("{} needs Z{:g}, outside the travel", reader.full_name(key.name), z),
        fmt::format("machine coordinates, within Z{:g} to Z{:g}", axis_z.travel_low, axis_z.travel_high));
}

void ToolChangeReader::check_speed(const NumberKey& key, MmPerSecond speed, MmPerSecond most, std::string_view than) {
  if (speed <= most || most == MmPerSecond(0)) return;
  error(reader_, key.name, fmt::format("{} is {:g}", reader_.full_name(key.name), speed.value()),
        fmt::format("{:g} or less, {}", most.value(), than));
}

void ToolChangeReader::read_rack(TableReader& rack) {
  ToolRack& read = plan_.rack;
  if (const auto pockets = rack.whole_number(pockets_key, Need::required)) {
    read.pockets = static_cast<std::int32_t>(*pockets);
  }
  if (const auto first = place(rack, first_key, Need::required)) read.first = *first;
  if (const auto step = rack.low_high(step_key, Need::required)) read.step = {step->low, step->high};
  if (const auto entry = rack.low_high(entry_key, Need::optional)) read.entry = {entry->low, entry->high};
  if (const auto z = rack.number(rack_z_key, Need::required)) {
    read.z = *z;
    check_height(rack, rack_z_key, *z);
    if (*z >= plan_.safe_z && reader_.has(safe_z_key.name)) {
      error(rack, rack_z_key.name, fmt::format("the pockets at Z{:g} are not below safe_z_mm = {:g}", *z, plan_.safe_z),
            "a lower Z, or a higher safe_z_mm");
    }
  }
  if (const auto feed = rack.number(rack_feed_key, Need::required)) read.feed = MmPerSecond(*feed);
  read.opens = static_cast<ColletOutput>(word_of(rack, "opens_with", {"mist", "flood"}, Need::required));
  read.wait = Seconds(rack.number(wait_key, Need::optional).value_or(1));
  check_pockets(rack);
}

void ToolChangeReader::check_pockets(TableReader& rack) {
  const ToolRack& read = plan_.rack;
  if (read.pockets == 0) return;
  const MachineXy last{read.first.x + read.step.x * (read.pockets - 1),
                       read.first.y + read.step.y * (read.pockets - 1)};
  for (const MachineXy& pocket : {read.first, last}) {
    for (const MachineXy& at : {pocket, MachineXy{pocket.x + read.entry.x, pocket.y + read.entry.y}}) {
      if (is_in_travel(Axis::x, at.x) && is_in_travel(Axis::y, at.y)) continue;
      return error(rack, step_key.name, fmt::format("the rack needs X{:g} Y{:g}, outside the travel", at.x, at.y),
                   "pockets and their entries within the travel: first_mm, step_mm, entry_mm, pockets");
    }
  }
  if (read.pockets > 1 && read.step == MachineXy{}) {
    error(rack, step_key.name, "all pockets are at the same place", "the way from a pocket to the next one");
  }
}

}  // namespace

std::shared_ptr<const ToolChangePlan> read_tool_change(const TomlEntry& entry, const std::vector<AxisDescription>& axes,
                                                       const TomlReporter& reporter,
                                                       const std::function<void(TableReader&)>& end) {
  const TomlTable& table = std::get<TomlTable>(entry.value.content);
  TableReader reader(table, "tool_change", entry.place, reporter);
  const TomlEntry* const rack = reader.table("rack", "a table [tool_change.rack]", Need::optional);
  std::optional<TableReader> own;
  if (rack != nullptr) {
    own.emplace(std::get<TomlTable>(rack->value.content), reader.full_name("rack"), rack->place, reporter);
  }
  const TomlEntry* const macro = find(table, "macro");
  auto plan = ToolChangeReader(reader, own ? &*own : nullptr, macro != nullptr ? &macro->value : nullptr, axes).read();
  end(reader);
  if (own) end(*own);
  return plan;
}

}  // namespace passo
