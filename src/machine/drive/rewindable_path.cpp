#include "passo/drive/rewindable_path.hpp"

#include <utility>

#include "passo/base/ensure.hpp"

namespace passo {

bool RewindablePath::next(PathItem& item) {
  if (!keeps_) return path_.next(item);
  for (; left_out_ > 0; --left_out_) {
    if (!pull(item)) return false;
  }
  if (next_ == first_ + kept_.size()) {
    if (!pull(item)) return false;
    auto* segment = std::get_if<Segment>(&item);
    const Mm left_out = std::exchange(left_out_of_item_, Mm(0));
    if (segment != nullptr && left_out > Mm(0)) segment->drop_before(left_out);
    kept_.push_back(item);
  } else {
    item = kept_[next_ - first_];
  }
  if (next_ == rewound_.item) {
    auto* segment = std::get_if<Segment>(&item);
    const bool begun = segment != nullptr && rewound_.s > Mm(0);
    if (begun) segment->drop_before(rewound_.s);
  }
  ++next_;
  if (forgets_) forget_before(next_ - 1);
  return true;
}

// Pulls the next item, and skips segments without length.
bool RewindablePath::pull(PathItem& item) {
  do {
    if (!path_.next(item)) return false;
  } while (std::holds_alternative<Segment>(item) && !std::get<Segment>(item).curve.has_length());
  return true;
}

void RewindablePath::begin_at(const PathPosition& place, std::vector<PathItem> lead_in) {
  ensure(keeps_ && kept_.empty() && next_ == 0);
  left_out_ = first_ = next_ = place.item;
  rewound_ = place;
  if (lead_in.empty()) return;
  rewound_.s = Mm(0);
  left_out_of_item_ = place.s;
  for (PathItem& item : lead_in) kept_.push_back(std::move(item));
}

PathPosition RewindablePath::behind(const PathPosition& place, const MotionItem& motion) const {
  const PathPosition next{.item = place.item + 1};
  if (const auto* action = std::get_if<Action>(&motion)) {
    return action->kind == Action::Kind::feed_hold ? place : next;
  }
  const auto& move = std::get<PlannedMove>(motion);
  if (move.to >= move.segment.curve.length()) return next;
  return {.item = place.item, .s = place.item == rewound_.item ? rewound_.s + move.to : move.to};
}

void RewindablePath::rewind(const PathPosition& place) {
  ensure(keeps_ && place.item >= first_ && place.item <= first_ + kept_.size());
  next_ = place.item;
  rewound_ = place;
  ++rewinds_;
}

Point RewindablePath::point_at(const PathPosition& place) const {
  ensure(place.item >= first_ && place.item < first_ + kept_.size());
  const PathItem& item = kept_[place.item - first_];
  if (const auto* action = std::get_if<Action>(&item)) return action->place;
  return std::get<Segment>(item).tool_at(place.s);
}

bool RewindablePath::is_in_thread() const {
  if (next_ < first_ || next_ >= first_ + kept_.size()) return false;
  const auto* segment = std::get_if<Segment>(&kept_[next_ - first_]);
  return segment != nullptr && segment->lock == SpindleLock::place;
}

void RewindablePath::forget_before(std::uint64_t item) {
  for (; first_ < item && first_ < next_ && !kept_.empty(); ++first_) kept_.pop_front();
}

}  // namespace passo
