// RewindablePath: a path that can be continued from an earlier position.
//
// Position in the pipeline: before the planner. The path keeps each item until the board has executed it, because after
// a broken link the machine is stopped at a position that the planner has long passed. The remainder of a started
// segment is a separate segment. Without keep() the path keeps nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// A position on the path: all items before `item` are done, and the length `s` of the curve of `item`.
struct PathPosition {
  std::uint64_t item = 0;
  Mm s{0};
  friend bool operator==(const PathPosition&, const PathPosition&) = default;
};

class RewindablePath final : public Source<PathItem> {
 public:
  explicit RewindablePath(Source<PathItem>& path) : path_(path) {}

  // Keeps items from now on. Call before the first next().
  void keep() { keeps_ = true; }
  // Skips everything before `place`, because another session has executed it. Call after keep() and before the first
  // next(). `lead_in` comes first: it leads from the current position to that point, and its last item ends in a stop.
  // Its items are counted too, so all later item numbers are greater by their count. If such a path starts inside an
  // item, s of the item is counted from that point.
  void begin_at(const PathPosition& place, std::vector<PathItem> lead_in = {});
  // Keeps only the item returned last. There will be no rewind.
  void forget_passed() { forgets_ = true; }
  // The position of the item that the next call of next() returns.
  PathPosition place() const { return {.item = next_, .s = next_ == rewound_.item ? rewound_.s : Mm(0)}; }
  [[nodiscard]] bool next(PathItem& item) override;

  // The position after a motion that begins at `place`. Valid for motion planned since the last rewind().
  PathPosition behind(const PathPosition& place, const MotionItem& motion) const;
  // From now on next() returns the path from `place` again.
  void rewind(const PathPosition& place);
  std::uint64_t rewinds() const { return rewinds_; }
  // The point at `place`. The item must have been returned and be kept.
  Point point_at(const PathPosition& place) const;
  // Returns true if the item that next() returns next is known, and is locked to the spindle's angle.
  bool is_in_thread() const;
  // The position of the item returned last.
  PathPosition last() const { return {.item = next_ - 1}; }
  // Drops the items before this one. A rewind() never goes back before it.
  void forget_before(std::uint64_t item);
  std::size_t items_kept() const { return kept_.size(); }

 private:
  Source<PathItem>& path_;
  bool pull(PathItem& item);

  bool keeps_ = false;
  bool forgets_ = false;
  Mm left_out_of_item_{0};      // of the first item after a lead-in
  std::uint64_t left_out_ = 0;  // items to skip before the first one
  std::deque<PathItem> kept_;
  std::uint64_t first_ = 0;  // number of the first item kept
  std::uint64_t rewinds_ = 0;
  std::uint64_t next_ = 0;  // number of the next item to return
  PathPosition rewound_;    // the item of which only the remainder was returned
};

}  // namespace passo
