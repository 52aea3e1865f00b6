// Leveller: cycles that begin at a height which nobody knows.
//
// A cycle may end at the height where it began, or begin with a retract. Where the program has not said that height,
// only the cycle itself can: it stays a cycle, with the heights of the surface in its words.
#include <algorithm>

#include "leveller.hpp"
#include <fmt/format.h>

#include "passo/interpreter/is_any_of.hpp"

namespace passo {
namespace {

bool is_drilling(std::string_view code) {
  constexpr std::string_view drilling[] = {"G73", "G81", "G82", "G83", "G85", "G89"};
  return std::ranges::find(drilling, code) != std::end(drilling);
}

const Point* end_of(const Operation& operation) {
  if (const auto* rapid = std::get_if<operation::StraightTraverse>(&operation.what)) return &rapid->end;
  if (const auto* feed = std::get_if<operation::StraightFeed>(&operation.what)) return &feed->end;
  return nullptr;
}

// What a cycle is made of, beside its moves.
bool is_part_of_cycle(const Operation& operation) {
  return is_any_of<operation::Dwell, operation::SetPathMode, operation::SetMergeTolerance>(operation);
}

}  // namespace

// True: the operation is a part of a cycle that is written as a whole.
bool Leveller::keeps_cycle(const Operation& operation) {
  const FrameBlock& block = blocks_.last();
  const Point* const end = end_of(operation);
  if (end == nullptr && !is_part_of_cycle(operation)) return false;
  if (block.cycle.empty() || block.named.empty() || !block.place.empty()) {
    cycle_ = {};
    return false;
  }
  if (std::exchange(cycle_.block, block.number) != block.number) {
    read_cycle_words(block);
    const bool is_known = at_ == LevelHeight::known;
    if (block.incremental || (is_known && !(cycle_.is_kept && block.to_start))) return false;
    if (!is_drilling(block.cycle) || is_known) {
      refuse(operation, "level.height",
             fmt::format("{} begins at a height that the program has not given", block.cycle),
             "a move to a Z before the cycle");
    }
    emit_run();
    if (!std::exchange(cycle_.is_kept, true)) cycle_.began_at = at_;
    cycle_.is_open = true;
    cycle_block_ = block;
  }
  if (!cycle_.is_open) return false;
  if (end != nullptr) {
    if (std::holds_alternative<operation::StraightFeed>(operation.what)) check_lead(operation, *end);
    height_ += (*end)[Axis::z] - place_[Axis::z];
    place_ = *end;
    ++count_.moves_before;
    return true;
  }
  return true;
}

// D counts in its own block alone.
void Leveller::read_cycle_words(const FrameBlock& block) {
  for (const char letter : {'Z', 'R', 'P', 'Q', 'D'}) {
    const bool is_given = block.has(letter);
    if (!is_given && letter != 'D') continue;
    const double unit = letter == 'Z' || letter == 'P' ? 1 : block.length_unit;
    std::erase_if(cycle_.words, [letter](const auto& word) { return word.first == letter; });
    if (!is_given) continue;
    cycle_.words.emplace_back(letter, block.value(letter) * unit);
  }
}

void Leveller::end_cycle() {
  if (!std::exchange(cycle_.is_open, false)) return;
  const double surface = map_.height(place_[Axis::x], place_[Axis::y]);
  std::string words;
  for (auto [letter, value] : cycle_.words) {
    if (letter == 'R') {
      if (!cycle_block_.to_start) place_[Axis::z] = value;
      value += surface;
      if (!cycle_block_.to_start) height_ = value;
    }
    if (letter == 'Z' && wish_.holes) value += surface;
    words += fmt::format(" {}{:.5f}", letter, value);
  }
  if (cycle_block_.has('L')) words += fmt::format(" L{:g}", cycle_block_.value('L'));
  if (!wish_.holes) ++count_.holes;
  Point stands = place_;
  stands[Axis::z] = height_;
  code_.cycle(fmt::format("{} {}", cycle_block_.to_start ? "G98" : "G99", cycle_block_.cycle), words, feed_, stands,
              !cycle_block_.to_start);
  ++count_.moves_after;
  known_.add(Axis::x);
  known_.add(Axis::y);
  at_ = cycle_block_.to_start ? cycle_.began_at : LevelHeight::known;
  if (at_ == LevelHeight::known) known_.add(Axis::z);
}

}  // namespace passo
