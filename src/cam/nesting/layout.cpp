#include "layout.hpp"

#include <algorithm>

namespace passo::nesting {

bool Layout::is_better_than(const Layout& other) const {
  if (sheets.size() != other.sheets.size()) return sheets.size() < other.sheets.size();
  if (length != other.length) return length < other.length;
  return height < other.height;
}

// Half and quarter turns are exact. Then only the difference of the two turns counts: the polygon of the unturned
// resting shape is turned with it.
const Polygons& LayoutMaker::no_fit(const LaidCopy& resting, std::uint32_t shape, std::uint8_t turn) {
  const std::array<std::uint32_t, 4> key = {resting.shape, resting.turn, shape, turn};
  if (const auto found = no_fits_.find(key); found != no_fits_.end()) return found->second;
  const bool turns_with = rotations_ == 2 || rotations_ == 4;
  Polygons polygons;
  if (turns_with && resting.turn != 0) {
    const auto relative = static_cast<std::uint8_t>((turn + rotations_ - resting.turn) % rotations_);
    polygons = turned(no_fit({resting.shape, 0, {}}, shape, relative), shapes_[shape].turns[resting.turn].degrees);
  } else {
    polygons = no_fit_polygon(shapes_[resting.shape].turns[resting.turn].grown, shapes_[shape].turns[turn].grown);
  }
  return no_fits_.emplace(key, std::move(polygons)).first->second;
}

const Polygons& LayoutMaker::free_places(std::uint32_t shape, std::uint8_t turn) {
  FreePlaces& free = free_[shape][turn];
  if (!free.is_begun) {
    free.is_begun = true;
    free.polygons = shapes_[shape].turns[turn].free;
  }
  if (free.applied == sheet_.size() || free.polygons.empty()) return free.polygons;
  std::vector<Blocked> blocked;
  for (; free.applied < sheet_.size(); ++free.applied) {
    const LaidCopy& copy = sheet_[free.applied];
    blocked.push_back({&no_fit(copy, shape, turn), copy.at});
    work_ += static_cast<double>(corner_count(*blocked.back().polygons));
  }
  work_ += static_cast<double>(corner_count(free.polygons));
  free.polygons = without(free.polygons, blocked);
  return free.polygons;
}

void LayoutMaker::consider(std::uint32_t shape, std::uint8_t turn, PlaceRule rule, Place& best, bool& is_found) {
  const TurnedShape& turned = shapes_[shape].turns[turn];
  if (!turned.fits) return;
  const Extent& places = turned.places;
  for (const auto& path : free_places(shape, turn)) {
    for (const Spot& corner : path) {
      const Spot at{std::clamp(corner.X, places.least.X, places.most.X),
                    std::clamp(corner.Y, places.least.Y, places.most.Y)};
      const ClipperLib::cInt right = std::max(used_.X, at.X + turned.extent.most.X);
      const ClipperLib::cInt top = at.Y + turned.extent.most.Y;
      const ClipperLib::cInt left = at.X + turned.extent.least.X;
      Place place{.copy = {shape, turn, at}};
      if (rule == PlaceRule::right) {
        place.score = {right, top, left, turn};
      } else if (rule == PlaceRule::left) {
        place.score = {left, top, right, turn};
      } else if (rule == PlaceRule::corner) {
        place.score = {left + at.Y + turned.extent.least.Y, right, top, turn};
      } else {
        place.score = {2 * right + std::max(used_.Y, top), left, top, turn};
      }
      if (is_found && !(place.score < best.score)) continue;
      best = place;
      is_found = true;
    }
  }
}

void LayoutMaker::begin_sheet() {
  sheet_.clear();
  used_ = {};
  free_.clear();
  for (const ShapeToNest& shape : shapes_) free_.emplace_back(shape.turns.size());
}

void LayoutMaker::put(const LaidCopy& copy) {
  const Extent& extent = shapes_[copy.shape].turns[copy.turn].extent;
  used_ = {std::max(used_.X, copy.at.X + extent.most.X), std::max(used_.Y, copy.at.Y + extent.most.Y)};
  sheet_.push_back(copy);
}

Layout LayoutMaker::lay(const std::vector<LayoutItem>& sequence, PlaceRule rule) {
  Layout layout;
  work_ = 0;
  std::vector<LayoutItem> left = sequence;
  while (!left.empty()) {
    begin_sheet();
    std::vector<LayoutItem> later;
    for (const LayoutItem& item : left) {
      Place best;
      bool is_found = false;
      const auto turns = static_cast<std::uint8_t>(shapes_[item.shape].turns.size());
      for (std::uint8_t turn = 0; turn < turns; ++turn) {
        if (item.turn != any_turn && item.turn != turn) continue;
        consider(item.shape, turn, rule, best, is_found);
      }
      if (is_found) {
        put(best.copy);
      } else {
        later.push_back(item);
      }
    }
    // Every item fits on an empty sheet.
    if (later.size() == left.size()) break;
    layout.sheets.push_back(std::move(sheet_));
    layout.length = used_.X;
    layout.height = used_.Y;
    left = std::move(later);
  }
  layout.work = work_;
  return layout;
}

}  // namespace passo::nesting
