// LineStops: a path on which the motion rests after each line of the program, for as long as somebody wants that
// (single block).
//
// Place on the street: between RewindablePath, whose places do not count these rests, and the planner. A rest is an
// action of kind feed_hold, as the planner gives it in a hold. Nothing else of the path is changed: the tool takes the
// same way over rounded corners.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/base/source.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class LineStops final : public Source<PathItem> {
 public:
  explicit LineStops(RewindablePath& path) : path_(path) {}

  // Counts for the items that are pulled from now on.
  void stop_at_lines(bool wanted) { stops_ = wanted; }
  bool stops() const { return stops_; }
  [[nodiscard]] bool next(PathItem& item) override;

 private:
  bool ends_before(const PathItem& item) const;
  void record(const PathItem& item);

  RewindablePath& path_;
  std::uint64_t rewinds_ = 0;
  bool stops_ = false;
  std::optional<PathItem> waiting_;    // what comes after the rest
  std::optional<std::uint32_t> line_;  // of the motion before; empty: there was none since the last rest
  bool may_rest_ = true;               // after that motion
};

}  // namespace passo
