// passo cam plot: programs for pen plotters and drag knives.
#include <charconv>
#include <cmath>

#include "cam_part.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/cam/plot_plan.hpp"
#include "passo/cam/plot_program.hpp"

namespace passo {
namespace {

// --servo DOWN or DOWN,UP.
std::optional<PenServo> servo_of(const CamPlotArguments& arguments, LengthArguments& lengths) {
  if (arguments.servo.empty()) return std::nullopt;
  PenServo servo{.seconds = arguments.servo_delay};
  const char* const text = arguments.servo.data();
  const char* const end = text + arguments.servo.size();
  const auto down = std::from_chars(text, end, servo.down);
  bool is_good = down.ec == std::errc();
  if (is_good && down.ptr != end) {
    servo.up = 0;
    const auto up = *down.ptr == ',' ? std::from_chars(down.ptr + 1, end, *servo.up) : down;
    is_good = *down.ptr == ',' && up.ec == std::errc() && up.ptr == end;
  }
  constexpr std::uint32_t most = 100'000;
  if (!is_good || servo.down > most || servo.up.value_or(0) > most) {
    lengths.refuse(fmt::format("--servo: expected DOWN or DOWN,UP, two S words from 0 to {}, e.g. 90,30, found '{}'",
                               most, arguments.servo));
  }
  return servo;
}

PlotOptions plot_options_of(const CamPlotArguments& arguments, const MillJob& job, LengthArguments& lengths) {
  PlotOptions options;
  options.park = job.program.park;
  options.swivel_degrees = arguments.swivel;
  options.knife = lengths.perhaps("--knife", arguments.knife).value_or(Nanometres{});
  constexpr Nanometres widest{20'000'000};
  if (options.knife > widest) lengths.refuse("--knife: expected at most 20 mm");
  options.overcut = lengths.any("--overcut", arguments.overcut);
  if (options.overcut.count < 0) lengths.refuse("--overcut: expected a length of 0 or more");
  return options;
}

PlotProgramOptions plot_program_of(const CamPlotArguments& arguments, const MillJob& job, LengthArguments& lengths) {
  PlotProgramOptions program;
  program.name = job.program.name;
  program.files = job.program.files;
  program.remarks = job.program.remarks;
  program.units = job.program.units;
  program.servo = servo_of(arguments, lengths);
  program.up = lengths.any("--pen-up", arguments.pen_up);
  program.down = lengths.any("--pen-down", arguments.pen_down);
  if (!program.servo && program.up <= program.down) lengths.refuse("--pen-up: expected a Z above --pen-down");
  program.feed = job.program.feed;
  program.plunge_feed = job.program.plunge_feed;
  program.dot_seconds = arguments.dot;
  program.park = job.program.park;
  return program;
}

// The contents of the picture: the drawn lines as runs, and the dots.
int draw_plot(const CamPlotArguments& arguments, const MillJob& job, const PlotPlan& plan, const Region& drawn) {
  MillPlan shown;
  constexpr Nanometres fine{100'000};
  shown.tools.push_back({fine, arguments.knife.empty() ? "pen" : "axis of the knife", {}});
  std::vector<DrawnPoint> dots;
  for (const std::vector<PathPoint>& path : plan.paths) {
    MillRun run;
    for (const PathPoint& point : path) run.push_back({point.at, point.bulge, {}});
    if (path.size() == 1) {
      dots.push_back(path.front().at);
      run.push_back(run.front());
    }
    shown.tools.front().runs.push_back(std::move(run));
  }
  const Region nothing;
  const MillScene scene{.plan = shown,
                        .face = drawn,
                        .face_name = arguments.knife.empty() ? "Drawn" : "Cut",
                        .warned = nothing,
                        .marks = dots,
                        .mark_name = "Dot",
                        .park = job.program.park,
                        .sheet = job.sheet};
  return write_picture(arguments.picture, job.program.name, scene);
}

// The lines as thin areas. For a large plot this would take longer than everything else, and the path of the pen shows
// them, too.
Region drawn_of(const EdgeLoops& lines) {
  constexpr Nanometres thin{100'000};
  constexpr Nanometres tolerance{10'000};
  constexpr std::size_t most_points = 20'000;
  std::size_t points = 0;
  for (const auto& line : lines.open) points += line.size();
  for (const auto& line : lines.loops) points += line.size();
  if (points > most_points) return {};
  std::vector<DrawnRing> rows;
  for (const auto& line : lines.open) rows.push_back(chords_of_path(line, false, tolerance));
  for (const auto& line : lines.loops) {
    rows.push_back(chords_of_path(line, true, tolerance));
    rows.back().push_back(rows.back().front());
  }
  return swept(rows, thin, tolerance);
}

}  // namespace

int cam_plot(const CamPlotArguments& arguments, const WorkProgress& progress) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  const MillJob job = mill_job_of(arguments, "passo cam plot", lengths, "sheet");
  const PlotOptions options = plot_options_of(arguments, job, lengths);
  PlotProgramOptions program = plot_program_of(arguments, job, lengths);
  const Nanometres join = lengths.any("--join", arguments.join);
  if (join.count < 0) lengths.refuse("--join: expected a length of 0 or more");
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());

  std::optional<Drawing> drawing = read_drawings(arguments, job);
  if (!drawing) return exit_bad_program;
  const std::optional<PartDrawing> part = part_of(std::move(*drawing), job, join, OpenRows::kept);
  if (!part) return exit_bad_program;
  progress.update(0.2);
  const PlotPlan plan = plan_plot(part->loops, options);
  if (plan.paths.empty()) {
    return fail(exit_bad_program, listed(arguments.files) + ": there is nothing to draw; expected lines or dots");
  }
  progress.update(0.8);
  if (options.knife.count > 0) {
    program.remarks.push_back(fmt::format("drag knife: its blade trails the axis by {:.4g} mm, at first towards -X",
                                          to_mm(options.knife).value()));
  }
  if (const int code = write_program(arguments, write_plot_program(plan, program), job.program.name, job.program.park);
      code != exit_done)
    return code;
  if (!arguments.picture.empty()) {
    if (const int code = draw_plot(arguments, job, plan, drawn_of(part->loops)); code != exit_done) return code;
  }
  progress.update(1);
  const double drawn = plan.drawn_nm / nanometres_per_mm;
  const double travel = plan.travel_nm / nanometres_per_mm;
  if (arguments.json) {
    const nlohmann::ordered_json json = {
        {"closed", plan.closed}, {"open", plan.open}, {"dots", plan.dots}, {"drawn_mm", drawn}, {"travel_mm", travel}};
    say_summary(json, arguments);
  } else if (!arguments.output.empty() && arguments.output != "-") {
    fmt::print("{}, {} and {}: {:.1f} mm drawn, {:.1f} mm of travels\n{}", counted(plan.closed, "closed line"),
               counted(plan.open, "open line"), counted(plan.dots, "dot"), drawn, travel, size_words(*part));
  }
  return exit_done;
}

}  // namespace passo
