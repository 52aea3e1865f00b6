#include "passo/report/summary_builder.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "axis_peaks.hpp"

#include "passo/geometry/only_turns.hpp"
#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/is_any_of.hpp"
#include "passo/interpreter/tool_table.hpp"
#include "passo/interpreter/used_tools.hpp"
#include "passo/path/hand_tool_change.hpp"

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
  void add(const Box& box, const Point& zero) { add(box.low - zero, box.high - zero); }
  bool any() const { return any_; }
  std::optional<Range> of(Axis axis) const {
    if (!any_) return std::nullopt;
    return Range{low_[axis], high_[axis]};
  }

 private:
  bool any_ = false;
  Point low_;
  Point high_;
};

void widen(std::optional<Range>& range, double value) {
  if (!range) range = Range{value, value};
  range->low = std::min(range->low, value);
  range->high = std::max(range->high, value);
}

// The lines whose M6 moves by itself. The operations of a line come before its path and its motion.
class ToolChangeLines {
 public:
  void watch(const Operation& operation) {
    using namespace passo::operation;
    const std::uint32_t line = operation.source.line;
    if (is_any_of<StartToolChange>(operation)) begun_ = line;
    if (begun_ == line && is_any_of<StraightTraverse, StraightProbe>(operation)) lines_.insert(line);
  }
  bool has(std::uint32_t line) const { return !lines_.empty() && lines_.contains(line); }

 private:
  std::optional<std::uint32_t> begun_;
  std::set<std::uint32_t> lines_;
};

}  // namespace

class SummaryBuilder::Implementation {
 public:
  explicit Implementation(std::vector<Axis> axes) : axes_(std::move(axes)) {}

  void watch(const Operation& operation) {
    using namespace passo::operation;
    const OperationKind& what = operation.what;
    changes_.watch(operation);
    if (is_any_of<StraightTraverse, StraightFeed, ArcFeed, NurbsFeed, RigidTap, StraightProbe>(operation)) {
      if (sum_.moves++ == 0) sum_.units = units_;
      if (is_any_of<StraightTraverse>(operation)) ++sum_.rapids;
      if (is_any_of<ArcFeed>(operation)) ++sum_.arcs;
    } else if (const auto* units = std::get_if<SetLengthUnits>(&what)) {
      units_ = units->units;
    } else if (frame_.follow(operation)) {
      return;
    } else if (const auto* tool = std::get_if<SetToolNumber>(&what)) {
      if (sum_.tools.empty()) first_tool_ = tool->tool;
    } else if (const auto* message = std::get_if<Message>(&what)) {
      note(operation, message->text, false);
    } else if (const auto* print = std::get_if<Print>(&what)) {
      note(operation, print->text, true);
    }
  }

  void watch(const PathItem& item) {
    if (const auto* action = std::get_if<Action>(&item)) {
      if (action->kind == Action::Kind::probe_begin) probes_ = true;
      if (action->kind == Action::Kind::probe_end) probes_ = false;
      if (changes_tool(*action)) path_tool_ = action->tool;
      return;
    }
    if (probes_) return;
    const auto& segment = std::get<Segment>(item);
    const Box box = frame_.work_extents(segment.curve);
    const auto system = static_cast<std::size_t>(frame_.work_system());
    WorkExtents& work = work_[system < work_.size() ? system : 0];
    work.all.add(box.low, box.high);
    if (!cuts(segment)) return;
    work.cutting.add(box.low, box.high);
    ToolSummary& tool = tool_of(path_tool_);
    widen(only_turns(segment.curve, segment.surface) ? tool.turn_feed : tool.feed, segment.speed.value());
    tool.depth = std::min(tool.depth.value_or(box.low[Axis::z]), box.low[Axis::z]);
  }

  void add_up(const PlannedMove& move) {
    const Segment& segment = move.segment;
    const bool is_cut = cuts(segment);
    (is_cut ? sum_.cutting_time : sum_.rapid_time) += move.duration();
    const Mm way = move.to - move.from();
    ToolSummary& tool = tool_of(motion_tool_);
    (is_cut ? tool.cutting_time : tool.rapid_time) += move.duration();
    if (only_turns(segment.curve, segment.surface)) {
      (is_cut ? sum_.cutting_turn : sum_.rapid_turn) += way.value();
      if (is_cut) tool.cutting_turn += way.value();
    } else {
      (is_cut ? sum_.cutting_distance : sum_.rapid_distance) += way;
      if (is_cut) tool.cutting_distance += way;
    }
  }

  void add_up(const Action& action) {
    if (changes_tool(action)) motion_tool_ = action.tool;
    if (action.kind != Action::Kind::dwell) return;
    ++sum_.dwells;
    sum_.dwell_time += action.dwell;
  }

  // Touches nothing that the other members touch, but for summary().
  void measure(const PlannedMove& move, const Point& machine_minus_work) {
    peaks_.watch(move);
    add_extents(move, machine_minus_work);
  }

  RunSummary summary() const {
    RunSummary summary = sum_;
    for (ToolSummary& tool : summary.tools) {
      if (tool.tool == before_tools) tool.tool = first_tool_;
    }
    for (const Axis axis : axes_) {
      summary.axes.push_back({.axis = axis,
                              .machine_extents = machine_.of(axis),
                              .work_extents = in_work_.of(axis),
                              .cutting_extents = cutting_.of(axis),
                              .peak_speed = MmPerSecond(peaks_.speed(axis)),
                              .peak_acceleration = MmPerSecond2(peaks_.acceleration(axis)),
                              .net_steps = {},
                              .total_steps = {},
                              .position = 0});
    }
    for (std::size_t system = 0; system < work_.size(); ++system) add_work(system, summary);
    return summary;
  }

 private:
  // The moves of a tool change touch the tool setter or the rack, not the work.
  bool cuts(const Segment& segment) const { return !segment.rapid && !changes_.has(segment.source.line); }

  struct WorkExtents {
    Extents all;
    Extents cutting;
  };
  static constexpr std::int32_t before_tools = -1;  // the tool that is in the spindle before the first change

  void note(const Operation& operation, std::string_view text, bool print) {
    if (sum_.messages.size() == RunSummary::most_messages) return;
    sum_.messages.push_back({.line = operation.source.line, .print = print, .text = std::string(text)});
  }

  ToolSummary& tool_of(std::int32_t number) {
    const auto fresh = [number] { return ToolSummary{.tool = number}; };
    return sum_.tools[index_of_tool(sum_.tools, number, &ToolSummary::tool, ToolTable::most_tools, fresh)];
  }

  void add_work(std::size_t system, RunSummary& summary) const {
    if (!work_[system].all.any()) return;
    WorkSummary work{.system = static_cast<std::uint8_t>(system)};
    for (const Axis axis : axes_) {
      work.extents.push_back(work_[system].all.of(axis));
      work.cutting.push_back(work_[system].cutting.of(axis));
    }
    summary.work.push_back(std::move(work));
  }

  // If only a part of a segment is played, adds only that part.
  void add_extents(const PlannedMove& move, const Point& machine_minus_work) {
    if (move.segment.lead) return add_box(move, move.segment.tool_curve().extents(), machine_minus_work);
    const Curve& whole = move.segment.curve;
    const bool is_part = move.from() > Mm(0) || move.to < whole.length();
    if (is_part && !(move.to > move.from())) return;
    add_box(move, is_part ? whole.part(move.from(), move.to).extents() : whole.extents(), machine_minus_work);
  }
  void add_box(const PlannedMove& move, const Box& box, const Point& machine_minus_work) {
    machine_.add(box.low, box.high);
    in_work_.add(box, machine_minus_work);
    if (cuts(move.segment)) cutting_.add(box.low, box.high);
  }

  std::vector<Axis> axes_;
  RunSummary sum_;
  Extents machine_;
  Extents cutting_;
  Extents in_work_;
  AxisPeaks peaks_;

  // As the program is read:
  LengthUnits units_ = LengthUnits::mm;
  ToolChangeLines changes_;
  Frame frame_;
  std::int32_t first_tool_ = 0;  // M61 before the first move
  // On the path, and in the motion, which comes later:
  bool probes_ = false;
  std::int32_t path_tool_ = before_tools;
  std::int32_t motion_tool_ = before_tools;
  std::array<WorkExtents, 10> work_;  // of each system; 0: of none
};

SummaryBuilder::SummaryBuilder(std::vector<Axis> axes)
    : implementation_(std::make_unique<Implementation>(std::move(axes))) {}
SummaryBuilder::~SummaryBuilder() = default;

void SummaryBuilder::watch_operation(const Operation& operation) {
  implementation_->watch(operation);
}

void SummaryBuilder::watch_path(const PathItem& item) {
  implementation_->watch(item);
}

void SummaryBuilder::watch(const MotionItem& item, const Point& machine_minus_work) {
  add_up(item);
  measure(item, machine_minus_work);
}

void SummaryBuilder::add_up(const MotionItem& item) {
  std::visit([&](const auto& what) { implementation_->add_up(what); }, item);
}

void SummaryBuilder::measure(const MotionItem& item, const Point& machine_minus_work) {
  if (const auto* move = std::get_if<PlannedMove>(&item)) implementation_->measure(*move, machine_minus_work);
}

RunSummary SummaryBuilder::summary() const {
  return implementation_->summary();
}

}  // namespace passo
