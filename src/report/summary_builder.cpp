#include "passo/report/summary_builder.hpp"

#include <algorithm>

#include "axis_peaks.hpp"

namespace passo {
namespace {

// The smallest box around everything that was added.
class Extents {
 public:
  void add(const Point& low, const Point& high) {
    for (const Axis axis : all_axes) {
      low_[axis] = any_ ? std::min(low_[axis], low[axis]) : low[axis];
      high_[axis] = any_ ? std::max(high_[axis], high[axis]) : high[axis];
    }
    any_ = true;
  }
  std::optional<Range> of(Axis axis) const {
    if (!any_) return std::nullopt;
    return Range{low_[axis], high_[axis]};
  }

 private:
  bool any_ = false;
  Point low_;
  Point high_;
};

}  // namespace

class SummaryBuilder::Implementation {
 public:
  explicit Implementation(std::vector<Axis> axes) : axes_(std::move(axes)) {}

  void watch(const PlannedMove& move, const Point& machine_minus_work) {
    const Segment& segment = move.segment;
    (segment.rapid ? sum_.rapid_time : sum_.cutting_time) += move.duration();
    peaks_.watch(move);
    (segment.rapid ? sum_.rapid_distance : sum_.cutting_distance) += move.to - move.from();
    add_extents(move, machine_minus_work);
    if (move.from() > Mm(0)) return;  // a later part of a segment that was counted already
    ++sum_.moves;
    if (segment.rapid) ++sum_.rapids;
    if (segment.curve.shape() == Curve::Shape::arc) ++sum_.arcs;
  }

  void watch(const Action& action, const Point& /*machine_minus_work*/) {
    if (action.kind != Action::Kind::dwell) return;
    ++sum_.dwells;
    sum_.dwell_time += action.dwell;
  }

  RunSummary summary() const {
    RunSummary summary = sum_;
    for (const Axis axis : axes_) {
      summary.axes.push_back({.axis = axis,
                              .machine_extents = machine_.of(axis),
                              .work_extents = work_.of(axis),
                              .peak_speed = MmPerSecond(peaks_.speed(axis)),
                              .peak_acceleration = MmPerSecond2(peaks_.acceleration(axis)),
                              .net_steps = {},
                              .total_steps = {},
                              .position = 0});
    }
    return summary;
  }

 private:
  // If only a part of a segment is played, adds only that part.
  void add_extents(const PlannedMove& move, const Point& machine_minus_work) {
    const Curve& whole = move.segment.curve;
    const bool is_part = move.from() > Mm(0) || move.to < whole.length();
    if (is_part && !(move.to > move.from())) return;
    const Box box = is_part ? whole.part(move.from(), move.to).extents() : whole.extents();
    machine_.add(box.low, box.high);
    work_.add(box.low - machine_minus_work, box.high - machine_minus_work);
  }

  std::vector<Axis> axes_;
  RunSummary sum_;
  Extents machine_;
  Extents work_;
  AxisPeaks peaks_;
};

SummaryBuilder::SummaryBuilder(std::vector<Axis> axes)
    : implementation_(std::make_unique<Implementation>(std::move(axes))) {}
SummaryBuilder::~SummaryBuilder() = default;

void SummaryBuilder::watch(const MotionItem& item, const Point& machine_minus_work) {
  std::visit([&](const auto& what) { implementation_->watch(what, machine_minus_work); }, item);
}

RunSummary SummaryBuilder::summary() const {
  return implementation_->summary();
}

}  // namespace passo
