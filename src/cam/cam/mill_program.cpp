#include "passo/cam/mill_program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/program_text.hpp"

namespace passo {
namespace {

class MillProgram {
 public:
  MillProgram(const MillPlan& plan, const MillProgramOptions& options)
      : plan_(plan), options_(options), text_(options.units) {}

  std::string write() {
    begin();
    for (std::size_t i = 0; i < plan_.tools.size(); ++i) {
      change_tool(i + 1);
      for (const MillRun& run : plan_.tools[i].runs) mill(run);
    }
    text_.end(options_.spindle.has_value(), parked(!options_.change.ends_in_place), change_height());
    return text_.take();
  }

 private:
  void begin();
  void change_tool(std::size_t number);
  std::optional<DrawnPoint> parked(bool is_parked) const {
    return is_parked ? std::optional(options_.park) : std::nullopt;
  }
  Nanometres change_height() const { return std::max(options_.change.height, options_.clearance); }
  SafeChange safe_change() const {
    SafeChange change = options_.change;
    change.height = change_height();
    return change;
  }
  void mill(const MillRun& run);
  void go(const MillPoint& from, const MillPoint& to);
  Nanometres feed_of(MillPace pace) const;
  Nanometres feed_along(const MillPoint& from, const MillPoint& to) const;
  void feed(Nanometres feed) {
    if (feed != feed_) text_.line("F{}", text_.number(feed));
    feed_ = feed;
  }
  // The F word of a steep descent is in the block of the move; the feed of other moves is in a block before them.
  std::string feed_word(Nanometres next) {
    if (next == options_.feed) feed(next);
    if (next == feed_) return "";
    feed_ = next;
    return " F" + text_.number(next);
  }

  const MillPlan& plan_;
  const MillProgramOptions& options_;
  ProgramText text_;
  Nanometres feed_{};
};

void MillProgram::begin() {
  text_.line("({}, by {})", in_comment(options_.name), in_comment(options_.command));
  for (const std::string& file : options_.files) text_.line("(from {})", in_comment(file));
  for (std::size_t i = 0; i < plan_.tools.size(); ++i) {
    text_.line("(tool {}: {}, {})", i + 1, in_comment(plan_.tools[i].words),
               counted(plan_.tools[i].runs.size(), "run"));
  }
  for (const std::string& remark : options_.remarks) text_.line("({})", in_comment(remark));
  text_.begin_modes();
}

void MillProgram::change_tool(std::size_t number) {
  const MillTool& tool = plan_.tools[number - 1];
  text_.line("");
  text_.begin_tool({number, plan_.tools.size() == 1, tool.words, options_.spindle,
                    parked(!options_.change.changes_in_place), safe_change()});
  feed_ = {};
}

void MillProgram::mill(const MillRun& run) {
  constexpr std::int64_t above = 500'000;  // where the feed into the board begins
  text_.line("G0 {}", text_.place(run.front().at));
  if (run.front().pace != MillPace::rapid) {
    text_.line("G0 Z{}", text_.number({std::min(options_.clearance.count, above)}));
    feed(options_.plunge_feed);
    text_.line("G1 Z{}", text_.number(run.front().z));
  }
  for (std::size_t i = 0; i + 1 < run.size(); ++i) go(run[i], run[i + 1]);
  text_.line("G0 Z{}", text_.number(options_.clearance));
}

Nanometres MillProgram::feed_of(MillPace pace) const {
  if (pace == MillPace::link) return options_.link_feed.value_or(usual_link_feed(options_.feed));
  return pace == MillPace::finish ? options_.finish_feed.value_or(options_.feed) : options_.feed;
}

// The feed of a descent into stock is reduced so that the cutter descends at the plunge feed at most.
Nanometres MillProgram::feed_along(const MillPoint& from, const MillPoint& to) const {
  const Nanometres along = feed_of(from.pace);
  const auto down = static_cast<double>(from.z.count - to.z.count);
  if (down <= 0 || from.pace == MillPace::link) return along;
  const double length = std::hypot(way_nm(from.at, to.at, from.bulge), down);
  const double most = static_cast<double>(options_.plunge_feed.count) * (length / down);
  if (most >= static_cast<double>(along.count)) return along;
  constexpr std::int64_t digits = 1'000'000;  // nm/min, so that the program has few feeds
  const auto whole = static_cast<std::int64_t>(most);
  return {whole > digits ? whole / digits * digits : whole};
}

void MillProgram::go(const MillPoint& from, const MillPoint& to) {
  const std::string place = text_.place(to.at);
  const std::string z = from.z == to.z ? "" : " Z" + text_.number(to.z);
  if (place == text_.place(from.at)) {
    if (z.empty()) return;
    if (from.pace == MillPace::rapid) return text_.line("G0{}", z);
    feed(options_.plunge_feed);
    text_.line("G1{}", z);
    return;
  }
  const std::string feed = feed_word(feed_along(from, to));
  if (from.bulge == 0) {
    text_.line("G1 {}{}{}", place, z, feed);
    return;
  }
  const DrawnPoint centre = to_centre(from.at, to.at, from.bulge);
  text_.line("{} {}{} I{} J{}{}", from.bulge > 0 ? "G3" : "G2", place, z, text_.number(centre.x),
             text_.number(centre.y), feed);
}

}  // namespace

Nanometres usual_link_feed(Nanometres feed) {
  constexpr std::int64_t least = 1'500'000'000;  // nm/min
  return {std::max(4 * feed.count, least)};
}

std::string write_mill_program(const MillPlan& plan, const MillProgramOptions& options) {
  return MillProgram(plan, options).write();
}

}  // namespace passo
