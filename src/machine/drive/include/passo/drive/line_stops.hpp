// LineStops: a path on which motion stops after each line of the program while single block is on.
//
// Position in the pipeline: between RewindablePath, whose positions do not include these stops, and the planner. A stop
// is an action of kind feed_hold, as the planner emits it in a hold. The path is otherwise unchanged: the tool follows
// the same rounded corners.
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

  // Takes effect for the items that are pulled from now on.
  void stop_at_lines(bool wanted) { stops_ = wanted; }
  bool stops() const { return stops_; }
  [[nodiscard]] bool next(PathItem& item) override;

 private:
  bool ends_before(const PathItem& item) const;
  void record(const PathItem& item);

  RewindablePath& path_;
  std::uint64_t rewinds_ = 0;
  bool stops_ = false;
  std::optional<PathItem> waiting_;    // the item after the stop
  std::optional<std::uint32_t> line_;  // line of the motion before; empty: there was none since the last stop
  bool may_rest_ = true;               // a stop is allowed after that motion
};

}  // namespace passo
