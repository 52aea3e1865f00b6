#include "passo/cam/plot_program.hpp"

#include <algorithm>

#include "passo/cam/bulge.hpp"
#include "passo/cam/program_text.hpp"

namespace passo {
namespace {

class PlotProgram {
 public:
  PlotProgram(const PlotPlan& plan, const PlotProgramOptions& options)
      : plan_(plan), options_(options), text_(options.units) {}

  std::string write() {
    text_.line("({}, by passo cam plot)", in_comment(options_.name));
    for (const std::string& file : options_.files) text_.line("(from {})", in_comment(file));
    for (const std::string& remark : options_.remarks) text_.line("({})", in_comment(remark));
    text_.begin_modes();
    raise();
    for (const std::vector<PathPoint>& path : plan_.paths) draw(path);
    text_.end(false, options_.park, std::nullopt);
    return text_.take();
  }

 private:
  void raise();
  void lower();
  void draw(const std::vector<PathPoint>& path);
  std::string feed_word(Nanometres feed) {
    if (feed == feed_) return "";
    feed_ = feed;
    return " F" + text_.number(feed);
  }
  void wait(double seconds) {
    if (seconds > 0) text_.line("G4 P{:g}", seconds);
  }

  const PlotPlan& plan_;
  const PlotProgramOptions& options_;
  ProgramText text_;
  Nanometres feed_{};
};

void PlotProgram::raise() {
  if (!options_.servo) {
    text_.line("G0 Z{}", text_.number(options_.up));
    return;
  }
  if (options_.servo->up) {
    text_.line("M3 S{}", *options_.servo->up);
  } else {
    text_.line("M5");
  }
  wait(options_.servo->seconds);
}

void PlotProgram::lower() {
  if (!options_.servo) {
    text_.line("G1 Z{}{}", text_.number(options_.down), feed_word(options_.plunge_feed));
    return;
  }
  text_.line("M3 S{}", options_.servo->down);
  wait(options_.servo->seconds);
}

void PlotProgram::draw(const std::vector<PathPoint>& path) {
  text_.line("G0 {}", text_.place(path.front().at));
  lower();
  if (path.size() == 1) wait(options_.dot_seconds);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const PathPoint& from = path[i];
    const std::string place = text_.place(path[i + 1].at);
    if (place == text_.place(from.at)) continue;
    const std::string feed = feed_word(options_.feed);
    if (from.bulge == 0) {
      text_.line("G1 {}{}", place, feed);
      continue;
    }
    const DrawnPoint centre = to_centre(from.at, path[i + 1].at, from.bulge);
    text_.line("{} {} I{} J{}{}", from.bulge > 0 ? "G3" : "G2", place, text_.number(centre.x), text_.number(centre.y),
               feed);
  }
  raise();
}

}  // namespace

std::string write_plot_program(const PlotPlan& plan, const PlotProgramOptions& options) {
  return PlotProgram(plan, options).write();
}

}  // namespace passo
