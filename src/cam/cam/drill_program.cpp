#include "passo/cam/drill_program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/program_text.hpp"

namespace passo {
namespace {

std::int64_t passes_of(const DrillProgramOptions& options) {
  return std::max<std::int64_t>(1, (-options.depth.count + options.mill_step.count - 1) / options.mill_step.count);
}

// A circle begins and ends at its right.
DrawnPoint start_of(const DrillTarget& target) {
  const DrawnPoint first = target.points.front().at;
  return target.kind == DrillTarget::Kind::circle ? DrawnPoint{first.x + target.radius, first.y} : first;
}

class DrillProgram {
 public:
  DrillProgram(const DrillPlan& plan, const DrillProgramOptions& options)
      : plan_(plan), options_(options), text_(options.units) {}

  std::string write() {
    begin();
    for (std::size_t i = 0; i < plan_.tools.size(); ++i) write_tool(plan_.tools[i], i + 1);
    text_.end(options_.spindle.has_value(), parked(!options_.change.ends_in_place), change_height());
    return text_.take();
  }

 private:
  template <class... T>
  void line(fmt::format_string<T...> words, T&&... values) {
    text_.line(words, std::forward<T>(values)...);
  }
  void begin();
  void write_tool(const DrillTool& tool, std::size_t number);
  static bool may_stay_low(const DrillTarget& target, const DrillTarget& next);
  void drill(const DrillTarget& target, bool is_first, bool stays_low);
  void drill_by_moves(const DrillTarget& target, bool stays_low);
  void mill(const DrillTarget& target, Nanometres cutter);
  void mill_circle(DrawnPoint centre, Nanometres radius);
  void go_along(const std::vector<PathPoint>& points, bool is_closed, bool backwards);
  void arc(DrawnPoint from, DrawnPoint to, double bulge);
  std::vector<Nanometres> depths() const;
  std::optional<DrawnPoint> parked(bool is_parked) const {
    return is_parked ? std::optional(options_.park) : std::nullopt;
  }
  Nanometres change_height() const { return std::max(options_.change.height, options_.clearance); }
  SafeChange safe_change() const {
    SafeChange change = options_.change;
    change.height = change_height();
    return change;
  }
  Nanometres feed_height() const { return std::min(options_.clearance, options_.feed_height); }

  // Null: the drill has the feed and the speed of the others.
  const DrillFeed* feed_of(const DrillTool& tool) const {
    const auto found = std::ranges::find(options_.drill_feeds, tool.diameter, &DrillFeed::diameter);
    return tool.is_mill || found == options_.drill_feeds.end() ? nullptr : &*found;
  }

  std::string number(Nanometres length) const { return text_.number(length); }
  std::string place(DrawnPoint at) const { return text_.place(at); }
  std::string diameter_words(const DrillTool& tool) const {
    return fmt::format("{} {} {}", tool.is_mill ? "mill" : "drill", number(tool.diameter), text_.unit_name());
  }

  const DrillPlan& plan_;
  const DrillProgramOptions& options_;
  ProgramText text_;
  bool rises_ = true;  // to the clearance height after the present hole
};

std::string contents_of(const DrillTool& tool) {
  if (tool.slots == 0) return counted(tool.holes, "hole");
  if (tool.holes == 0) return counted(tool.slots, "slot");
  return counted(tool.holes, "hole") + ", " + counted(tool.slots, "slot");
}

void DrillProgram::begin() {
  line("({}: holes, by passo cam drill)", in_comment(options_.name));
  for (const std::string& file : options_.files) line("(from {})", in_comment(file));
  for (std::size_t i = 0; i < plan_.tools.size(); ++i) {
    line("(tool {}: {}, {})", i + 1, diameter_words(plan_.tools[i]), contents_of(plan_.tools[i]));
  }
  line("(X0 Y0 is the drawing's zero, Z0 the face of the board)");
  for (const std::string& remark : options_.remarks) line("({})", in_comment(remark));
  text_.begin_modes();
}

void DrillProgram::write_tool(const DrillTool& tool, std::size_t number_of_tool) {
  line("");
  line("(tool {}: {}, {})", number_of_tool, diameter_words(tool), contents_of(tool));
  const DrillFeed* const own = feed_of(tool);
  const auto spindle = own != nullptr && own->spindle && options_.spindle ? own->spindle : options_.spindle;
  text_.begin_tool({number_of_tool, plan_.tools.size() == 1, diameter_words(tool), spindle,
                    parked(!options_.change.changes_in_place), safe_change()});
  // A cycle returns to the height at which it began.
  if (!tool.targets.empty()) line("G0 {}", place(start_of(tool.targets.front())));
  line("G0 Z{}", number(options_.clearance));
  line("F{}", number(tool.is_mill ? options_.mill_feed : own != nullptr ? own->feed : options_.feed));
  bool in_cycle = false;
  rises_ = true;
  for (std::size_t i = 0; i < tool.targets.size(); ++i) {
    const DrillTarget& target = tool.targets[i];
    const bool stays_low = i + 1 < tool.targets.size() && may_stay_low(target, tool.targets[i + 1]);
    const bool is_hole = target.kind == DrillTarget::Kind::hole;
    if (in_cycle && !is_hole) {
      line("G80");
      in_cycle = false;
    }
    if (!is_hole) {
      mill(target, tool.diameter);
    } else if (options_.canned) {
      drill(target, !in_cycle, stays_low);
      in_cycle = true;
    } else {
      drill_by_moves(target, stays_low);
    }
  }
  if (in_cycle) line("G80");
}

// Whether the drill goes from one hole to the next at the feed height.
bool DrillProgram::may_stay_low(const DrillTarget& target, const DrillTarget& next) {
  constexpr double farthest = 5e6;  // nm
  return target.kind == DrillTarget::Kind::hole && next.kind == DrillTarget::Kind::hole &&
         distance_nm(target.points.front().at, next.points.front().at) <= farthest;
}

void DrillProgram::drill(const DrillTarget& target, bool is_first, bool stays_low) {
  const std::string at = place(target.points.front().at);
  const bool was_rising = std::exchange(rises_, !stays_low);
  const char* const retract = stays_low ? "G99" : "G98";
  if (!is_first) {
    line("{}{}", was_rising == rises_ ? "" : fmt::format("{} ", retract), at);
    return;
  }
  const std::string heights = "Z" + number(options_.depth) + " R" + number(feed_height());
  if (options_.peck) {
    line("{} G83 {} {} Q{}", retract, at, heights, number(*options_.peck));
  } else {
    line("{} G81 {} {}", retract, at, heights);
  }
}

void DrillProgram::drill_by_moves(const DrillTarget& target, bool stays_low) {
  line("G0 {}", place(target.points.front().at));
  if (std::exchange(rises_, !stays_low) && feed_height() < options_.clearance) line("G0 Z{}", number(feed_height()));
  Nanometres down{};
  while (options_.peck && down.count - options_.peck->count > options_.depth.count) {
    down = down - *options_.peck;
    line("G1 Z{}", number(down));
    line("G0 Z{}", number(options_.clearance));
    constexpr Nanometres above{250'000};  // where the next peck's feed begins
    line("G0 Z{}", number(std::min(feed_height(), down + above)));
  }
  line("G1 Z{}", number(options_.depth));
  line("G0 Z{}", number(stays_low ? feed_height() : options_.clearance));
}

std::vector<Nanometres> DrillProgram::depths() const {
  const std::int64_t turns = passes_of(options_);
  std::vector<Nanometres> all;
  for (std::int64_t i = 1; i <= turns; ++i) {
    all.push_back({-static_cast<std::int64_t>(std::llround(static_cast<double>(-options_.depth.count) *
                                                           static_cast<double>(i) / static_cast<double>(turns)))});
  }
  return all;
}

// A helix down, and a last turn at full depth.
void DrillProgram::mill_circle(DrawnPoint centre, Nanometres radius) {
  const DrawnPoint begin{centre.x + radius, centre.y};
  const std::string turn = "I" + number({-radius.count}) + " J0";
  line("G0 {}", place(begin));
  line("G0 Z{}", number(feed_height()));
  line("G1 Z0 F{}", number(options_.feed));
  line("F{}", number(options_.mill_feed));
  for (const Nanometres depth : depths()) line("G3 {} Z{} {}", place(begin), number(depth), turn);
  line("G3 {} {}", place(begin), turn);
  line("G0 Z{}", number(options_.clearance));
}

void DrillProgram::mill(const DrillTarget& target, Nanometres cutter) {
  const DrawnPoint centre = target.points.front().at;
  if (target.kind == DrillTarget::Kind::circle) {
    // A bore wider than two cutters is cut from the middle outwards, so that no core comes loose.
    const std::int64_t first = 9 * cutter.count / 20;
    const std::int64_t farthest = std::max<std::int64_t>(1, 4 * cutter.count / 5);  // of two circles
    const bool has_core = 2 * target.radius.count > cutter.count;
    const std::int64_t inner = has_core ? (target.radius.count - first + farthest - 1) / farthest : 0;
    for (std::int64_t i = 0; i < inner; ++i) {
      mill_circle(centre, {first + (target.radius.count - first) * i / inner});
    }
    mill_circle(centre, target.radius);
    return;
  }
  line("G0 {}", place(centre));
  line("G0 Z{}", number(feed_height()));
  line("G1 Z0 F{}", number(options_.feed));
  line("F{}", number(options_.mill_feed));
  const bool is_closed = target.radius.count != 0;
  bool backwards = false;
  for (const Nanometres depth : depths()) {
    line("G1 Z{} F{}", number(depth), number(options_.feed));
    line("F{}", number(options_.mill_feed));
    go_along(target.points, is_closed, backwards);
    if (!is_closed) backwards = !backwards;
  }
  line("G0 Z{}", number(options_.clearance));
}

void DrillProgram::go_along(const std::vector<PathPoint>& points, bool is_closed, bool backwards) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const std::size_t from = backwards ? n - 1 - i : i;
    const std::size_t to = backwards ? from - 1 : from + 1;
    arc(points[from].at, points[to].at, backwards ? -points[to].bulge : points[from].bulge);
  }
  if (is_closed) arc(points[n - 1].at, points[0].at, points[n - 1].bulge);
}

void DrillProgram::arc(DrawnPoint from, DrawnPoint to, double bulge) {
  if (bulge == 0 || from == to) {
    line("G1 {}", place(to));
    return;
  }
  const DrawnPoint centre = to_centre(from, to, bulge);
  line("{} {} I{} J{}", bulge > 0 ? "G3" : "G2", place(to), number(centre.x), number(centre.y));
}

}  // namespace

DrawnPoint end_of_drilling(const DrillPlan& plan, const DrillProgramOptions& options) {
  const DrillTarget& last = plan.tools.back().targets.back();
  // An open slot is cut forwards and backwards in turn.
  const bool is_open = last.kind == DrillTarget::Kind::slot && last.radius.count == 0;
  return is_open && passes_of(options) % 2 == 1 ? last.points.back().at : start_of(last);
}

std::string write_drill_program(const DrillPlan& plan, const DrillProgramOptions& options) {
  return DrillProgram(plan, options).write();
}

}  // namespace passo
