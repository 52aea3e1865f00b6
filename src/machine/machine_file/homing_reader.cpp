#include "homing_reader.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "machine_file_sentences.hpp"
#include <fmt/format.h>

#include "passo/toml/toml_sentences.hpp"

namespace passo {
namespace {

struct HomeKeys {
  const char* unit;
  NumberKey switch_at;
  NumberKey seek;
  NumberKey latch;
  NumberKey pull_off;
  NumberKey hysteresis;
};
constexpr HomeKeys linear_homing{
    .unit = "mm",
    .switch_at = {"switch_at_mm", -1e5, 1e5, "-152"},
    .seek = {"seek_mm_s", 1e-3, 1e5, "20"},
    .latch = {"latch_mm_s", 1e-3, 1e5, "1"},
    .pull_off = {"pull_off_mm", 1e-3, 1e3, "2"},
    .hysteresis = {"hysteresis_mm", 0, 100, "0.05"},
};
constexpr HomeKeys rotary_homing{
    .unit = "deg",
    .switch_at = {"switch_at_deg", -1e7, 1e7, "-182"},
    .seek = {"seek_deg_s", 1e-3, 1e5, "20"},
    .latch = {"latch_deg_s", 1e-3, 1e5, "1"},
    .pull_off = {"pull_off_deg", 1e-3, 1e3, "2"},
    .hysteresis = {"hysteresis_deg", 0, 100, "0.05"},
};
struct SecondKeys {
  NumberKey square;
  NumberKey most_skew;
  NumberKey skew;
};
constexpr SecondKeys linear_second_keys{
    .square = {"square_mm", -100, 100, "0.15"},
    .most_skew = {"most_skew_mm", 0.01, 100, "5"},
    .skew = {"skew_mm", -100, 100, "0.8"},
};
constexpr SecondKeys rotary_second_keys{
    .square = {"square_deg", -100, 100, "0.15"},
    .most_skew = {"most_skew_deg", 0.01, 100, "5"},
    .skew = {"skew_deg", -100, 100, "0.8"},
};
constexpr NumberKey bounce_key{"bounce_ms", 0, 100, "5"};
constexpr NumberKey input_key{"input", 0, most_motors - 1, "0"};

const char* const homing_code = "machine.homing";

void check_speed(const TableReader& reader, const NumberKey& key, MmPerSecond speed, MmPerSecond most,
                 std::string_view than) {
  if (speed <= most || most == MmPerSecond(0)) return;
  reader.error(
      homing_code, key.name,
      toml_says::key_is.with({{"key", reader.full_name(key.name)}, {"value", fmt::format("{:g}", speed.value())}}),
      fmt::format("{:g} or less, {}", most.value(), than));
}

void check_rest(const TableReader& reader, const HomeKeys& keys, const HomeDescription& home,
                const AxisDescription& axis) {
  if (home.rest() >= axis.travel_low && home.rest() <= axis.travel_high) return;
  reader.error(homing_code, keys.switch_at.name,
               machine_file_says::has_left_travel.with({{"key", reader.full_name(keys.switch_at.name)},
                                                        {"value", fmt::format("{:g}", home.switch_at)},
                                                        {"off", fmt::format("{:g} {}", home.pull_off, keys.unit)},
                                                        {"low", fmt::format("{:g}", axis.travel_low)},
                                                        {"high", fmt::format("{:g}", axis.travel_high)}}),
               machine_file_says::switch_within_travel.with({{"key", std::string(keys.pull_off.name)}}));
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

HomingOrder one_by_one(std::vector<Axis> axes) {
  HomingOrder order{.axes = std::move(axes), .turns = {}};
  for (std::size_t i = 0; i < order.axes.size(); ++i) order.turns.push_back(static_cast<int>(i));
  return order;
}

// "Z (XY)": letters in parentheses are homed at once. Of a text that is no order: not all the axes.
HomingOrder order_of(std::string_view text) {
  HomingOrder order;
  bool together = false;
  int turn = 0;
  for (const char letter : text) {
    const auto axis = axis_of(letter);
    if (letter == '(' || letter == ')') {
      if (together == (letter == '(')) return {};
      together = letter == '(';
      ++turn;
    } else if (axis && letter_of(*axis) == letter) {
      order.axes.push_back(*axis);
      order.turns.push_back(together ? turn : ++turn);
    } else if (letter != ' ') {
      return {};
    }
  }
  return together ? HomingOrder{} : order;
}

const AxisDescription& description_of(const std::vector<AxisDescription>& axes, Axis letter) {
  return *std::ranges::find(axes, letter, &AxisDescription::axis);
}

// Axes that are homed at once are linear, and each has a switch of its own: nobody could tell which axis has closed a
// switch that they share. The same holds for the two motors of an axis.
bool can_be_homed(const TableReader& homing, const HomingOrder& order, const std::vector<AxisDescription>& axes) {
  const auto refuse = [&](std::string message, std::string expected) {
    homing.error(homing_code, "order", std::move(message), std::move(expected));
    return false;
  };
  for (std::size_t i = 0; i < order.axes.size(); ++i) {
    const AxisDescription& axis = description_of(axes, order.axes[i]);
    for (std::size_t k = 0; k < i; ++k) {
      if (order.turns[k] != order.turns[i]) continue;
      const AxisDescription& other = description_of(axes, order.axes[k]);
      const std::string both = fmt::format("{} and {}", letter_of(other.axis), letter_of(axis.axis));
      if (is_rotary(axis.axis) || is_rotary(other.axis)) {
        return refuse(both + " are homed together, but one of them is rotary", "only linear axes in parentheses");
      }
      if ((axis.home_switches() & other.home_switches()) != 0) {
        return refuse(both + " are homed together, but share a limit switch",
                      "one after the other, without parentheses");
      }
    }
  }
  return true;
}

}  // namespace

std::optional<HomeDescription> read_home(TableReader& reader, const AxisDescription& axis) {
  const HomeKeys& keys = is_rotary(axis.axis) ? rotary_homing : linear_homing;
  const auto high = reader.is_second_of(homing_code, "direction", "low", "high", Need::required);
  const auto switch_at = reader.number(keys.switch_at, Need::required);
  const auto seek = reader.number(keys.seek, Need::required);
  const auto latch = reader.number(keys.latch, Need::required);
  const auto pull_off = reader.number(keys.pull_off, Need::required);
  const auto input = reader.whole_number(input_key, Need::optional);
  const auto hysteresis = reader.number(keys.hysteresis, Need::optional);
  const auto bounce = reader.number(bounce_key, Need::optional);
  if (!high || !switch_at || !seek || !latch || !pull_off) return std::nullopt;
  HomeDescription home{.toward_high = *high,
                       .switch_at = *switch_at,
                       .seek = MmPerSecond(*seek),
                       .latch = MmPerSecond(*latch),
                       .pull_off = *pull_off};
  if (input) home.input = static_cast<int>(*input);
  if (hysteresis) home.hysteresis = *hysteresis;
  if (bounce) home.bounce = Seconds(*bounce * 1e-3);
  check_speed(reader, keys.seek, home.seek, axis.velocity, "the axis's velocity");
  check_speed(reader, keys.latch, home.latch, home.seek, "at most the seek speed");
  if (axis.travel_low < axis.travel_high) check_rest(reader, keys, home, axis);
  return home;
}

std::optional<SecondMotor> read_second_motor(TableReader& reader, const AxisDescription& axis) {
  const SecondKeys& keys = is_rotary(axis.axis) ? rotary_second_keys : linear_second_keys;
  SecondMotor second{.inverted = reader.flag("inverted").value_or(axis.inverted)};
  const auto input = reader.whole_number(input_key, Need::optional);
  if (input) second.input = static_cast<int>(*input);
  second.square = reader.number(keys.square, Need::optional).value_or(0);
  second.most_skew = reader.number(keys.most_skew, Need::optional).value_or(second.most_skew);
  second.skew = reader.number(keys.skew, Need::optional).value_or(0);
  if (std::abs(second.square) <= second.most_skew) return second;
  reader.error(homing_code, keys.square.name,
               toml_says::key_is.with(
                   {{"key", reader.full_name(keys.square.name)}, {"value", fmt::format("{:g}", second.square)}}),
               fmt::format("at most {:g} in either direction, {}", second.most_skew, keys.most_skew.name));
  return std::nullopt;
}

HomingOrder read_homing_order(TableReader* homing, const std::vector<AxisDescription>& axes, bool complete) {
  const HomingOrder usual = one_by_one(usual_order(axes));
  if (homing == nullptr) return usual;
  std::string letters;
  for (const Axis axis : usual.axes) letters += letter_of(axis);
  const auto text = homing->text("order", letters.empty() ? "ZXY" : letters, Need::optional);
  if (!text || !complete) return usual;
  HomingOrder order = order_of(*text);
  if (!std::ranges::is_permutation(order.axes, usual.axes)) {
    homing->error(homing_code, "order",
                  toml_says::key_is.with({{"key", "homing.order"}, {"value", fmt::format("\"{}\"", *text)}}),
                  letters.empty() ? "a table [axis.X.home] for each of them"
                                  : fmt::format("each axis with a table [axis.X.home] once: the letters {}", letters));
    return usual;
  }
  return can_be_homed(*homing, order, axes) ? order : usual;
}

}  // namespace passo
