#include "passo/laser/laser_lines.hpp"

#include <algorithm>
#include <iterator>

#include "passo/cam/plot_plan.hpp"

namespace passo {
namespace {

using Path = std::vector<PathPoint>;

bool is_closed(const Path& path) {
  return path.size() > 2 && path.front().at == path.back().at;
}

// On the lines.
void follow(const EdgeLoops& lines, DrawnPoint start, LaserLines& plan) {
  PlotOptions options;
  options.park = start;
  options.inner_first = true;
  PlotPlan plot = plan_plot(lines, options);
  plan.closed += plot.closed;
  plan.open += plot.open;
  plan.dots += plot.dots;
  std::erase_if(plot.paths, [](const Path& path) { return path.size() < 2; });
  std::ranges::move(plot.paths, std::back_inserter(plan.paths));
}

}  // namespace

LaserLines plan_laser_lines(const EdgeLoops& lines, const LaserLinesOptions& options, Diagnostics& diagnostics) {
  LaserLines plan;
  if (options.side == ProfileSide::on || options.kerf.count <= 0 || lines.loops.empty()) {
    follow(lines, options.start, plan);
    return plan;
  }
  EdgeLoops open;
  open.open = lines.open;
  follow(open, options.start, plan);
  // One level of a cutter as wide as the kerf. Its depth only has to be one step.
  ProfileOptions beside{.side = options.side};
  beside.cut.cutter = options.kerf;
  beside.cut.words = "beam";
  beside.cut.depth = {-1'000'000};
  beside.cut.step = {1'000'000};
  beside.cut.lead = options.lead;
  beside.cut.park = plan.paths.empty() ? options.start : plan.paths.back().back().at;
  const ProfilePlan profile = plan_profile(lines.loops, {}, beside, diagnostics);
  for (const MillTool& tool : profile.outline.mill.tools) {
    for (const MillRun& run : tool.runs) {
      Path path;
      for (const MillPoint& point : run) path.push_back({point.at, point.bulge});
      plan.paths.push_back(std::move(path));
    }
  }
  plan.closed += profile.outline.outsides + profile.outline.openings;
  return plan;
}

void burn_lines(LaserProgram& program, const LaserLines& lines, const LaserPasses& passes) {
  const auto burn = [&](const Path& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) program.burn(path[i + 1].at, path[i].bulge, passes.beam);
  };
  const auto turned_back = [](const Path& path) {
    Path back(path.rbegin(), path.rend());
    for (std::size_t i = 0; i + 1 < back.size(); ++i) back[i].bulge = -path[path.size() - 2 - i].bulge;
    return back;
  };
  const bool has_steps = passes.step.count > 0;
  for (const Path& path : lines.paths) {
    program.travel(path.front().at);
    for (std::uint32_t pass = 0; pass < passes.passes; ++pass) {
      if (pass > 0 && has_steps) program.lower({passes.focus.count - pass * passes.step.count});
      burn(pass % 2 == 0 || is_closed(path) ? path : turned_back(path));
    }
    if (has_steps && passes.passes > 1) program.lower(passes.focus);
  }
}

}  // namespace passo
