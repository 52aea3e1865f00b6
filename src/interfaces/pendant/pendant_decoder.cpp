#include "passo/pendant/pendant_decoder.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace passo {
namespace {

using EventKind = PendantEvent::Kind;

constexpr int as_signed(std::uint8_t byte) {
  return static_cast<std::int8_t>(byte);
}

}  // namespace

bool PendantDecoder::says_no_link(std::span<const std::uint8_t> report) const {
  return !table_.no_link.empty() && std::ranges::all_of(table_.no_link, [&](const PendantTable::ByteValue& one) {
    return report[one.byte] == one.value;
  });
}

bool PendantDecoder::is_held(std::span<const std::uint8_t> report, const PendantKey& key) const {
  const PendantTable::Keys& keys = table_.keys;
  if (keys.are_bits) return (report[keys.bytes[key.number / 8]] >> (key.number % 8) & 1U) != 0;
  return std::ranges::any_of(keys.bytes, [&](std::size_t byte) { return report[byte] == key.number; });
}

// A counter that wraps: the shorter way round.
void PendantDecoder::decode_wheel(std::span<const std::uint8_t> report, std::vector<PendantEvent>& events) const {
  if (!table_.wheel) return;
  const PendantTable::Wheel& wheel = *table_.wheel;
  const std::uint8_t byte = report[wheel.byte];
  if (wheel.is_counter && last_.empty()) return;
  const int detents =
      wheel.is_counter ? as_signed(static_cast<std::uint8_t>(byte - last_[wheel.byte])) : as_signed(byte);
  if (detents != 0) events.push_back({.kind = EventKind::wheel, .number = wheel.is_reversed ? -detents : detents});
}

void PendantDecoder::decode_keys(std::span<const std::uint8_t> report, std::vector<PendantEvent>& events) const {
  if (last_.empty()) return;
  // A modifier counts for the keys that are pressed in the same report.
  const auto add = [&](bool modifiers) {
    for (const PendantKey& key : table_.keys.all) {
      if ((key.action.kind == PendantAction::Kind::modifier) != modifiers) continue;
      const bool is = is_held(report, key);
      if (is != is_held(last_, key))
        events.push_back({.kind = is ? EventKind::press : EventKind::release, .key = &key});
    }
  };
  add(true);
  add(false);
}

void PendantDecoder::decode_selectors(std::span<const std::uint8_t> report, std::vector<PendantEvent>& events) const {
  const auto is_news = [&](std::size_t byte) { return last_.empty() || last_[byte] != report[byte]; };
  if (const auto& selector = table_.axis_selector; selector && is_news(selector->byte)) {
    const auto found =
        std::ranges::find(selector->positions, report[selector->byte], &PendantTable::AxisSelector::Position::value);
    events.push_back({.kind = EventKind::axis,
                      .axis = found != selector->positions.end() ? std::optional(found->axis) : std::nullopt});
  }
  if (const auto& byte = table_.step_byte; byte && is_news(*byte)) {
    const auto found = std::ranges::find(table_.steps, report[*byte], &PendantStep::value);
    const bool is_known = found != table_.steps.end();
    events.push_back(
        {.kind = EventKind::step, .number = is_known ? static_cast<int>(found - table_.steps.begin()) : -1});
  }
  if (const auto& ring = table_.ring; ring && !last_.empty() && is_news(ring->byte)) {
    const int most = static_cast<int>(ring->shares.size());
    events.push_back({.kind = EventKind::ring, .number = std::clamp(as_signed(report[ring->byte]), -most, most)});
  }
}

std::vector<PendantEvent> PendantDecoder::decode(std::span<const std::uint8_t> report) {
  std::vector<PendantEvent> events;
  if (report.size() != table_.length || (table_.id && report.front() != *table_.id)) return events;
  if (says_no_link(report)) {
    if (has_link_) events.push_back({.kind = EventKind::link_lost});
    has_link_ = false;
    last_.clear();
    return events;
  }
  if (!has_link_) events.push_back({.kind = EventKind::link_is_back});
  has_link_ = true;
  decode_selectors(report, events);
  decode_keys(report, events);
  decode_wheel(report, events);
  last_.assign(report.begin(), report.end());
  return events;
}

std::string describe(const PendantEvent& event, const PendantTable& table) {
  switch (event.kind) {
    case EventKind::wheel: return fmt::format("wheel {:+}", event.number);
    case EventKind::ring: return fmt::format("ring {:+}", event.number);
    case EventKind::axis: return event.axis ? fmt::format("axis {}", letter_of(*event.axis)) : "axis off";
    case EventKind::step:
      if (event.number < 0) return "step: no known position";
      return fmt::format("step {:g}, {:g} %", table.steps[static_cast<std::size_t>(event.number)].step,
                         100 * table.steps[static_cast<std::size_t>(event.number)].share);
    case EventKind::press: return fmt::format("key {} pressed", event.key->name);
    case EventKind::release: return fmt::format("key {} released", event.key->name);
    case EventKind::link_lost: return "link lost";
    case EventKind::link_is_back: return "link is back";
  }
  return "";
}

}  // namespace passo
