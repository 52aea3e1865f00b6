// passo cam engrave: a program that carves texts and drawings with a V-shaped cutter.
#include <algorithm>
#include <cmath>

#include "cam_part.hpp"
#include <nlohmann/json.hpp>

#include "passo/cam/lettering.hpp"
#include "passo/cam/pocket.hpp"
#include "passo/cam/v_carve.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

struct EngraveJob {
  VCarveOptions carving;
  PocketOptions clearing;  // of floors
  bool clears = false;
  Lettering lettering;
};

Lettering lettering_of(const CamEngraveArguments& arguments, LengthArguments& lengths) {
  Lettering lettering;
  for (std::size_t i = 0; i < arguments.text.size(); ++i) {
    const bool is_break = arguments.text.compare(i, 2, "\\n") == 0;
    lettering.text += is_break ? '\n' : arguments.text[i];
    if (is_break) ++i;
  }
  lettering.height = to_mm(lengths.above_0("--height", arguments.height));
  lettering.align = arguments.text_align == "middle"  ? LetterAlign::middle
                    : arguments.text_align == "right" ? LetterAlign::right
                                                      : LetterAlign::left;
  if (!arguments.around.empty()) lettering.around = to_mm(lengths.any("--around", arguments.around));
  lettering.line_space = arguments.line_space;
  return lettering;
}

EngraveJob engrave_job_of(const CamEngraveArguments& arguments, const MillJob& job, LengthArguments& lengths) {
  EngraveJob engrave;
  VCarveOptions& carving = engrave.carving;
  carving.angle_degrees = arguments.angle;
  carving.tip = lengths.any("--tip", arguments.tip);
  carving.widest = lengths.above_0("--tool", arguments.tool);
  if (carving.tip.count < 0 || carving.tip >= carving.widest) {
    lengths.refuse(fmt::format("--tip: expected a width of 0 or more, less than --tool, found '{}'", arguments.tip));
  }
  if (!arguments.depth.empty()) carving.deepest = lengths.below_0("--depth", arguments.depth, "-2");
  carving.words = fmt::format("V of {:g} degrees, {:.4g} mm", arguments.angle, to_mm(carving.widest).value());
  if (carving.tip.count > 0) carving.words += fmt::format(", tip {:.4g} mm", to_mm(carving.tip).value());
  carving.park = job.program.park;
  engrave.clears = !arguments.clear.empty();
  if (engrave.clears) {
    engrave.clearing.cutter = lengths.above_0("--clear", arguments.clear);
    engrave.clearing.words = fmt::format("flat cutter {:.4g} mm", to_mm(engrave.clearing.cutter).value());
    engrave.clearing.step = lengths.above_0("--clear-step", arguments.clear_step);
    engrave.clearing.climb = !arguments.conventional;
    engrave.clearing.park = job.program.park;
  }
  engrave.lettering = lettering_of(arguments, lengths);
  return engrave;
}

std::optional<Drawing> drawing_of(const CamEngraveArguments& arguments, const MillJob& job,
                                  const Lettering& lettering) {
  if (arguments.text.empty()) return read_drawings(arguments, job);
  Diagnostics findings;
  const auto font = read_bytes(arguments.font, {.area = "engrave", .expected = "--font FILE: a font"}, findings);
  Drawing drawing;
  if (font) drawing = letter(lettering, arguments.font, *font, findings);
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return drawing;
}

}  // namespace

int cam_engrave(const CamEngraveArguments& arguments) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  if (arguments.text.empty() == arguments.files.empty()) {
    return fail(exit_bad_program, "expected a drawing (FILE) or --text, one of them");
  }
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob job = mill_job_of(arguments, "passo cam engrave", lengths, "stock");
  EngraveJob engrave = engrave_job_of(arguments, job, lengths);
  const Nanometres join = lengths.any("--join", arguments.join);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());

  std::optional<Drawing> drawing = drawing_of(arguments, job, engrave.lettering);
  if (!drawing) return exit_bad_program;
  const std::optional<PartDrawing> part = part_of(std::move(*drawing), job, join, OpenRows::refused);
  if (!part) return exit_bad_program;
  const Region area = enclosed_by(part->loops.loops);
  Diagnostics findings;
  VCarvePlan plan = plan_v_carve(area, engrave.carving, findings);
  Region warned = united(plan.unreached, plan.floor);
  if (!findings.any_error() && engrave.clears && !plan.floor.empty()) {
    engrave.clearing.depth = plan.floor_z;
    PocketPlan floor = plan_pocket(plan.floor, engrave.clearing, findings);
    warned = united(plan.unreached, floor.unreached);
    // The flat cutter goes first.
    std::ranges::move(plan.mill.tools, std::back_inserter(floor.mill.tools));
    plan.mill.tools = std::move(floor.mill.tools);
  }
  show(findings);
  if (findings.any_error()) return exit_bad_program;
  const double stays = area_mm2(warned);
  std::string words = size_words(*part) + fmt::format("{:.4g} mm² carved, {:.4g} mm deep at most\n",
                                                      area_mm2(area) - stays, -to_mm(plan.deepest).value());
  if (stays > 0) {
    words +=
        fmt::format("not reached: {:.4g} mm², too wide for the V-shaped cutter{}\n", stays,
                    engrave.clears ? ", too narrow for the flat one, or for the tip" : ": --clear D, a flat cutter");
  }
  nlohmann::ordered_json json = {
      {"area_mm2", area_mm2(area)}, {"unreached_mm2", stays}, {"deepest_mm", to_mm(plan.deepest).value()}};
  return deliver(arguments, job, {plan.mill, area, warned, {}, words, json.dump(2)});
}

}  // namespace passo
