// passo cam profile and passo cam pocket: programs that cut parts and pockets from drawings.
#include <algorithm>
#include <cmath>

#include "cam_part.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/cam/plot_plan.hpp"
#include "passo/cam/pocket.hpp"
#include "passo/cam/profile.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

DrawnBox box_of(const Drawing& drawing) {
  std::vector<DrawnRing> rows;
  for (const DrawnPath& path : drawing.paths) rows.push_back(chords_of_path(path.points, path.is_closed, {10'000}));
  for (const DrawnHole& hole : drawing.holes) {
    const Nanometres radius{hole.diameter.count / 2};
    rows.push_back({{hole.at.x - radius, hole.at.y - radius}, {hole.at.x + radius, hole.at.y + radius}});
  }
  return bounds(Region{rows}).value_or(DrawnBox{});
}

// What is drawn lies on the material.
void check_sheet(const DrawnBox& sheet, const DrawnBox& box, const std::string& file, Diagnostics& findings) {
  const bool fits = box.least.x >= sheet.least.x && box.least.y >= sheet.least.y && box.most.x <= sheet.most.x &&
                    box.most.y <= sheet.most.y;
  if (fits) return;
  findings.add(of_file(
      "profile.off-sheet", file,
      fmt::format(
          "the drawing extends from X{:.6g} Y{:.6g} to X{:.6g} Y{:.6g} mm, beyond the sheet of {:.6g} x {:.6g} mm",
          to_mm(box.least.x).value(), to_mm(box.least.y).value(), to_mm(box.most.x).value(), to_mm(box.most.y).value(),
          to_mm(sheet.most.x).value(), to_mm(sheet.most.y).value()),
      "--zero lower-left, another --scale, or a larger --sheet"));
}

}  // namespace

std::optional<Drawing> read_drawings(const CamMillArguments& arguments, const MillJob& job) {
  Diagnostics findings;
  Drawing all;
  for (const std::string& file : arguments.files) {
    Drawing one = read_drawing(file, job.reading, findings);
    for (const std::string& words : one.notes) note(file + ": " + words);
    all.file = file;
    std::ranges::move(one.holes, std::back_inserter(all.holes));
    std::ranges::move(one.paths, std::back_inserter(all.paths));
  }
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return all;
}

std::optional<PartDrawing> part_of(Drawing drawing, const MillJob& job, Nanometres join, OpenRows open_rows,
                                   DrawnDots dots) {
  const bool cuts_dots = open_rows == OpenRows::kept && dots == DrawnDots::ignored;
  const auto points = std::ranges::count_if(
      drawing.holes, [&](const DrawnHole& hole) { return hole.diameter.count <= 0 && !(hole.is_dot && cuts_dots); });
  if (points > 0 && dots == DrawnDots::ignored) {
    note(fmt::format("{} without a diameter {} ignored", counted(static_cast<std::size_t>(points), "point"),
                     points == 1 ? "is" : "are"));
  }
  mirror_drawing(drawing, job.mirror);
  if (job.zero.at || job.zero.is_lower_left) {
    move_zero_to(job.zero.is_lower_left ? box_of(drawing).least : *job.zero.at, drawing);
  }
  const DrawnBox box = box_of(drawing);
  std::vector<DrawnPoint> kept;
  if (dots == DrawnDots::kept) kept = take_dots(drawing);
  Diagnostics findings;
  PartDrawing part{edge_loops(drawing, join, findings, open_rows), box.least, box.most, std::move(kept)};
  for (const DrawnHole& hole : drawing.holes) {
    if (hole.is_dot && cuts_dots) part.loops.open.push_back({{hole.at, 0}});
  }
  if (job.sheet && !findings.any_error()) check_sheet(*job.sheet, box, drawing.file, findings);
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return part;
}

std::string size_words(const PartDrawing& part) {
  return fmt::format("drawn: X {:.6g} to {:.6g}, Y {:.6g} to {:.6g} mm\n", to_mm(part.least.x).value(),
                     to_mm(part.most.x).value(), to_mm(part.least.y).value(), to_mm(part.most.y).value());
}

std::string open_lines(const ProfilePlan& plan) {
  const std::string dots = plan.dots == 0 ? "" : ", " + counted(plan.dots, "dot");
  return counted(plan.lines, "open line") + dots;
}

int deliver(const CamMillArguments& arguments, const MillJob& job, const PartResult& result,
            const WorkProgress& progress) {
  for (const std::string& words : result.mill.notes) note(words);
  if (const int code = write_program(arguments, result.mill, job.program); code != exit_done) {
    return code;
  }
  progress.update(0.5);
  if (!arguments.picture.empty()) {
    const MillScene scene{.plan = result.mill,
                          .face = result.face,
                          .face_name = "Drawn",
                          .warned = result.unreached,
                          .marks = result.tabs,
                          .mark_name = "Tab",
                          .park = job.program.park,
                          .warned_name = "Not reached",
                          .sheet = job.sheet};
    const int code = write_picture(
        arguments.picture, job.program.name,
        [&](const PictureOptions& picture, OutputFile& file) { return draw_mill_plan(scene, picture, file); });
    if (code != exit_done) return code;
  }
  progress.update(1);
  if (arguments.json) {
    say(with_tool_warnings(result.json, arguments) + "\n");
    return exit_done;
  }
  return tell(arguments.output, result.mill, summary_of(result.mill, job.program.park, arguments.units) + result.words,
              nullptr);
}

namespace {

std::optional<PartDrawing> read_part(const CamMillArguments& arguments, const MillJob& job, Nanometres join,
                                     OpenRows open_rows) {
  std::optional<Drawing> drawing = read_drawings(arguments, job);
  return drawing ? part_of(std::move(*drawing), job, join, open_rows) : std::nullopt;
}

Nanometres join_of(const std::string& text, LengthArguments& lengths) {
  const Nanometres join = lengths.any("--join", text);
  if (join.count < 0) lengths.refuse("--join: expected a length of 0 or more");
  return join;
}

std::string unreached_words(double mm2) {
  if (mm2 <= 0) return "";
  return fmt::format("not reached: {} mm² in corners and gaps narrower than the cutter\n", sensible_number(mm2, 4));
}

std::string joined_words(const EdgeLoops& loops) {
  if (loops.joined == 0) return "";
  return fmt::format("joined: {} with gaps of at most {:.4g} mm\n", counted(loops.joined, "end"),
                     to_mm(loops.widest_joined).value());
}

nlohmann::ordered_json lengths_json(const MillPlan& plan, DrawnPoint park) {
  MillLengths lengths;
  if (!plan.tools.empty()) lengths = lengths_of(plan.tools.front(), park);
  return {{"runs", lengths.runs},
          {"milled_mm", lengths.milled_nm / nanometres_per_mm},
          {"rapids_mm", lengths.rapids_nm / nanometres_per_mm}};
}

ProfileSide side_of(const std::string& side) {
  return side == "outside"  ? ProfileSide::outside
         : side == "inside" ? ProfileSide::inside
         : side == "on"     ? ProfileSide::on
                            : ProfileSide::part;
}

// Whether depth and step give a number of layers that a program can have.
void check_layers(Nanometres depth, Nanometres step, LengthArguments& lengths) {
  constexpr std::int64_t finest_step = 1'000;  // nm
  constexpr std::int64_t most_layers = 1'000;
  if (step.count < finest_step) {
    lengths.refuse("--step: expected 0.001 mm or more");
  } else if (-depth.count / step.count > most_layers) {
    lengths.refuse(fmt::format("--step: expected a depth of at most {} steps", most_layers));
  }
}

}  // namespace

int cam_profile(const CamProfileArguments& arguments, const WorkProgress& progress) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob job = mill_job_of(arguments, "passo cam profile", lengths, "stock");
  const ProfileOptions options{.cut = outline_options_of(arguments, job, lengths), .side = side_of(arguments.side)};
  const Nanometres join = join_of(arguments.join, lengths);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  const bool is_on = options.side == ProfileSide::on;
  if (is_on && (!options.cut.tab_places.empty() || options.cut.lead.count > 0 || options.cut.dog_bones)) {
    return fail(exit_bad_program, "--side on cannot be combined with --tab, --lead or --dog-bones");
  }

  const std::optional<PartDrawing> part = read_part(arguments, job, join, is_on ? OpenRows::kept : OpenRows::refused);
  if (!part) return exit_bad_program;
  Diagnostics findings;
  const ProfilePlan plan = plan_profile(part->loops.loops, part->loops.open, options, findings);
  show(findings, listed(arguments.files));
  if (findings.any_error()) return exit_bad_program;
  const OutlinePlan& cut = plan.outline;
  std::string words = size_words(*part);
  nlohmann::ordered_json json = lengths_json(cut.mill, options.cut.park);
  if (is_on) {
    words += fmt::format("{} and {}, {}\n", counted(cut.outsides, "closed line"), open_lines(plan),
                         counted(cut.tabs.size(), "tab"));
    json["closed"] = cut.outsides;
    json["open"] = plan.lines;
    json["dots"] = plan.dots;
    json["tabs"] = cut.tabs.size();
  } else {
    words += fmt::format("{} and {}, {}; {:g} mm² of the part lost\n", counted(cut.outsides, "outside"),
                         counted(cut.openings, "inside"), counted(cut.tabs.size(), "tab"), cut.lost_mm2);
    words += unreached_words(plan.unreached_mm2);
    json["outsides"] = cut.outsides;
    json["insides"] = cut.openings;
    json["tabs"] = cut.tabs.size();
    json["lost_mm2"] = cut.lost_mm2;
    json["unreached_mm2"] = plan.unreached_mm2;
  }
  words += joined_words(part->loops);
  return deliver(arguments, job, {cut.mill, plan.face, plan.unreached, cut.tabs, words, json.dump(2)},
                 progress.part(0.8, 1));
}

int cam_pocket(const CamPocketArguments& arguments, const WorkProgress& progress) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob job = mill_job_of(arguments, "passo cam pocket", lengths, "stock");
  PocketOptions options;
  options.cutter = lengths.above_0("--tool", arguments.tool);
  options.words = fmt::format("cutter {:.4g} mm", to_mm(options.cutter).value());
  options.depth = lengths.below_0("--depth", arguments.depth, "-3");
  options.step = lengths.above_0("--step", arguments.step);
  check_layers(options.depth, options.step, lengths);
  options.step_over = arguments.step_over / 100;
  options.ramp_degrees = arguments.ramp;
  options.most_engagement = arguments.engagement;
  options.climb = !arguments.conventional;
  options.park = job.program.park;
  const Nanometres join = join_of(arguments.join, lengths);
  constexpr double least_engagement = 30;
  if (options.most_engagement > 0 && options.most_engagement < least_engagement) {
    lengths.refuse(fmt::format("--engagement: expected 0, or {} to 150 degrees, found {:g}", least_engagement,
                               options.most_engagement));
  }
  constexpr double flattest = 0.1;
  if (arguments.ramp > 0 && arguments.ramp < flattest) {
    lengths.refuse(fmt::format("--ramp: expected 0, or {} degrees or more, found {:g}", flattest, arguments.ramp));
  }
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());

  const std::optional<PartDrawing> part = read_part(arguments, job, join, OpenRows::refused);
  if (!part) return exit_bad_program;
  Diagnostics findings;
  const Region area = enclosed_by(part->loops.loops);
  const bool is_constant = options.most_engagement > 0;
  const PocketPlan plan = plan_pocket(area, options, findings, progress.part(0.02, 0.9));
  show(findings, listed(arguments.files));
  if (findings.any_error()) return exit_bad_program;
  const std::string words =
      size_words(*part) +
      fmt::format("{} of {} mm², {} per layer; {:g} mm² of the part lost\n", counted(plan.pockets, "pocket"),
                  sensible_number(area_mm2(area), 4), counted(plan.loops, is_constant ? "disc" : "loop"),
                  plan.lost_mm2) +
      (is_constant ? fmt::format("engagement: at most {:.1f} degrees, except on the way down\n", plan.engagement)
                   : std::string()) +
      unreached_words(plan.unreached_mm2) + joined_words(part->loops);
  nlohmann::ordered_json json = lengths_json(plan.mill, options.park);
  json["pockets"] = plan.pockets;
  json[is_constant ? "discs" : "loops"] = plan.loops;
  if (is_constant) json["engagement_degrees"] = plan.engagement;
  json["area_mm2"] = area_mm2(area);
  json["lost_mm2"] = plan.lost_mm2;
  json["unreached_mm2"] = plan.unreached_mm2;
  return deliver(arguments, job, {plan.mill, area, plan.unreached, {}, words, json.dump(2)}, progress.part(0.9, 1));
}

}  // namespace passo
