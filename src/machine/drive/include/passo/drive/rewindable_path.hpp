// RewindablePath: a path that can be taken up again from a place that was passed already.
//
// Place on the street: before the planner. The path keeps each item until the board has executed it, because after a
// broken line the machine rests at a place that the planner has long left. The remainder of a started segment is a
// separate segment. Without keep() the path keeps nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// A place on the path: all items before `item` are done, and `s` of the curve of `item`.
struct PathPlace {
  std::uint64_t item = 0;
  Mm s{0};
  friend bool operator==(const PathPlace&, const PathPlace&) = default;
};

class RewindablePath final : public Source<PathItem> {
 public:
  explicit RewindablePath(Source<PathItem>& path) : path_(path) {}

  // Keeps items from now on. Call before the first next().
  void keep() { keeps_ = true; }
  // Leaves out all before `place`, because another session has done it. Call after keep() and before the first next().
  // `lead_in` comes first: it leads from the current position to that point, and its last item ends in a stop. Its
  // items are counted too: the numbers of what comes after it are greater by their count. If such a path starts inside
  // an item, s of the item is counted from that point.
  void begin_at(const PathPlace& place, std::vector<PathItem> lead_in = {});
  // Keeps only what was handed out last. There will be no rewind.
  void forget_passed() { forgets_ = true; }
  // The place of the item that the next call of next() gives.
  PathPlace place() const { return {.item = next_, .s = next_ == rewound_.item ? rewound_.s : Mm(0)}; }
  [[nodiscard]] bool next(PathItem& item) override;

  // The place after a motion that begins at `place`. Valid for motion planned since the last rewind().
  PathPlace behind(const PathPlace& place, const MotionItem& motion) const;
  // From now on next() hands out the path from `place` again.
  void rewind(const PathPlace& place);
  std::uint64_t rewinds() const { return rewinds_; }
  // The point at `place`. The item must have been handed out and be kept.
  Point point_at(const PathPlace& place) const;
  // True: the item that next() gives next is known, and follows the spindle by place.
  bool is_in_thread() const;
  // The place of the item handed out last.
  PathPlace last() const { return {.item = next_ - 1}; }
  // Forgets the items before this one. No rewind() goes back before it.
  void forget_before(std::uint64_t item);
  std::size_t items_kept() const { return kept_.size(); }

 private:
  Source<PathItem>& path_;
  bool pull(PathItem& item);

  bool keeps_ = false;
  bool forgets_ = false;
  Mm left_out_of_item_{0};      // of the first item after a lead-in
  std::uint64_t left_out_ = 0;  // items to leave out before the first one
  std::deque<PathItem> kept_;
  std::uint64_t first_ = 0;  // number of the first item kept
  std::uint64_t rewinds_ = 0;
  std::uint64_t next_ = 0;  // number of the next item to hand out
  PathPlace rewound_;       // the item of which only the rest was handed out
};

}  // namespace passo
