#include "park_reader.hpp"

#include <algorithm>
#include <array>

#include "machine_file_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using AtEnd = ParkDescription::AtEnd;

const char* const park_code = "machine.park";
constexpr NumberKey place_key{"place_mm", -1e5, 1e5, "[10, 190]"};
constexpr std::string_view end_key = "at_end";
constexpr std::array<std::string_view, 3> end_words{"stay", "rise", "park"};  // in the order of AtEnd

const AxisDescription* find_axis(const std::vector<AxisDescription>& axes, Axis axis) {
  const auto found = std::ranges::find(axes, axis, &AxisDescription::axis);
  return found == axes.end() ? nullptr : &*found;
}

std::optional<Point> read_place(TableReader& reader, const std::vector<AxisDescription>& axes) {
  if (!reader.has(place_key.name)) return {};
  const auto given = reader.low_high(place_key, Need::optional);
  if (!given) return {};
  Point place;
  place[Axis::x] = given->low;
  place[Axis::y] = given->high;
  for (const Axis axis : {Axis::x, Axis::y}) {
    const AxisDescription* const found = find_axis(axes, axis);
    if (found == nullptr) {
      reader.error(park_code, place_key.name, machine_file_says::park_without_plane, "a machine with the axes X and Y");
      return {};
    }
    if (place[axis] >= found->travel_low && place[axis] <= found->travel_high) continue;
    reader.error(park_code, place_key.name,
                 machine_file_says::park_outside.with(
                     {{"axis", std::string(1, letter_of(axis))}, {"place", fmt::format("{:g}", place[axis])}}),
                 fmt::format("{:g} to {:g}, the travel of {}", found->travel_low, found->travel_high, letter_of(axis)));
    return {};
  }
  return place;
}

AtEnd read_end(TableReader& reader) {
  const auto word = reader.text(end_key, "park", Need::optional);
  if (!word) return AtEnd::stay;
  const auto* const found = std::ranges::find(end_words, *word);
  if (found != end_words.end()) return static_cast<AtEnd>(found - end_words.begin());
  reader.error(park_code, end_key, fmt::format("{} = \"{}\"", reader.full_name(end_key), word->substr(0, 40)),
               "\"stay\", \"rise\" or \"park\"");
  return AtEnd::stay;
}

}  // namespace

ParkDescription read_park(TableReader& reader, const std::vector<AxisDescription>& axes) {
  ParkDescription park;
  park.place = read_place(reader, axes);
  park.at_end = read_end(reader);
  if (park.at_end == AtEnd::park && !reader.has(place_key.name)) {
    reader.error(park_code, end_key, machine_file_says::park_without_place, "place_mm = [X, Y], the park position");
  }
  if (park.at_end != AtEnd::stay && find_axis(axes, Axis::z) == nullptr && !axes.empty()) {
    reader.error(park_code, end_key, machine_file_says::end_without_z, "at_end = \"stay\"");
  }
  return park;
}

}  // namespace passo
