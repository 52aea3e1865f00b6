#include "passo/cam/drill_plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/cam/bulge.hpp"
#include "passo/cam/route.hpp"

namespace passo {
namespace {

// A hole or a slot, wherever it was drawn.
struct WantedCut {
  const Drawing* drawing = nullptr;
  DrawnPoint at;
  Nanometres width;
  const DrawnPath* slot = nullptr;  // null: a hole
  std::uint32_t line = 0;
};

std::string mm_words(Nanometres length) {
  return fmt::format("{:.4g} mm", to_mm(length).value());
}

Nanometres half(Nanometres length) {
  return {length.count / 2};
}

class DrillPlanner {
 public:
  DrillPlanner(const DrillOptions& options, Diagnostics& diagnostics) : options_(options), diagnostics_(diagnostics) {}

  DrillPlan plan(const std::vector<Drawing>& drawings, const WorkProgress& progress) {
    collect(drawings);
    for (const WantedCut& cut : cuts_) give_to_a_tool(cut);
    finish();
    order_all(progress);
    return std::move(plan_);
  }

 private:
  void collect(const std::vector<Drawing>& drawings);
  void drop_doubles();
  void give_to_a_tool(const WantedCut& cut);
  void mill(const WantedCut& cut);
  void drill_slot(const WantedCut& cut, Nanometres drill);
  std::optional<Nanometres> drill_for(Nanometres width) const;
  void refuse(const WantedCut& first, std::size_t count);
  void refuse_narrow(const WantedCut& first, std::size_t count);
  void warn_of_others();
  void finish();
  void order_all(const WorkProgress& progress);
  void order(DrillTool& tool, DrawnPoint from, std::optional<DrawnPoint> to, const WorkProgress& progress) const;

  DrillTool& drill_of(Nanometres diameter) {
    DrillTool& tool = drills_[diameter];
    tool.diameter = diameter;
    return tool;
  }

  const DrillOptions& options_;
  Diagnostics& diagnostics_;
  DrillPlan plan_;
  std::vector<WantedCut> cuts_;
  std::map<Nanometres, DrillTool> drills_;
  DrillTool mill_;
  std::size_t slots_as_holes_ = 0;
  std::map<Nanometres, std::pair<Nanometres, std::size_t>> off_;     // widths made by another drill, and how many
  std::map<Nanometres, std::pair<WantedCut, std::size_t>> narrow_;   // widths that the mill would only plunge, like:
  std::map<Nanometres, std::pair<WantedCut, std::size_t>> refused_;  // widths that nothing makes: the first, how many
};

void DrillPlanner::collect(const std::vector<Drawing>& drawings) {
  std::size_t lines = 0;
  for (const Drawing& drawing : drawings) {
    for (const DrawnHole& hole : drawing.holes) {
      cuts_.push_back({.drawing = &drawing, .at = hole.at, .width = hole.diameter, .line = hole.line});
    }
    for (const DrawnPath& path : drawing.paths) {
      if (path.width.count == 0) {
        ++lines;
        continue;
      }
      cuts_.push_back({&drawing, path.points.front().at, path.width, &path, path.line});
    }
  }
  if (lines != 0) plan_.notes.push_back("ignored, because it is not a hole: " + counted(lines, "path"));
  drop_doubles();
}

// A pad is often drawn as two circles about one place, its copper and its hole.
void DrillPlanner::drop_doubles() {
  std::map<DrawnPoint, std::size_t> places;
  std::vector<WantedCut> kept;
  std::size_t doubles = 0;
  for (const WantedCut& cut : cuts_) {
    const auto [entry, is_new] =
        cut.slot == nullptr ? places.try_emplace(cut.at, kept.size()) : std::pair(places.end(), true);
    if (is_new) {
      kept.push_back(cut);
      continue;
    }
    ++doubles;
    WantedCut& first = kept[entry->second];
    const bool is_narrower = cut.width.count > 0 && (first.width.count == 0 || cut.width < first.width);
    if (is_narrower) first = cut;
  }
  cuts_ = std::move(kept);
  if (doubles == 0) return;
  plan_.notes.push_back(fmt::format("{} on others; at each point only the narrowest is made",
                                    doubles == 1 ? "a hole lies" : fmt::format("{} holes lie", doubles)));
}

std::optional<Nanometres> DrillPlanner::drill_for(Nanometres width) const {
  if (options_.one_drill) return options_.one_drill;
  if (width.count == 0) return std::nullopt;
  if (options_.rack.empty()) {
    const bool is_milled = options_.mill && width > *options_.mill + options_.tolerance;
    return is_milled ? std::nullopt : std::optional(width);
  }
  const auto off = [width](Nanometres drill) { return std::abs(drill.count - width.count); };
  const Nanometres best = *std::ranges::min_element(options_.rack, {}, off);
  return off(best) <= options_.tolerance.count ? std::optional(best) : std::nullopt;
}

void DrillPlanner::give_to_a_tool(const WantedCut& cut) {
  if (diagnostics_.full()) return;
  const bool mills =
      options_.mill && !options_.one_drill && cut.width.count + options_.tolerance.count >= options_.mill->count;
  // A plunge, instead of the helix that the job asks for: and an end mill may have no teeth at its centre.
  const bool is_bore = options_.in_job && options_.mill && !options_.one_drill && cut.width.count > 0;
  if (is_bore && !(cut.slot != nullptr && mills) && cut.width <= *options_.mill + options_.tolerance) {
    ++narrow_.try_emplace(cut.width, cut, 0U).first->second.second;
    return;
  }
  if (cut.slot != nullptr && mills) {
    mill(cut);
    return;
  }
  const std::optional<Nanometres> drill = drill_for(cut.width);
  if (!drill) {
    if (mills) {
      mill(cut);
    } else {
      const auto [entry, is_new] = refused_.try_emplace(cut.width, cut, 0U);
      ++entry->second.second;
    }
    return;
  }
  if (*drill != cut.width && cut.width.count != 0) {
    auto& [used, count] = off_[cut.width];
    used = *drill;
    ++count;
  }
  if (cut.slot != nullptr) {
    drill_slot(cut, *drill);
    return;
  }
  DrillTool& tool = drill_of(*drill);
  tool.targets.push_back({.kind = DrillTarget::Kind::hole, .points = {{cut.at}}, .radius = {}});
  ++tool.holes;
}

// The sides of a straight slot are two lines and two half circles about its ends.
std::vector<PathPoint> sides_of(const DrawnPath& slot, double radius_nm) {
  const DrawnPoint a = slot.points[0].at;
  const DrawnPoint b = slot.points[1].at;
  const double length = distance_nm(a, b);
  const double across_x = length > 0 ? -static_cast<double>(b.y.count - a.y.count) / length * radius_nm : 0;
  const double across_y = length > 0 ? static_cast<double>(b.x.count - a.x.count) / length * radius_nm : radius_nm;
  const auto beside = [&](DrawnPoint at, double side) {
    return DrawnPoint{{at.x.count + std::llround(side * across_x)}, {at.y.count + std::llround(side * across_y)}};
  };
  return {{beside(a, -1), 0}, {beside(b, -1), 1}, {beside(b, 1), 0}, {beside(a, 1), 1}};
}

void DrillPlanner::mill(const WantedCut& cut) {
  const Nanometres radius = half({std::max<std::int64_t>(0, cut.width.count - options_.mill->count)});
  const bool is_as_wide = 2 * radius.count <= options_.tolerance.count;
  if (cut.slot == nullptr) {
    ++mill_.holes;
    const auto kind = is_as_wide ? DrillTarget::Kind::hole : DrillTarget::Kind::circle;
    mill_.targets.push_back({.kind = kind, .points = {{cut.at}}, .radius = is_as_wide ? Nanometres{} : radius});
    return;
  }
  ++mill_.slots;
  const bool is_straight = cut.slot->points.size() == 2 && cut.slot->points[0].bulge == 0;
  if (is_as_wide) {
    mill_.targets.push_back({.kind = DrillTarget::Kind::slot, .points = cut.slot->points, .radius = {}});
  } else if (is_straight) {
    mill_.targets.push_back({.kind = DrillTarget::Kind::slot,
                             .points = sides_of(*cut.slot, static_cast<double>(radius.count)),
                             .radius = radius});
  } else {
    --mill_.slots;
    diagnostics_.add({.code = "drill.bent-slot",
                      .file = cut.drawing->file,
                      .place = {cut.line, cut.line == 0 ? 0U : 1U, 1},
                      .message = fmt::format("this bent slot is {} wide, but the cutter is {}", mm_words(cut.width),
                                             mm_words(*options_.mill)),
                      .expected = "a cutter as wide as the slot: --mill",
                      .text = ""});
  }
}

// A row of holes half a drill apart: between two of them stays a bridge of a few hundredths of the drill, or none.
void DrillPlanner::drill_slot(const WantedCut& cut, Nanometres drill) {
  DrillTool& tool = drill_of(drill);
  ++tool.slots;
  ++slots_as_holes_;
  const std::vector<PathPoint>& points = cut.slot->points;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const DrawnPoint a = points[i].at;
    const DrawnPoint b = points[i + 1].at;
    const double way = way_nm(a, b, points[i].bulge);
    const double step = std::max(1.0, static_cast<double>(drill.count) / 2);
    constexpr double most_holes = 10'000;
    const auto count = static_cast<std::size_t>(std::clamp(std::ceil(way / step), 1.0, most_holes));
    for (std::size_t k = i == 0 ? 0 : 1; k <= count; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(count);
      const DrawnPoint at = point_along(a, b, points[i].bulge, share);
      tool.targets.push_back({.kind = DrillTarget::Kind::hole, .points = {{at}}, .radius = {}});
    }
  }
}

// One finding for all holes of a width.
void DrillPlanner::refuse(const WantedCut& first, std::size_t count) {
  const bool is_known = first.width.count != 0;
  const std::string what = counted(count, "hole or slot", "holes or slots");
  std::string expected = "--drill D, to make every hole with one drill";
  if (is_known) {
    std::string rack;
    for (const Nanometres drill : options_.rack) rack += (rack.empty() ? "" : ", ") + mm_words(drill);
    expected = fmt::format("a drill of {} in --tools (now: {}), a larger --tolerance, or a narrower cutter in --mill",
                           mm_words(first.width), rack);
  }
  diagnostics_.add(
      {.code = is_known ? "drill.no-tool" : "drill.no-diameter",
       .file = first.drawing->file,
       .place = {first.line, first.line == 0 ? 0U : 1U, 1},
       .message = is_known ? fmt::format("no tool can make {} of {}; this is the first", what, mm_words(first.width))
                           : fmt::format("the file does not give the diameter of {}; this is the first", what),
       .expected = std::move(expected),
       .text = ""});
}

void DrillPlanner::refuse_narrow(const WantedCut& first, std::size_t count) {
  const std::string more = count == 1 ? "" : fmt::format(" (the first of {} of this diameter)", count);
  diagnostics_.add(
      {.code = "drill.narrow-bore",
       .file = first.drawing->file,
       .place = {first.line, first.line == 0 ? 0U : 1U, 1},
       .message = fmt::format("the {} of {} at X{:.6g} Y{:.6g} mm{} is not wider than the cutter of {}",
                              first.slot == nullptr ? "circle" : "slot", mm_words(first.width),
                              to_mm(first.at.x).value(), to_mm(first.at.y).value(), more, mm_words(*options_.mill)),
       .expected = "a narrower cutter, or kind = \"drill\" with a drill of this diameter",
       .text = ""});
}

void DrillPlanner::warn_of_others() {
  std::string others;
  std::size_t all = 0;
  Nanometres drill{};
  for (const auto& [width, use] : off_) {
    if (std::abs(width.count - use.first.count) <= options_.tolerance.count) continue;
    drill = use.first;
    all += use.second;
    others += fmt::format("{}{} of {}", others.empty() ? "" : ", ", use.second, mm_words(width));
  }
  if (all == 0) return;
  diagnostics_.add({.severity = Severity::warning,
                    .code = "drill.other-diameter",
                    .file = "",
                    .place = {},
                    .message = fmt::format("{} {} another diameter than the drill, {}: {}", counted(all, "circle"),
                                           all == 1 ? "has" : "have", mm_words(drill), others),
                    .expected = "a drill of this diameter, or kind = \"bore\" with a narrower cutter",
                    .text = ""});
}

void DrillPlanner::finish() {
  for (const auto& [width, narrow] : narrow_) refuse_narrow(narrow.first, narrow.second);
  if (options_.in_job && options_.one_drill) warn_of_others();
  for (const auto& [width, refused] : refused_) refuse(refused.first, refused.second);
  for (const auto& [width, use] : off_) {
    if (options_.one_drill) break;
    plan_.notes.push_back(fmt::format("{} of {} {} made with the drill of {}", counted(use.second, "hole"),
                                      mm_words(width), use.second == 1 ? "is" : "are", mm_words(use.first)));
  }
  if (slots_as_holes_ != 0) {
    plan_.notes.push_back(
        slots_as_holes_ == 1
            ? "a slot is drilled as a row of holes; to mill it, give --mill D"
            : fmt::format("{} slots are drilled as rows of holes; to mill them, give --mill D", slots_as_holes_));
  }
  for (auto& [diameter, tool] : drills_) plan_.tools.push_back(std::move(tool));
  if (!mill_.targets.empty()) {
    mill_.diameter = *options_.mill;
    mill_.is_mill = true;
    plan_.tools.push_back(std::move(mill_));
  }
  if (plan_.tools.empty() && !diagnostics_.any_error()) {
    diagnostics_.add({.code = "drill.no-holes",
                      .file = "",
                      .place = {},
                      .message = "there is no hole in these files",
                      .expected = "circles or points on the selected layers of a DXF file, or a drill file",
                      .text = ""});
  }
}

void DrillPlanner::order_all(const WorkProgress& progress) {
  double all = 0;
  for (const DrillTool& tool : plan_.tools) all += static_cast<double>(tool.targets.size());
  double done = 0;
  DrawnPoint at = options_.link.from(options_.park);
  for (DrillTool& tool : plan_.tools) {
    const double before = std::exchange(done, done + static_cast<double>(tool.targets.size()));
    const std::optional<DrawnPoint> to = options_.link.to(options_.park, &tool == &plan_.tools.back());
    order(tool, at, to, progress.part(before / all, done / all));
    at = to.value_or(tool.targets.empty() ? at : tool.targets.back().points.front().at);
  }
}

// Each target counts as the place where it begins: an open slot is short beside the ways between.
void DrillPlanner::order(DrillTool& tool, DrawnPoint from, std::optional<DrawnPoint> to,
                         const WorkProgress& progress) const {
  std::vector<DrawnPoint> places;
  for (const DrillTarget& target : tool.targets) places.push_back(target.points.front().at);
  std::vector<std::uint32_t> given(places.size());
  for (std::uint32_t i = 0; i < given.size(); ++i) given[i] = i;
  tool.rapids_before_nm = route_length(places, given, from, to);
  constexpr std::uint64_t enough_a_place = 20'000;
  const std::uint64_t steps = std::min(options_.route_steps, enough_steps(places.size(), enough_a_place));
  std::vector<std::uint32_t> best = shorten_route(places, from, to, steps, progress);
  tool.rapids_after_nm = route_length(places, best, from, to);
  if (tool.rapids_after_nm > tool.rapids_before_nm) {  // the file's own order is better
    best = given;
    tool.rapids_after_nm = tool.rapids_before_nm;
  }
  std::vector<DrillTarget> ordered;
  ordered.reserve(best.size());
  for (const std::uint32_t index : best) ordered.push_back(std::move(tool.targets[index]));
  tool.targets = std::move(ordered);
}

}  // namespace

DrillPlan plan_drilling(const std::vector<Drawing>& drawings, const DrillOptions& options, Diagnostics& diagnostics,
                        const WorkProgress& progress) {
  return DrillPlanner(options, diagnostics).plan(drawings, progress);
}

}  // namespace passo
