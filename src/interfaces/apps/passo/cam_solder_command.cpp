#include "cam_solder_command.hpp"

#include <algorithm>
#include <array>

#include "cam_job.hpp"
#include "cam_program.hpp"

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/cam/outline.hpp"
#include "passo/cam/pocket.hpp"

namespace passo {
namespace {

// The openings, where the program mills them.
Region openings_of(const CamSources& given, const MillJob& job) {
  Region openings = given.board.empty() ? given.layer.face : common(given.layer.face, given.board);
  openings = mirrored(openings, job.mirror);
  move_to_zero(job.zero, openings, {&openings});
  return openings;
}

// The number of openings into which the cutter does not fit.
std::size_t too_narrow(const std::vector<Region>& openings, Nanometres cutter) {
  constexpr Nanometres room{3'000};
  return static_cast<std::size_t>(std::ranges::count_if(
      openings, [&](const Region& one) { return grown(one, {-(cutter.count + 1) / 2 - room.count}).empty(); }));
}

// Reports the number of openings that stay closed, and the widest of some usual cutters that fits into all of them.
void note_narrow(const std::vector<Region>& openings, Nanometres cutter, const char* option) {
  const std::size_t count = too_narrow(openings, cutter);
  if (count == 0) return;
  std::string advice;
  for (const std::int64_t width : {800'000, 600'000, 500'000, 400'000, 300'000, 250'000, 200'000, 150'000, 100'000}) {
    if (width >= cutter.count || too_narrow(openings, {width}) > 0) continue;
    advice = fmt::format("; {} {:g}mm was tried: it fits into all of them", option, to_mm(Nanometres{width}).value());
    break;
  }
  note(fmt::format("{} narrower than the cutter and {} closed{}",
                   count == 1 ? "an opening is" : counted(count, "opening") + " are", count == 1 ? "stays" : "stay",
                   advice));
}

int write_openings(const CamOpeningArguments& arguments, const MillJob& job, const MillScene& scene,
                   const std::string& words, CamMade* made) {
  if (const int code = write_program(arguments, scene.plan, job.program); code != exit_done) return code;
  if (!arguments.picture.empty()) {
    const int code = write_picture(arguments.picture, job.program.name, scene);
    if (code != exit_done) return code;
  }
  return tell(arguments.output, scene.plan, summary_of(scene.plan, job.program.park, arguments.units) + words, made);
}

}  // namespace

int cam_mask(const CamOpeningArguments& arguments, const WorkProgress& progress, const CamSources* given,
             CamMade* made) {
  LengthArguments lengths(*mm_of_unit(arguments.units));
  const MillJob job = mill_job_of(arguments, "passo cam board", lengths);
  PocketOptions options;
  options.cutter = lengths.above_0("--mask", arguments.tool);
  options.words = fmt::format("cutter {:.4g} mm", to_mm(options.cutter).value());
  options.depth = lengths.below_0("--mask-depth", arguments.depth, "-0.05");
  options.step = {-options.depth.count};
  options.ramp_degrees = 0;
  options.climb = !arguments.conventional;
  options.park = job.program.park;
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  const Region openings = openings_of(*given, job);
  Diagnostics findings;
  const PocketPlan plan = plan_pocket(openings, options, findings, progress.part(0, 0.9));
  show(findings, given->layer.lines.file);
  if (findings.any_error()) return exit_bad_program;
  for (const std::string& words : plan.mill.notes) note(words);
  const std::vector<Region> parts = parts_of(openings);
  note_narrow(parts, options.cutter, "--mask");
  const std::string words = fmt::format(
      "{} of {} mm² in the solder mask cleared; {} mm² in corners and narrow openings not reached\n",
      counted(parts.size(), "opening"), sensible_number(area_mm2(openings), 4), sensible_number(plan.unreached_mm2, 2));
  progress.update(1);
  return write_openings(arguments, job,
                        {.plan = plan.mill,
                         .face = openings,
                         .face_name = "Opening",
                         .warned = plan.unreached,
                         .marks = {},
                         .mark_name = "",
                         .park = options.park,
                         .warned_name = "Not reached"},
                        words, made);
}

int cam_stencil(const CamOpeningArguments& arguments, const WorkProgress& progress, const CamSources* given,
                CamMade* made) {
  constexpr Nanometres rim{5'000'000};  // of the film around the openings
  LengthArguments lengths(*mm_of_unit(arguments.units));
  const MillJob job = mill_job_of(arguments, "passo cam board", lengths, "film");
  OutlineOptions options;
  options.cutter = lengths.above_0("--stencil", arguments.tool);
  options.words = fmt::format("cutter {:.4g} mm", to_mm(options.cutter).value());
  options.depth = lengths.below_0("--stencil-depth", arguments.depth, "-0.15");
  options.step = {-options.depth.count};
  options.openings_only = true;
  options.skips_narrow = true;
  options.climb = !arguments.conventional;
  options.park = job.program.park;
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  const Region openings = openings_of(*given, job);
  const std::vector<Region> parts = parts_of(openings);
  const Region film = subtracted(filled({rectangle(bounds(grown(openings, rim)).value_or(DrawnBox{}))}), openings);
  Diagnostics findings;  // a note counts the narrow openings
  const OutlinePlan plan = plan_outline(film, options, findings);
  note_narrow(parts, options.cutter, "--stencil");
  for (const std::string& words : plan.mill.notes) note(words);
  const std::string words = fmt::format("{} of {} in the film, {} mm²\n", plan.openings,
                                        counted(parts.size(), "opening"), sensible_number(area_mm2(openings), 4));
  progress.update(1);
  const Region nothing;
  return write_openings(arguments, job, {plan.mill, film, "Film", nothing, {}, "", options.park}, words, made);
}

}  // namespace passo
