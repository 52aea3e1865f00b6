#include "homing_reader.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace passo {
namespace {

struct HomeKeys {
  const char* unit;
  NumberKey switch_at;
  NumberKey seek;
  NumberKey latch;
  NumberKey pull_off;
};
constexpr HomeKeys linear_keys{
    .unit = "mm",
    .switch_at = {"switch_at_mm", -1e5, 1e5, "-152"},
    .seek = {"seek_mm_s", 1e-3, 1e5, "20"},
    .latch = {"latch_mm_s", 1e-3, 1e5, "1"},
    .pull_off = {"pull_off_mm", 1e-3, 1e3, "2"},
};
constexpr HomeKeys rotary_keys{
    .unit = "deg",
    .switch_at = {"switch_at_deg", -1e7, 1e7, "-182"},
    .seek = {"seek_deg_s", 1e-3, 1e5, "20"},
    .latch = {"latch_deg_s", 1e-3, 1e5, "1"},
    .pull_off = {"pull_off_deg", 1e-3, 1e3, "2"},
};
constexpr NumberKey input_key{"input", 0, most_motors - 1, "0"};

const char* const homing_code = "machine.homing";

void check_speed(const TableReader& reader, const NumberKey& key, MmPerSecond speed, MmPerSecond most,
                 std::string_view than) {
  if (speed <= most || most == MmPerSecond(0)) return;
  reader.error(homing_code, key.name, fmt::format("{} is {:g}", reader.full_name(key.name), speed.value()),
               fmt::format("{:g} or less, {}", most.value(), than));
}

void check_rest(const TableReader& reader, const HomeKeys& keys, const HomeDescription& home,
                const AxisDescription& axis) {
  if (home.rest() >= axis.travel_low && home.rest() <= axis.travel_high) return;
  reader.error(homing_code, keys.switch_at.name,
               fmt::format("{} is {:g}, and {:g} {} off it the machine has left its travel of {:g} to {:g}",
                           reader.full_name(keys.switch_at.name), home.switch_at, home.pull_off, keys.unit,
                           axis.travel_low, axis.travel_high),
               fmt::format("a switch, less {}, within the travel", keys.pull_off.name));
}

bool is_homed(const AxisDescription& axis) {
  return axis.home.has_value();
}

// Axes that move the tool out of the way come first.
std::vector<Axis> usual_order(const std::vector<AxisDescription>& axes) {
  std::vector<Axis> order;
  for (const AxisDescription& axis : axes) {
    if (is_homed(axis)) order.push_back(axis.axis);
  }
  std::stable_partition(order.begin(), order.end(), [](Axis axis) { return axis == Axis::z; });
  return order;
}

}  // namespace

std::optional<HomeDescription> read_home(TableReader& reader, const AxisDescription& axis) {
  const HomeKeys& keys = is_rotary(axis.axis) ? rotary_keys : linear_keys;
  const auto high = reader.is_second_of(homing_code, "direction", "low", "high", Need::required);
  const auto switch_at = reader.number(keys.switch_at, Need::required);
  const auto seek = reader.number(keys.seek, Need::required);
  const auto latch = reader.number(keys.latch, Need::required);
  const auto pull_off = reader.number(keys.pull_off, Need::required);
  const auto input = reader.whole_number(input_key, Need::optional);
  if (!high || !switch_at || !seek || !latch || !pull_off) return std::nullopt;
  HomeDescription home{.toward_high = *high,
                       .switch_at = *switch_at,
                       .seek = MmPerSecond(*seek),
                       .latch = MmPerSecond(*latch),
                       .pull_off = *pull_off};
  if (input) home.input = static_cast<int>(*input);
  check_speed(reader, keys.seek, home.seek, axis.velocity, "the axis's velocity");
  check_speed(reader, keys.latch, home.latch, home.seek, "as fast as it seeks or slower");
  if (axis.travel_low < axis.travel_high) check_rest(reader, keys, home, axis);
  return home;
}

std::vector<Axis> read_homing_order(TableReader* homing, const std::vector<AxisDescription>& axes, bool complete) {
  const std::vector<Axis> usual = usual_order(axes);
  if (homing == nullptr) return usual;
  std::string letters;
  for (const Axis axis : usual) letters += letter_of(axis);
  const auto text = homing->text("order", letters.empty() ? "ZXY" : letters, Need::optional);
  if (!text || !complete) return usual;
  std::vector<Axis> order;
  for (const char letter : *text) {
    const auto axis = axis_of(letter);
    if (axis && letter_of(*axis) == letter) order.push_back(*axis);
  }
  if (order.size() == text->size() && std::ranges::is_permutation(order, usual)) return order;
  homing->error(homing_code, "order", fmt::format("homing.order is \"{}\"", *text),
                letters.empty()
                    ? "a table [axis.X.home] for each of them"
                    : fmt::format("each axis that has a table [axis.X.home] once: the letters {}", letters));
  return usual;
}

}  // namespace passo
