#include "passo/tooling/cutting_feeds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chip_tables.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr double mm_per_metre = 1000;
constexpr double usual_most_rpm = 24000;  // of a router spindle, where nothing else is known
constexpr double fewest_rpm = 100;
constexpr double half_width = 0.5;

ChipRange at_diameter(std::span<const chips::ChipRow> rows, double diameter) {
  const chips::ChipRow& first = rows.front();
  if (diameter <= first.diameter) {
    const double share = diameter / first.diameter;
    return {Mm(first.least * share), Mm(first.most * share)};
  }
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const chips::ChipRow& a = rows[i - 1];
    const chips::ChipRow& b = rows[i];
    if (diameter > b.diameter) continue;
    const double share = (diameter - a.diameter) / (b.diameter - a.diameter);
    return {Mm(std::lerp(a.least, b.least, share)), Mm(std::lerp(a.most, b.most, share))};
  }
  return {Mm(rows.back().least), Mm(rows.back().most)};
}

// Cuts twice as deep as the diameter have chips thinner by a quarter, three times as deep by half.
double share_for_depth(const CuttingTool& tool, Mm depth) {
  const double diameters = depth / tool.diameter;
  return diameters <= 1 ? 1 : std::max(0.5, 1 - 0.25 * (diameters - 1));
}

// A cone cuts with the width that it has at the depth of a pass.
Mm cutting_width(const CuttingTool& tool, Mm depth) {
  const bool is_cone = tool.shape == CuttingShape::vee || tool.shape == CuttingShape::taper;
  if (!is_cone) return tool.diameter;
  const Mm wide = depth > Mm(0) ? diameter_at(tool, depth) : tool.diameter / 2;
  return std::max(wide, tool.diameter / 100);
}

double rounded_down(double value) {
  const double step = value >= 1000 ? 10 : 1;
  return value < 1 ? value : std::floor(value / step + 1e-9) * step;
}

// Finds the numbers one after the other, each with its reason.
class FeedFinder {
 public:
  FeedFinder(const CuttingTool& tool, const FeedRequest& request)
      : tool_(tool),
        request_(request),
        table_(chips::table_of(request.material)),
        is_drill_(tool.shape == CuttingShape::drill) {}

  CuttingFeeds find() {
    find_pass();
    find_load();
    find_rpm();
    find_feed();
    find_plunge();
    return std::move(feeds_);
  }

 private:
  void tell(std::string_view of, std::string text, std::string_view source = {}) {
    feeds_.reasons.push_back({of, std::move(text), source});
  }
  void find_pass();
  void find_load();
  void find_rpm();
  void find_feed();
  void find_plunge();
  double surface_speed() const;  // m/min; 0: not limited
  double faster(double rpm);     // if the spindle cannot turn as slowly as this
  double most_rpm() const;
  const char* limit_in_words() const;  // what sets most_rpm()

  const CuttingTool& tool_;
  const FeedRequest& request_;
  const chips::MaterialTable& table_;
  bool is_drill_;
  Mm programmed_{0};  // feed per tooth
  CuttingFeeds feeds_;
};

void FeedFinder::find_pass() {
  if (is_drill_) return;
  Mm pass = request_.depth;
  if (!(pass > Mm(0))) {
    pass = tool_.diameter * table_.pass_share;
    tell("depth",
         table_.pass_share == 1 ? std::string("the diameter of the tool, as the chart assumes")
                                : fmt::format("{:g} of the diameter, a light cut", table_.pass_share),
         table_.pass_source);
    const bool is_cone = tool_.shape == CuttingShape::vee || tool_.shape == CuttingShape::taper;
    const Mm half = shape_of(tool_).cutter.height(tool_.diameter / 4);
    if (is_cone && half > Mm(0) && pass > half) {
      pass = half;
      tell("depth", "at most the depth at which the cone is half as wide as the tool");
    }
    if (tool_.flute_length > Mm(0) && pass > tool_.flute_length) {
      pass = tool_.flute_length;
      tell("depth", fmt::format("at most the flute length, {:g} mm", pass.value()));
    }
  }
  feeds_.depth_per_pass = pass;
  feeds_.step_over = half_width;
  tell("stepover", "half the diameter, which gives the chip its full thickness", chips::yeti);
}

void FeedFinder::find_load() {
  const std::string_view name = name_of(request_.material);
  feeds_.chip_range = chip_range_of(tool_, request_.material, feeds_.depth_per_pass);
  feeds_.chip_load = feeds_.chip_range.least;
  if (tool_.chip_loads.contains(request_.material)) {
    tell("chip load", fmt::format("{:.3g} mm per tooth in {}, from the tool library", feeds_.chip_load.value(), name));
  } else if (is_drill_) {
    tell("chip load",
         fmt::format("{:.3g} to {:.3g} mm per revolution for a drill of {:g} mm",
                     feeds_.chip_range.least.value() * tool_.flutes, feeds_.chip_range.most.value() * tool_.flutes,
                     tool_.diameter.value()),
         chips::protocutter);
  } else {
    const Mm width = cutting_width(tool_, feeds_.depth_per_pass);
    tell("chip load",
         fmt::format("{:.3g} to {:.3g} mm per tooth for {:.3g} mm in {}; the lower end",
                     feeds_.chip_range.least.value(), feeds_.chip_range.most.value(), width.value(), name),
         table_.source);
    if (!table_.second_source.empty()) tell("chip load", "the upper end of the range", table_.second_source);
    const double share = share_for_depth(tool_, feeds_.depth_per_pass);
    if (share < 1) {
      tell("chip load",
           fmt::format("multiplied by {:.2g}, because the pass is {:.2g} diameters deep", share,
                       feeds_.depth_per_pass / tool_.diameter),
           chips::ast);
    }
  }
  programmed_ = feeds_.chip_load;
  if (const double thin = is_drill_ ? 1 : chip_thinning(request_.width); thin < 1) {
    programmed_ = feeds_.chip_load / thin;
    tell("chip load",
         fmt::format("{:.3g} mm of feed per tooth, because the cut is {:.3g} of the diameter wide and the "
                     "chip is {:.2g} times as thick as the feed",
                     programmed_.value(), request_.width, thin),
         chips::thinning);
  }
}

double FeedFinder::most_rpm() const {
  const double spindle = request_.spindle.most_rpm > 0 ? request_.spindle.most_rpm : usual_most_rpm;
  return tool_.most_rpm ? std::min(*tool_.most_rpm, spindle) : spindle;
}

const char* FeedFinder::limit_in_words() const {
  if (tool_.most_rpm && *tool_.most_rpm <= most_rpm()) return "the limit of the tool";
  return request_.spindle.most_rpm > 0 ? "the limit of the spindle" : "the usual limit of router spindles";
}

double FeedFinder::surface_speed() const {
  return tool_.material == ToolMaterial::hss ? table_.surface_speed / 2 : table_.surface_speed;
}

double FeedFinder::faster(double rpm) {
  const double least = request_.spindle.least_rpm;
  if (rpm >= least) return rpm;
  if (tool_.most_rpm && *tool_.most_rpm < least) {
    tell("spindle",
         fmt::format("the spindle turns at {:g} rpm or more, too fast for this tool: use another one", least));
    return rpm;
  }
  tell("spindle", fmt::format("at least {:g} rpm, the limit of the spindle", least));
  const double rim = std::numbers::pi * tool_.diameter.value() * least / mm_per_metre;
  constexpr double clearly = 1.1;
  if (surface_speed() > 0 && rim > clearly * surface_speed()) {
    tell("spindle", fmt::format("the cutter is too large for this spindle: {:.0f} m/min instead of {:g} m/min; use one "
                                "of at most {:.3g} mm",
                                rim, surface_speed(), tool_.diameter.value() * surface_speed() / rim));
  }
  return least;
}

void FeedFinder::find_rpm() {
  double rpm = table_.usual_rpm > 0 ? table_.usual_rpm : most_rpm();
  std::string why = fmt::format("{:g} rpm, {}", rpm, table_.usual_rpm > 0 ? "usual for routers" : limit_in_words());
  std::string_view source = table_.usual_rpm > 0 ? chips::yeti : std::string_view();
  if (table_.surface_speed > 0) {
    const bool is_hss = tool_.material == ToolMaterial::hss;
    const double speed = surface_speed();
    const double limit = speed * mm_per_metre / (std::numbers::pi * tool_.diameter.value());
    if (limit < rpm) {
      rpm = limit;
      why = fmt::format("{:g} m/min at {:g} mm", speed, tool_.diameter.value());
      source = table_.speed_source;
      if (is_hss) tell("spindle", "half the surface speed of carbide, because the tool is HSS", chips::hss_speeds);
    }
  }
  if (request_.rpm) {
    rpm = *request_.rpm;
    why = fmt::format("{:g} rpm, as chosen", rpm);
    source = {};
  }
  tell("spindle", why, source);
  if (rpm > most_rpm()) {
    rpm = most_rpm();
    tell("spindle", fmt::format("at most {:g} rpm, {}", rpm, limit_in_words()));
  }
  rpm = faster(rpm);
  feeds_.rpm = std::max(10.0, std::floor(rpm / 10 + 1e-9) * 10);
}

void FeedFinder::find_feed() {
  const double per_turn = programmed_.value() * tool_.flutes;
  double feed = per_turn * feeds_.rpm;  // mm/min
  tell("feed", fmt::format("{:.3g} mm × {} × {:g} rpm = {:.0f} mm/min", programmed_.value(),
                           tool_.flutes == 1 ? "1 flute" : fmt::format("{} flutes", tool_.flutes), feeds_.rpm, feed));
  const MmPerSecond limit = is_drill_ ? request_.most_plunge : request_.most_feed;
  const double most = limit.value() * seconds_per_minute;
  if (most > 0 && feed > most) {
    feed = most;
    const double slow =
        std::max({std::floor(most / per_turn / 10 + 1e-9) * 10, request_.spindle.least_rpm, fewest_rpm});
    tell("feed", fmt::format("at most {:g} mm/min, the limit of the machine", most));
    if (!request_.rpm && slow < feeds_.rpm) {
      feeds_.rpm = slow;
      tell("spindle", fmt::format("{:g} rpm, so that the chip keeps its thickness at this feed", slow));
    }
  }
  feed = rounded_down(feed);
  feeds_.feed = MmPerSecond(feed / seconds_per_minute);
  const double thin = is_drill_ ? 1 : chip_thinning(request_.width);
  feeds_.chip_load = Mm(feed / (feeds_.rpm * tool_.flutes) * thin);
}

void FeedFinder::find_plunge() {
  if (is_drill_) {
    feeds_.plunge = feeds_.feed;
    tell("plunge", "the feed rate of the drill");
    return;
  }
  if (!tool_.centre_cutting) {
    tell("plunge", "none: the tool has no teeth at its centre");
    return;
  }
  constexpr double share = 0.25;
  double plunge = feeds_.feed.value() * seconds_per_minute * share;
  tell("plunge", "a quarter of the feed rate", chips::shopbot);
  const double most = request_.most_plunge.value() * seconds_per_minute;
  if (most > 0 && plunge > most) {
    plunge = most;
    tell("plunge", fmt::format("at most {:g} mm/min, the limit of the machine", most));
  }
  feeds_.plunge = MmPerSecond(rounded_down(plunge) / seconds_per_minute);
}

}  // namespace

double chip_thinning(double width) {
  const bool is_thin = width > 0 && width < half_width;
  return is_thin ? std::max(2 * std::sqrt(width * (1 - width)), 0.1) : 1;
}

ChipRange chip_range_of(const CuttingTool& tool, WorkMaterial material, Mm depth) {
  if (const auto own = tool.chip_loads.find(material); own != tool.chip_loads.end()) return {own->second, own->second};
  if (tool.shape == CuttingShape::drill) {
    const ChipRange range = at_diameter(chips::drilling, tool.diameter.value());
    return {range.least / tool.flutes, range.most / tool.flutes};
  }
  const chips::MaterialTable& table = chips::table_of(material);
  ChipRange range = at_diameter(table.rows, cutting_width(tool, depth).value());
  const double share = share_for_depth(tool, depth) / (table.is_per_turn ? tool.flutes : 1U);
  return {range.least * share, range.most * share};
}

CuttingFeeds feeds_of(const CuttingTool& tool, const FeedRequest& request) {
  return FeedFinder(tool, request).find();
}

}  // namespace passo
