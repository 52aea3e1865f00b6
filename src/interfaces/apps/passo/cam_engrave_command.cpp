// passo cam engrave: a program that carves texts and drawings with a V-shaped cutter.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>

#include "cam_part.hpp"
#include "traced_picture.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/sensible_number.hpp"
#include "passo/cam/font_file.hpp"
#include "passo/cam/lettering.hpp"
#include "passo/cam/pocket.hpp"
#include "passo/cam/profile.hpp"
#include "passo/cam/stroke_font.hpp"
#include "passo/cam/v_carve.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

struct EngraveJob {
  VCarveOptions carving;
  PocketOptions clearing;  // of floors
  bool clears = false;
  bool is_on_line = false;  // letters of single lines, or --on-line
  bool is_inlay = false;
  Nanometres crest = {};   // of an inlay: height of the crests that the V-bit may leave on the floor
  bool is_plug = false;    // what is drawn stays, and its surroundings are carved
  Nanometres margin = {};  // around the plug
  Lettering lettering;
};

// --arc FROM,TO: degrees, which have no unit.
std::optional<LetterArc> arc_of(const CamEngraveArguments& arguments, LengthArguments& lengths) {
  LetterArc arc;
  const char* const text = arguments.arc.data();
  const char* const end = text + arguments.arc.size();
  const auto from = std::from_chars(text, end, arc.from);
  const bool has_two = from.ec == std::errc() && from.ptr != end && *from.ptr == ',';
  const auto to = has_two ? std::from_chars(from.ptr + 1, end, arc.to) : from;
  constexpr double most = 3600;
  const bool is_good =
      has_two && to.ec == std::errc() && to.ptr == end && std::abs(arc.from) <= most && std::abs(arc.to) <= most;
  if (!is_good)
    lengths.refuse(fmt::format("--arc: expected FROM,TO in degrees, e.g. 150,30, found '{}'", arguments.arc));
  if (arguments.around.empty()) lengths.refuse("--arc also needs --around R, the radius of the arc");
  return arc;
}

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
  lettering.turn_degrees = arguments.turn;
  if (!arguments.arc.empty()) lettering.arc = arc_of(arguments, lengths);
  return lettering;
}

// A plug hangs in its pocket with its lines at the other's face: it is carved deeper, by all but the gap for glue.
void choose_inlay(const CamEngraveArguments& arguments, EngraveJob& engrave, LengthArguments& lengths) {
  if (arguments.inlay.empty()) return;
  if (!arguments.depth.empty()) lengths.refuse("--inlay: expected --inlay-depth, not --depth");
  VCarveOptions& carving = engrave.carving;
  const Nanometres depth = lengths.above_0("--inlay-depth", arguments.inlay_depth);
  const Nanometres glue = lengths.any("--glue-gap", arguments.glue_gap);
  const Nanometres saw = lengths.above_0("--saw-gap", arguments.saw_gap);
  if (glue.count < 0 || glue >= depth) lengths.refuse("--glue-gap: expected 0 or more, and less than --inlay-depth");
  engrave.is_inlay = true;
  constexpr Nanometres highest_crest{100'000};
  constexpr Nanometres lowest_crest{20'000};
  engrave.crest = std::clamp(Nanometres{glue.count / 2}, lowest_crest, highest_crest);
  engrave.is_plug = arguments.inlay == "plug";
  engrave.margin = lengths.above_0("--margin", arguments.margin);
  carving.deepest = {engrave.is_plug ? -saw.count : -depth.count};
  if (engrave.is_plug) carving.start = {glue.count - depth.count};
  const double slope = std::tan(carving.angle_degrees / 360 * std::numbers::pi);
  const auto whole = static_cast<double>(-carving.start.count - carving.deepest.count);
  const Nanometres needed{carving.tip.count + std::llround(2 * slope * whole)};
  if (carving.widest < needed) {
    lengths.refuse(fmt::format("--tool: expected {:.4g} mm or more, as wide as the cutter is at this depth",
                               std::ceil(to_mm(needed).value() * 100) / 100));
  }
}

// A lift takes about a third of a second, plus the time for the last half millimetre of the descent and for the plunge
// into the stock. A return that takes no longer is preferred, because it leaves no mark.
Nanometres longest_return_of(const MillProgramOptions& program) {
  constexpr double to_accelerate = 1.0 / 180;  // min
  constexpr double down = 1e6;                 // nm
  const double minutes = to_accelerate + down / static_cast<double>(program.plunge_feed.count);
  return {std::llround(std::min(minutes * static_cast<double>(program.feed.count), 1e9))};
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
  if (!arguments.step.empty()) {
    constexpr Nanometres least_step{10'000};
    carving.step = lengths.above_0("--step", arguments.step);
    if (carving.step < least_step) lengths.refuse("--step: expected 0.01 mm or more");
  }
  choose_inlay(arguments, engrave, lengths);
  carving.words = fmt::format("V of {:g} degrees, {:.4g} mm", arguments.angle, to_mm(carving.widest).value());
  if (carving.tip.count > 0) carving.words += fmt::format(", tip {:.4g} mm", to_mm(carving.tip).value());
  carving.park = job.program.park;
  carving.longest_return = longest_return_of(job.program);
  engrave.clears = !arguments.clear.empty();
  if (engrave.clears) {
    engrave.clearing.cutter = lengths.above_0("--clear", arguments.clear);
    engrave.clearing.words = fmt::format("flat cutter {:.4g} mm", to_mm(engrave.clearing.cutter).value());
    engrave.clearing.climb = !arguments.conventional;
    engrave.clearing.park = job.program.park;
  }
  engrave.clearing.step = lengths.above_0("--clear-step", arguments.clear_step);
  engrave.is_on_line = arguments.on_line;
  engrave.lettering = lettering_of(arguments, lengths);
  return engrave;
}

// The file of --font: a file, or that of an installed font.
std::string font_path(const std::string& font, Lettering& lettering, Diagnostics& findings) {
  if (names_font_file(font) || std::filesystem::exists(font)) return font;
  const std::optional<FontFile> installed = find_font(font, findings);
  if (!installed) return "";
  note(fmt::format("--font {}: {}, {}", font, installed->name, installed->path));
  lettering.face = installed->face;
  return installed->path;
}

// The outlines of pictures, as one drawing.
std::optional<Drawing> traced(const CamEngraveArguments& arguments) {
  LengthArguments lengths(*mm_of_unit(arguments.units));
  const PictureTraceOptions options{.threshold = arguments.threshold / 100,
                                    .invert = arguments.invert,
                                    .turdsize = static_cast<std::uint32_t>(arguments.turdsize),
                                    .width = to_mm(lengths.above_0("--width", arguments.width))};
  constexpr Mm widest(4000);
  if (options.width > widest) lengths.refuse("--width: expected at most 4 m");
  if (!lengths.message().empty()) {
    fail(exit_bad_program, lengths.message());
    return std::nullopt;
  }
  Diagnostics findings;
  Drawing all;
  for (const std::string& file : arguments.files) {
    Drawing one = trace_picture(file, options, findings);
    all.file = file;
    std::ranges::move(one.paths, std::back_inserter(all.paths));
  }
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return all;
}

// The letters or the files as a drawing. Letters of single lines are followed, not carved.
std::optional<Drawing> drawing_of(const CamEngraveArguments& arguments, const MillJob& job, EngraveJob& engrave) {
  if (arguments.trace) return traced(arguments);
  if (arguments.text.empty()) return read_drawings(arguments, job);
  Diagnostics findings;
  Drawing drawing;
  if (arguments.font == "simplex") {
    engrave.is_on_line = true;
    drawing = letter_simplex(engrave.lettering, findings);
  } else if (const std::string path = font_path(arguments.font, engrave.lettering, findings); !path.empty()) {
    const auto font = read_bytes(path, {.area = "engrave", .expected = "--font FILE: a font"}, findings);
    if (font) {
      engrave.is_on_line |= looks_like_stroke_font(*font);
      drawing = letter(engrave.lettering, path, *font, findings);
    }
  }
  show(findings, "--text");
  if (findings.any_error()) return std::nullopt;
  return drawing;
}

// The tip of the cutter on the lines.
int engrave_lines(const CamEngraveArguments& arguments, const MillJob& job, const EngraveJob& engrave,
                  const PartDrawing& part, const WorkProgress& progress) {
  const VCarveOptions& carving = engrave.carving;
  ProfileOptions options{.side = ProfileSide::on};
  constexpr Nanometres usual_depth{-300'000};
  options.cut.depth = carving.deepest.count < 0 ? carving.deepest : usual_depth;
  options.cut.step = carving.step.count > 0 ? carving.step : engrave.clearing.step;
  options.cut.words = carving.words;
  options.cut.park = job.program.park;
  const double slope = std::tan(carving.angle_degrees / 360 * std::numbers::pi);
  const auto flanks = std::llround(-2 * slope * static_cast<double>(options.cut.depth.count));
  options.cut.cutter = std::min(carving.widest, Nanometres{carving.tip.count + flanks});
  Diagnostics findings;
  const ProfilePlan plan = plan_profile(part.loops.loops, part.loops.open, options, findings);
  show(findings, arguments.files.empty() ? "--text" : listed(arguments.files));
  if (findings.any_error()) return exit_bad_program;
  const double width = to_mm(options.cut.cutter).value();
  const double depth = -to_mm(options.cut.depth).value();
  const std::string words =
      size_words(part) + fmt::format("{} and {}, {:.4g} mm deep, {:.4g} mm wide\n",
                                     counted(plan.outline.outsides, "closed line"), open_lines(plan), depth, width);
  const nlohmann::ordered_json json = {{"closed", plan.outline.outsides},
                                       {"open", plan.lines},
                                       {"dots", plan.dots},
                                       {"deepest_mm", depth},
                                       {"width_mm", width}};
  return deliver(arguments, job, {plan.outline.mill, plan.face, plan.unreached, {}, words, json},
                 progress.part(0.8, 1));
}

// What is carved: what is drawn, or around a plug.
Region carved_of(const PartDrawing& part, const EngraveJob& engrave) {
  Region drawn = enclosed_by(part.loops.loops);
  if (!engrave.is_plug || drawn.empty()) return drawn;
  const Nanometres margin = engrave.margin;
  const DrawnBox around{{part.least.x - margin, part.least.y - margin}, {part.most.x + margin, part.most.y + margin}};
  return subtracted(filled({rectangle(around)}), drawn);
}

// Mills the floors with the flat cutter, which goes first. Of an inlay, the V-bit mills away what the flat cutter is
// too wide for. Returns what is not reached.
Region cleared(VCarvePlan& plan, const EngraveJob& engrave, Diagnostics& findings, const WorkProgress& progress) {
  PocketOptions options = engrave.clearing;
  options.depth = plan.floor_z;
  Diagnostics of_floor;
  PocketPlan floor = plan_pocket(plan.floor, options, of_floor, progress);
  Region left = std::move(floor.unreached);
  bool is_cleaned = false;
  if (engrave.is_inlay && !plan.mill.tools.empty()) {
    // The crests between two ways of the tip stay below the plug.
    const VCarveOptions& carving = engrave.carving;
    const auto apart = std::llround(static_cast<double>(carving.tip.count) +
                                    2 * std::tan(carving.angle_degrees / 360 * std::numbers::pi) *
                                        static_cast<double>(engrave.crest.count));
    std::vector<MillRun> runs = clean_floor(left, plan.floor_z, {apart}, carving.step);
    is_cleaned = !runs.empty();
    if (is_cleaned) left = {};
    std::ranges::move(runs, std::back_inserter(plan.mill.tools.front().runs));
  }
  for (const Diagnostic& finding : of_floor.all()) {
    if (!is_cleaned || finding.code != "pocket.narrow") findings.add(finding);
  }
  std::ranges::move(plan.mill.tools, std::back_inserter(floor.mill.tools));
  plan.mill.tools = std::move(floor.mill.tools);
  return united(plan.unreached, left);
}

// The plug would stand on what stays.
int refuse_ridge(const EngraveJob& engrave, const Region& stays) {
  const DrawnPoint at = stays.rings.front().front();
  return fail(
      exit_bad_program,
      fmt::format("{:.4g} mm² of the floor cannot be milled, e.g. at X{:.4g} Y{:.4g} mm, so the halves would not "
                  "fit into each other: expected {}",
                  area_mm2(stays), to_mm(at.x).value(), to_mm(at.y).value(),
                  engrave.clears ? "a smaller --tip, a finer --clear or wider strokes"
                                 : "--clear D, a flat cutter that mills the floor"));
}

}  // namespace

int cam_engrave(const CamEngraveArguments& arguments, const WorkProgress& progress) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  if (arguments.text.empty() == arguments.files.empty()) {
    return fail(exit_bad_program, "expected either a drawing (FILE) or --text");
  }
  if (arguments.trace && arguments.files.empty()) return fail(exit_bad_program, "--trace: expected a picture (FILE)");
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob job = mill_job_of(arguments, "passo cam engrave", lengths, "stock");
  if (arguments.inlay == "plug" && arguments.mirror.empty()) job.mirror.turned = Mirror::Turned::x;
  if (!arguments.inlay.empty() && arguments.on_line)
    return fail(exit_bad_program, "--inlay carves areas, so it cannot be combined with --on-line");
  EngraveJob engrave = engrave_job_of(arguments, job, lengths);
  const Nanometres join = lengths.any("--join", arguments.join);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());

  std::optional<Drawing> drawing = drawing_of(arguments, job, engrave);
  if (!drawing) return exit_bad_program;
  if (engrave.is_on_line && (engrave.clears || !arguments.inlay.empty())) {
    return fail(exit_bad_program, "--clear and --inlay are for areas, not for a cutter that follows lines");
  }
  const std::optional<PartDrawing> part =
      part_of(std::move(*drawing), job, join, engrave.is_on_line ? OpenRows::kept : OpenRows::refused);
  if (!part) return exit_bad_program;
  if (engrave.is_on_line) return engrave_lines(arguments, job, engrave, *part, progress);
  const Region area = carved_of(*part, engrave);
  Diagnostics findings;
  VCarvePlan plan = plan_v_carve(area, engrave.carving, findings, progress.part(0.1, engrave.clears ? 0.8 : 0.9));
  Region warned = united(plan.unreached, plan.floor);
  if (!findings.any_error() && engrave.clears && !plan.floor.empty()) {
    warned = cleared(plan, engrave, findings, progress.part(0.8, 0.9));
  }
  show(findings, arguments.files.empty() ? "--text" : listed(arguments.files));
  if (findings.any_error()) return exit_bad_program;
  const double stays = area_mm2(warned);
  if (!arguments.inlay.empty() && stays > 0) return refuse_ridge(engrave, warned);
  std::string words =
      size_words(*part) + fmt::format("{} mm² carved, at most {:.4g} mm deep\n",
                                      sensible_number(area_mm2(area) - stays, 4), -to_mm(plan.deepest).value());
  if (plan.layers > 1) words += fmt::format("in {} layers\n", plan.layers);
  if (stays > 0) {
    words +=
        fmt::format("not reached: {} mm², too wide for the V-shaped cutter{}\n", sensible_number(stays, 4),
                    engrave.clears ? ", too narrow for the flat cutter or for the tip" : ": --clear D, a flat cutter");
  }
  nlohmann::ordered_json json = {{"area_mm2", area_mm2(area)},
                                 {"unreached_mm2", stays},
                                 {"deepest_mm", to_mm(plan.deepest).value()},
                                 {"layers", plan.layers}};
  return deliver(arguments, job, {plan.mill, area, warned, {}, words, json}, progress.part(0.9, 1));
}

}  // namespace passo
