// passo cam drill: a program that drills the holes of circuit boards, from DXF drawings and drill files.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cam_job.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include "commands.hpp"
#include "length_arguments.hpp"
#include "named_files.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/cam/drawing_file.hpp"
#include "passo/cam/drill_plan.hpp"
#include "passo/cam/drill_program.hpp"
#include "passo/report/drill_picture.hpp"
#include "passo/report/output_file.hpp"

namespace passo {
namespace {

struct DrillJob {
  DrawingFileOptions reading;
  DrillOptions plan;
  DrillProgramOptions program;
  Mirror mirror;
  ZeroPlace zero;
  Drawing align;  // the holes that hold the board
};

Result<DrillJob, std::string> job_of(const CamDrillArguments& arguments) {
  const double unit = *mm_of_unit(arguments.units);
  LengthArguments lengths(unit);
  DrillJob job;
  job.reading.dxf = dxf_options_of(arguments, unit, lengths);
  job.reading.dxf.is_for_drilling = true;
  job.reading.svg = {.scale = arguments.scale.value_or(1),
                     .layers = arguments.layers,
                     .colors = arguments.colors,
                     .names = arguments.names};
  if (!arguments.input.empty()) job.reading.excellon.inch = arguments.input == "inch";
  if (!arguments.zeros.empty()) {
    job.reading.excellon.zeros = arguments.zeros == "leading" ? LeftOutZeros::leading : LeftOutZeros::trailing;
  }

  if (!arguments.tools.empty()) {
    job.plan.rack = lengths.list("--tools", arguments.tools);
    for (const Nanometres drill : job.plan.rack) {
      if (drill.count <= 0) lengths.refuse("--tools: expected diameters above 0");
    }
  }
  if (!arguments.tools.empty() && !arguments.drill.empty())
    lengths.refuse("--drill makes all holes with one drill, so it cannot be combined with --tools");
  job.plan.tolerance = lengths.any("--tolerance", arguments.tolerance);
  if (job.plan.tolerance.count < 0) lengths.refuse("--tolerance: expected a length of 0 or more");
  job.plan.one_drill = lengths.perhaps("--drill", arguments.drill);
  job.plan.mill = lengths.perhaps("--mill", arguments.mill);
  job.plan.in_job = arguments.in_job;
  job.plan.park = lengths.place("--park", arguments.park);
  job.plan.route_steps = arguments.route_steps;
  job.mirror = mirror_of(arguments.mirror, arguments.mirror_at, lengths);
  job.zero = zero_of(arguments.zero, lengths);
  job.align.file = "--align";
  const Nanometres align_drill = lengths.above_0("--align-drill", arguments.align_drill);
  for (const DrawnPoint at : align_holes_of(arguments.align, lengths)) job.align.holes.push_back({at, align_drill});

  DrillProgramOptions& program = job.program;
  program.name = arguments.output.empty() ? "board" : std::filesystem::path(arguments.output).filename().string();
  for (const std::string& file : arguments.files) {
    program.files.push_back(std::filesystem::path(file).filename().string());
  }
  program.remarks = arguments.tool_remarks;
  program.units = program_units_of(arguments.units);
  program.clearance = lengths.above_0("--clearance", arguments.clearance);
  program.feed_height = lengths.above_0("--feed-height", arguments.feed_height);
  program.depth = lengths.any("--depth", arguments.depth);
  if (program.depth.count >= 0) {
    lengths.refuse(fmt::format("--depth: expected a length below 0, e.g. -2, found '{}'", arguments.depth));
  }
  program.peck = lengths.perhaps("--peck", arguments.peck);
  program.mill_step = lengths.above_0("--mill-step", arguments.mill_step);
  program.feed = lengths.above_0("--feed", arguments.feed);
  program.mill_feed = lengths.above_0("--mill-feed", arguments.mill_feed);
  constexpr std::int64_t finest_step = 1000;  // nm: less makes programs without end
  const bool is_too_fine = program.mill_step.count < finest_step || (program.peck && program.peck->count < finest_step);
  if (is_too_fine) lengths.refuse("--peck and --mill-step: expected 0.001 mm or more");
  if (arguments.spindle > 0) program.spindle = arguments.spindle;
  program.park = job.plan.park;
  program.canned = !arguments.plain;
  program.change = safe_change_of(arguments, lengths);
  if (!lengths.message().empty()) return Failure{lengths.message()};
  return job;
}

// What was read and planned, in the program's units.
std::string summary_of(const std::vector<Drawing>& drawings, const DrillPlan& plan,
                       const CamDrillArguments& arguments) {
  const double unit_nm = *mm_of_unit(arguments.units) * nanometres_per_mm;
  const auto words = [&](double nm) { return fmt::format("{:.6g} {}", nm / unit_nm, arguments.units); };
  const auto size = [&](Nanometres length) { return words(static_cast<double>(length.count)); };
  std::string text;
  for (const Drawing& drawing : drawings) {
    std::size_t slots = 0;
    for (const DrawnPath& path : drawing.paths) slots += path.width.count > 0 ? 1 : 0;
    text += fmt::format("{}: {}, {}, {}\n", drawing.file, counted(drawing.holes.size(), "hole"), counted(slots, "slot"),
                        counted(drawing.paths.size() - slots, "other path"));
  }
  double before = 0;
  double after = 0;
  for (std::size_t i = 0; i < plan.tools.size(); ++i) {
    const DrillTool& tool = plan.tools[i];
    text += fmt::format("tool {}: {} {}, {}, {}; rapids {} as drawn, {} as ordered\n", i + 1,
                        tool.is_mill ? "mill" : "drill", size(tool.diameter), counted(tool.holes, "hole"),
                        counted(tool.slots, "slot"), words(std::round(tool.rapids_before_nm / 1e4) * 1e4),
                        words(std::round(tool.rapids_after_nm / 1e4) * 1e4));
    before += tool.rapids_before_nm;
    after += tool.rapids_after_nm;
  }
  const double saved = before > 0 ? (1 - after / before) * 100 : 0;
  text += fmt::format("all rapids: {:.1f} % shorter than as drawn\n", saved);
  return text;
}

nlohmann::ordered_json json_of(const DrillPlan& plan) {
  nlohmann::ordered_json tools = nlohmann::ordered_json::array();
  for (const DrillTool& tool : plan.tools) {
    tools.push_back({{"kind", tool.is_mill ? "mill" : "drill"},
                     {"diameter_mm", to_mm(tool.diameter).value()},
                     {"holes", tool.holes},
                     {"slots", tool.slots},
                     {"rapids_mm", tool.rapids_after_nm / nanometres_per_mm}});
  }
  return {{"tools", std::move(tools)}};
}

// Adds the holes of --align, turns the board over, and moves it to its zero.
void place(std::vector<Drawing>& drawings, const DrillJob& job) {
  const auto turn = [&](Drawing& drawing) { mirror_drawing(drawing, job.mirror); };
  std::ranges::for_each(drawings, turn);
  const DrawnPoint corner = lower_left_of(drawings);  // of the board's own holes
  if (!job.align.holes.empty()) {
    drawings.push_back(job.align);
    turn(drawings.back());
  }
  const std::optional<DrawnPoint> zero = job.zero.is_lower_left ? std::optional(corner) : job.zero.at;
  if (!zero) return;
  for (Drawing& drawing : drawings) move_zero_to(*zero, drawing);
}

// Adds what the library knows about the drills that are used.
DrillProgramOptions with_drill_feeds(DrillProgramOptions program, const DrillPlan& plan,
                                     const std::vector<CamDrillFeed>& known) {
  for (const DrillTool& tool : plan.tools) {
    if (tool.is_mill) continue;
    const auto found = std::ranges::find_if(
        known, [&](const CamDrillFeed& one) { return to_nanometres(Mm(one.diameter_mm)) == tool.diameter; });
    if (found == known.end()) continue;
    program.remarks.push_back(found->words);
    if (found->feed_mm <= 0) continue;
    DrillFeed& own = program.drill_feeds.emplace_back();
    own.diameter = tool.diameter;
    own.feed = to_nanometres(Mm(found->feed_mm));
    if (found->spindle > 0) own.spindle = found->spindle;
  }
  return program;
}

int draw(const DrillPlan& plan, const CamDrillArguments& arguments, PictureFormat format,
         const DrillOptions& drilling) {
  Result<OutputFile, OutputError> file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  PictureOptions options;
  options.format = format;
  options.program =
      std::filesystem::path(arguments.output.empty() ? arguments.files.front() : arguments.output).filename().string();
  Status<OutputError> done = draw_drill_plan(plan, drilling.park, drilling.link, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

}  // namespace

int cam_drill(const CamDrillArguments& arguments, const WorkProgress& progress, const CamSources* given,
              CamMade* made) {
  NamedFiles files;
  for (const std::string& file : arguments.files) files.reads("the file", file);
  name_texts_read(arguments, files);
  name_library_read(arguments, files);
  files.writes("--output", arguments.output);
  files.writes("--picture", arguments.picture);
  if (!files.are_apart() || !program_words_are_good(arguments, arguments.units)) return exit_bad_program;
  if (!has_room_for_json(arguments.json, arguments.output)) return exit_bad_program;
  Result<DrillJob, std::string> job = job_of(arguments);
  if (!job) return fail(exit_bad_program, job.error());
  if (given != nullptr) take_link(given->link, job->plan.link, job->program.change);
  const std::optional<PictureFormat> format = picture_format_of(arguments.picture);
  if (!arguments.picture.empty() && !format) {
    return fail(exit_bad_program,
                fmt::format("--picture: expected a name that ends with .svg or .png, found '{}'", arguments.picture));
  }

  Diagnostics findings;
  std::vector<Drawing> drawings;
  if (given != nullptr) drawings = given->drills;
  for (std::size_t i = 0; given == nullptr && i < arguments.files.size(); ++i) {
    const std::string& file = arguments.files[i];
    drawings.push_back(read_drawing(file, job->reading, findings));
    for (const std::string& words : drawings.back().notes) note(file + ": " + words);
  }
  if (findings.any_error()) {
    show(findings);
    return exit_bad_program;
  }
  place(drawings, *job);
  const DrillPlan plan = plan_drilling(drawings, job->plan, findings, progress.part(0.05, 0.95));
  for (const std::string& words : plan.notes) note(words);
  if (findings.any_error()) {
    show(findings, listed(arguments.files));
    return exit_bad_program;
  }
  const DrillProgramOptions program = with_drill_feeds(job->program, plan, arguments.drill_feeds);
  if (const int code = write_program(arguments, plan, program); code != exit_done) return code;
  if (format) {
    if (const int code = draw(plan, arguments, *format, job->plan); code != exit_done) return code;
  }
  show(findings, listed(arguments.files));
  const std::string words = summary_of(drawings, plan, arguments);
  progress.update(1);
  if (made != nullptr) {
    for (const DrillTool& tool : plan.tools) {
      made->tools.push_back(fmt::format("{} {:.4g} mm", tool.is_mill ? "mill" : "drill", to_mm(tool.diameter).value()));
    }
    made->summary = words;
    made->last = end_of_drilling(plan, program);
  } else if (arguments.json) {
    say_summary(json_of(plan), arguments);
  } else if (!arguments.output.empty() && arguments.output != "-") {
    say(words);
  }
  return exit_done;
}

}  // namespace passo
