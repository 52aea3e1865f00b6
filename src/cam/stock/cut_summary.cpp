#include "passo/stock/cut_summary.hpp"

#include <algorithm>

namespace passo {
namespace {

void raise(LargestOf& largest, double value, std::uint32_t line) {
  if (value > largest.value) largest = {value, line};
}

}  // namespace

void CutSummary::add(const MoveCut& cut) {
  ++moves_;
  volume_ += cut.volume;
  if (cut.volume > 0) ++cutting_moves_;
  find_troubles(cut);
  if (cut.move.rapid) {
    stretch_ = {};
    return;
  }
  if (cut.volume > 0) {
    cut_by_feeds_ += cut.volume;
    cutting_way_ += cut.way;
    cutting_time_ += cut.move.time.value();
    raise(depth_, cut.depth, cut.move.line);
  }
  add_to_stretch(cut);
}

void CutSummary::add_to_stretch(const MoveCut& cut) {
  const ToolShape& tool = tools_[cut.move.tool];
  if (cut.way >= tool.cutter.radius.value()) stretch_ = {};
  stretch_.way += cut.way;
  stretch_.way_level += cut.way_level;
  stretch_.time += cut.move.time.value();
  stretch_.volume += cut.volume;
  stretch_.area += cut.area;
  raise(stretch_.most, cut.volume, cut.move.line);
  if (stretch_.way < tool.cutter.radius.value()) return;
  judge(stretch_, tool);
  stretch_ = {};
}

void CutSummary::judge(const Stretch& stretch, const ToolShape& tool) {
  if (stretch.time > 0) raise(rate_, stretch.volume / stretch.time, stretch.most.line);
  // A plunge has no width.
  if (stretch.way_level < 0.5 * stretch.way) return;
  const double width = stretch.area / stretch.way_level;
  const double engagement = std::min(1.0, width / (2 * tool.cutter.radius.value()));
  raise(engagement_, engagement, stretch.most.line);
  constexpr double level = 0.999;  // 2.6 degrees
  if (engagement > heavy_engagement && stretch.way_level > level * stretch.way) heavy_way_ += stretch.way;
}

void CutSummary::find_troubles(const MoveCut& cut) {
  const ToolShape& tool = tools_[cut.move.tool];
  const bool is_deep = cut.depth > least_depth;
  const double over_flutes = tool.flute_length > Mm(0) ? cut.depth - tool.flute_length.value() : 0;
  record(CutTrouble::Kind::rapid, cut, cut.move.rapid && is_deep ? cut.depth : 0, cut.place);
  record(CutTrouble::Kind::flutes, cut, over_flutes, cut.place);
  record(CutTrouble::Kind::holder, cut, cut.holder, cut.holder_place);
  record(CutTrouble::Kind::clamp, cut, cut.clamp, cut.clamp_place);
  record(CutTrouble::Kind::below, cut, cut.below, cut.place);
}

void CutSummary::record(CutTrouble::Kind kind, const MoveCut& cut, double depth, const Vector3& place) {
  const auto index = static_cast<std::size_t>(kind);
  Going& going = going_[index];
  if (!(depth > least_depth)) {
    // A move that cuts nothing at all, as one up and down between two passes, does not end a trouble below the bottom.
    const bool goes_on = kind == CutTrouble::Kind::below && cut.volume <= 0;
    if (!goes_on) going.on = false;
    return;
  }
  const CutTrouble trouble{.kind = kind, .line = cut.move.line, .tool = cut.move.tool, .depth = depth, .place = place};
  if (!going.on) {
    const std::uint64_t before = counts_[index]++;
    going = {.on = true, .index = troubles_.size(), .kept = before < most_kept};
    if (going.kept) troubles_.push_back(trouble);
  } else if (going.kept && depth > troubles_[going.index].depth) {
    troubles_[going.index] = trouble;
  }
}

}  // namespace passo
