// RewindablePath: a path that can be taken up again from a place that was passed already.
//
// Stands before the planner. What was handed on is kept until the board has executed it, for after a broken line the
// machine rests at a place that the planner has long left. The rest of a segment that was begun is a segment of its
// own. Without keep() nothing is kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// Between two items of the path (those before `item` are done) and s on the curve of the one that comes.
struct PathPlace {
  std::uint64_t item = 0;
  Mm s{0};
  friend bool operator==(const PathPlace&, const PathPlace&) = default;
};

class RewindablePath final : public Source<PathItem> {
 public:
  explicit RewindablePath(Source<PathItem>& path) : path_(path) {}

  // Before the first next().
  void keep() { keeps_ = true; }
  // Also before it, of a path that is kept: all in front of that place was done in another session, and is left out.
  void begin_at(const PathPlace& place);
  // Of what next() gives.
  PathPlace place() const { return {.item = next_, .s = next_ == rewound_.item ? rewound_.s : Mm(0)}; }
  [[nodiscard]] bool next(PathItem& item) override;

  // Where the path is behind a motion that begins at `place`. Holds for what was planned since the last rewind().
  PathPlace behind(const PathPlace& place, const MotionItem& motion) const;
  // Hands out again what comes from there on.
  void rewind(const PathPlace& place);
  // Where that is; of what was handed out and is kept.
  Point point_at(const PathPlace& place) const;
  // What comes there is known, and follows the spindle by place.
  bool is_in_thread() const;
  // Of the item handed out last.
  PathPlace last() const { return {.item = next_ - 1}; }
  // There will be no way back before this item.
  void forget_before(std::uint64_t item);
  std::size_t items_kept() const { return kept_.size(); }

 private:
  Source<PathItem>& path_;
  bool pull(PathItem& item);

  bool keeps_ = false;
  std::uint64_t left_out_ = 0;  // items to leave out before the first one
  std::deque<PathItem> kept_;
  std::uint64_t first_ = 0;  // number of the first one kept
  std::uint64_t next_ = 0;   // and of the next one to hand out
  PathPlace rewound_;        // the item of which only the rest was handed out
};

}  // namespace passo
