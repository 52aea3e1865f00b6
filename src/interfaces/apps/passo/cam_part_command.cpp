// passo cam profile and passo cam pocket: programs that cut parts and pockets from drawings.
#include <algorithm>
#include <cmath>

#include "cam_part.hpp"
#include "cam_profile_nest.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include "chamfer_cut.hpp"
#include "loose_pieces.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/cam/pocket.hpp"
#include "passo/cam/profile.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
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

bool is_gerber(const std::string& file) {
  Diagnostics findings;  // those of the reader are shown
  const auto bytes = read_bytes(file, {.area = "drawing", .expected = "a drawing or a Gerber layer"}, findings);
  return bytes && looks_like_gerber(*bytes);
}

// What a pocket program clears.
struct PocketGround {
  PartDrawing part;
  Region area;
};

// Of Gerber layers: what they draw, for a mask or stencil its openings.
std::optional<PocketGround> drawn_on_layers(const CamPocketArguments& arguments, const MillJob& job) {
  if (!arguments.layers.empty() || !arguments.colors.empty() || !arguments.names.empty()) {
    fail(exit_bad_program, "--layer, --color and --name select parts of drawings, but a Gerber file is a single layer");
    return std::nullopt;
  }
  const std::optional<BoardLayer> layer = read_layers(arguments.files, job);
  if (!layer) return std::nullopt;
  PocketGround ground;
  ground.area = mirrored(layer->bare ? united(layer->face, *layer->bare) : layer->face, job.mirror);
  move_to_zero(job.zero, ground.area, {&ground.area});
  const DrawnBox box = bounds(ground.area).value_or(DrawnBox{});
  ground.part.least = box.least;
  ground.part.most = box.most;
  Diagnostics findings;
  if (job.sheet) check_sheet(*job.sheet, box, listed(arguments.files), findings);
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return ground;
}

std::optional<PocketGround> read_ground(const CamPocketArguments& arguments, const MillJob& job, Nanometres join) {
  const auto layers = std::ranges::count_if(arguments.files, is_gerber);
  if (layers == std::ssize(arguments.files) && layers > 0) return drawn_on_layers(arguments, job);
  if (layers > 0) {
    fail(exit_bad_program,
         fmt::format("expected either drawings or Gerber layers, found both: {}", fmt::join(arguments.files, ", ")));
    return std::nullopt;
  }
  std::optional<PartDrawing> part = read_part(arguments, job, join, OpenRows::refused);
  if (!part) return std::nullopt;
  Region area = enclosed_by(part->loops.loops);
  return PocketGround{std::move(*part), std::move(area)};
}

std::string unreached_words(double mm2) {
  if (mm2 <= 0) return "";
  return fmt::format("not reached: {} mm² in corners and gaps narrower than the cutter\n", sensible_number(mm2, 4));
}

// To a square micrometre.
double told_loss(double mm2) {
  return std::round(mm2 * 1e6) / 1e6;
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
          {"links_mm", lengths.links_nm / nanometres_per_mm},
          {"rapids_mm", lengths.rapids_nm / nanometres_per_mm}};
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

// The stock that roughing leaves on walls.
Nanometres allowance_of(const CamFinishArguments& arguments, Nanometres cutter, LengthArguments& lengths) {
  if (arguments.allowance.empty()) return {arguments.finish_pass ? cutter.count / 20 : 0};
  const Nanometres allowance = lengths.any("--allowance", arguments.allowance);
  if (allowance.count < 0 || 4 * allowance.count > cutter.count) {
    lengths.refuse("--allowance: expected 0 to a quarter of the cutter's diameter");
  }
  if (arguments.finish_pass && allowance.count == 0) {
    lengths.refuse("--finish-pass needs an --allowance above 0");
  }
  return allowance;
}

void take_finish_feed(const CamFinishArguments& arguments, MillProgramOptions& program, LengthArguments& lengths) {
  if (arguments.finish_feed.empty()) return;
  program.finish_feed = lengths.above_0("--finish-feed", arguments.finish_feed);
}

// One line on allowances, or none.
std::string finish_words(const CamFinishArguments& arguments, Nanometres allowance, std::size_t finished) {
  if (allowance.count <= 0 || (arguments.finish_pass && finished == 0)) return "";
  const double mm = to_mm(allowance).value();
  if (!arguments.finish_pass) return fmt::format("allowance: {:.4g} mm left on the walls\n", mm);
  const std::string springs =
      arguments.spring_passes == 0 ? "" : fmt::format(", and {} each", counted(arguments.spring_passes, "spring lap"));
  return fmt::format("finishing: {} of {:.4g} mm at full depth{}\n", counted(finished, "lap"), mm, springs);
}

// The cutter of a chamfer: it goes deeper than the chamfer, far enough from the edge that its tip is clear of it.
struct ChamferCut {
  Nanometres beside;  // from the edge to the cutter's centre
  Nanometres depth;
};
ChamferCut chamfer_of(const CamProfileArguments& arguments, LengthArguments& lengths) {
  const Nanometres width = lengths.above_0("--chamfer", arguments.chamfer);
  const Nanometres tip = lengths.any("--tip", arguments.tip);
  if (tip.count < 0) lengths.refuse("--tip: expected a width of 0 or more");
  // use_tools() knows the cutter that --tool names; here only its greatest possible width is known.
  if (const double most = most_chamfer_mm(widest_vee_mm, to_mm(tip).value()); to_mm(width).value() > most) {
    lengths.refuse(fmt::format("--chamfer: expected at most {:g} mm, with a cutter of {:g} mm, found '{}'", most,
                               widest_vee_mm, arguments.chamfer));
  }
  const double depth = chamfer_depth_mm(to_mm(width).value(), arguments.angle);
  return {{tip.count / 2 + std::llround(chamfer_margin_mm * nanometres_per_mm)},
          {-std::llround(depth * nanometres_per_mm)}};
}

// Cuts along the contours with the flank of a V-bit, in one pass. It keeps the same distance from all contours, so it
// cuts no more than the chamfer from any of them.
void take_chamfer(const CamProfileArguments& arguments, OutlineOptions& cut, LengthArguments& lengths) {
  if (arguments.finish_pass || !arguments.allowance.empty() || arguments.side == "on" || arguments.dog_bones) {
    lengths.refuse("--chamfer cannot be combined with --allowance, --finish-pass, --dog-bones or --side on");
  }
  const ChamferCut chamfer = chamfer_of(arguments, lengths);
  cut.cutter = {2 * chamfer.beside.count};
  cut.words = fmt::format("V-bit of {:g} degrees for a chamfer", arguments.angle);
  cut.depth = chamfer.depth;
  cut.step = {-chamfer.depth.count};
  cut.tabs = 0;
  cut.ramp_degrees = 0;
}

std::string chamfer_words(const CamProfileArguments& arguments, const OutlineOptions& cut) {
  return fmt::format("chamfer {}: the tip is at Z{:.4g} mm, its centre {:.4g} mm beside the edge\n", arguments.chamfer,
                     to_mm(cut.depth).value(), to_mm(cut.cutter).value() / 2);
}

std::string milling_words(bool climb) {
  return climb ? "climb milling\n" : "conventional milling\n";
}

std::string unfinished_words(std::size_t count, const char* what) {
  if (count == 0) return "";
  return fmt::format("{} cut without an allowance, for lack of room\n", counted(count, what));
}

std::string tight_words(std::size_t count, Nanometres cutter) {
  if (count == 0) return "";
  return fmt::format("{} as wide as the cutter, within {:g} mm, along the centre line\n", counted(count, "cut"),
                     to_mm(tight_cut_tolerance(cutter)).value());
}

// What is cut of a drawing, or of a sheet.
struct CutProfile {
  ProfilePlan plan = {};
  std::string words = {};
  nlohmann::ordered_json json = {};
};

std::optional<CutProfile> cut_profile(const CamProfileArguments& arguments, const PartDrawing& part,
                                      const ProfileOptions& options) {
  Diagnostics findings;
  CutProfile made{.plan = plan_profile(part.loops.loops, part.loops.open, options, findings)};
  show(findings, listed(arguments.files));
  if (findings.any_error()) return std::nullopt;
  const ProfilePlan& plan = made.plan;
  const OutlinePlan& cut = plan.outline;
  std::string& words = made.words;
  nlohmann::ordered_json& json = made.json;
  words = size_words(part);
  json = lengths_json(cut.mill, options.cut.park);
  if (options.side == ProfileSide::on) {
    words += fmt::format("{} and {}, {}\n", counted(cut.outsides, "closed line"), open_lines(plan),
                         counted(cut.tabs.size(), "tab"));
    json["closed"] = cut.outsides;
    json["open"] = plan.lines;
    json["dots"] = plan.dots;
    json["tabs"] = cut.tabs.size();
  } else {
    words += fmt::format("{} and {}, {}; {:g} mm² of the part lost\n", counted(cut.outsides, "outside"),
                         counted(cut.openings, "inside"), counted(cut.tabs.size(), "tab"), told_loss(cut.lost_mm2));
    words += !arguments.chamfer.empty() ? chamfer_words(arguments, options.cut) : unreached_words(plan.unreached_mm2);
    words += tight_words(cut.tight, options.cut.cutter) + finish_words(arguments, options.cut.allowance, cut.finished);
    words += unfinished_words(cut.unfinished, "contour") + milling_words(options.cut.climb);
    json["outsides"] = cut.outsides;
    json["insides"] = cut.openings;
    json["tabs"] = cut.tabs.size();
    json["lost_mm2"] = cut.lost_mm2;
    json["unreached_mm2"] = plan.unreached_mm2;
    json["tight"] = cut.tight;
    json["finished"] = cut.finished;
    json["unfinished"] = cut.unfinished;
    json["climb"] = options.cut.climb;
  }
  words += joined_words(part.loops);
  return made;
}

// Islands of scrap between the slots, and parts that have lost their tabs. Without tabs, parts are meant to come loose.
std::vector<LoosePiece> loose_pieces_of(const CutProfile& cut, const ProfileOptions& options,
                                        const NestedDrawing& nested, std::size_t sheet) {
  if (nested.nest.sheets[sheet].placements.size() < 2) return {};
  std::vector<LoosePiece> pieces =
      pieces_cut_free(cut.plan.outline.mill, options.cut.depth, DrawnBox{{}, nested.options.sheet}, cut.plan.face);
  if (options.cut.tabs == 0) std::erase_if(pieces, &LoosePiece::is_part);
  return pieces;
}

void warn_of_loose_pieces(const std::vector<std::vector<LoosePiece>>& sheets, const std::string& file) {
  Diagnostics findings;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    if (sheets[i].empty()) continue;
    Diagnostic finding = of_file("nest.loose", file, describe(sheets[i], sheets.size() > 1 ? i + 1 : 0),
                                 "a larger --gap, or tape or a vacuum below the sheet");
    finding.severity = Severity::warning;
    findings.add(std::move(finding));
  }
  show(findings);
}

// A program for each sheet; all are planned before the first is written.
int cut_sheets(const CamProfileArguments& arguments, MillJob& job, const ProfileOptions& options,
               const NestedDrawing& nested, const WorkProgress& progress) {
  const std::size_t sheets = nested.sheets.size();
  if (sheets > arguments.most_sheets) {
    return fail(exit_bad_program,
                fmt::format("--most-sheets: expected at least {} for {} of each part, found {}; or "
                            "fewer copies or a larger --nest",
                            sheets, counted(arguments.quantity, "copy", "copies"), arguments.most_sheets));
  }
  if (sheets > 1 && (arguments.output.empty() || arguments.output == "-")) {
    return fail(exit_bad_program, fmt::format("{} sheets have a program each; --output must name a file", sheets));
  }
  std::vector<CutProfile> cuts;
  std::vector<std::vector<LoosePiece>> loose;
  std::vector<CamProfileArguments> orders(sheets, arguments);
  for (std::size_t i = 0; i < sheets; ++i) {
    orders[i].output = sheet_file(arguments.output, i, sheets);
    orders[i].picture = sheet_file(arguments.picture, i, sheets);
    if (sheets > 1 && !outputs_are_good(orders[i], "")) return exit_bad_program;
    auto cut = cut_profile(arguments, nested.sheets[i], options);
    if (!cut) return exit_bad_program;
    loose.push_back(loose_pieces_of(*cut, options, nested, i));
    cuts.push_back(std::move(*cut));
  }
  warn_of_loose_pieces(loose, listed(arguments.files));
  nlohmann::ordered_json all = cuts.front().json;
  if (sheets > 1) {
    all = {{"programs", nlohmann::ordered_json::array()}};
    for (const CutProfile& cut : cuts) all["programs"].push_back(cut.json);
  }
  all["nest"] = nest_json(nested.nest, nested.options, {});
  for (std::size_t i = 0; i < sheets; ++i) all["nest"]["sheets"][i]["loose"] = loose_json(loose[i]);
  job.sheet = DrawnBox{{}, nested.options.sheet};
  for (std::size_t i = 0; i < sheets; ++i) {
    const CutProfile& cut = cuts[i];
    const bool is_last = i + 1 == sheets;
    const std::string name = sheets > 1 ? fmt::format("{}:\n", orders[i].output) : "";
    const std::string words = name + cut.words + (is_last ? nest_words(nested.nest, nested.options, nested.parts) : "");
    const int code =
        deliver(orders[i], job,
                {cut.plan.outline.mill, cut.plan.face, cut.plan.unreached, cut.plan.outline.tabs, words,
                 is_last ? all : nlohmann::ordered_json(), nested.nest.sheets[i].used + nested.options.margin},
                progress.stage(i, sheets));
    if (code != exit_done) return code;
  }
  return exit_done;
}

}  // namespace

int cam_profile(const CamProfileArguments& arguments, const WorkProgress& progress) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob job = mill_job_of(arguments, "passo cam profile", lengths, "stock");
  ProfileOptions options{.cut = outline_options_of(arguments, job, lengths), .side = side_of(arguments.side)};
  const bool is_chamfer = !arguments.chamfer.empty();
  options.cut.allowance = allowance_of(arguments, options.cut.cutter, lengths);
  options.cut.finishes = arguments.finish_pass;
  options.cut.spring_passes = arguments.spring_passes;
  take_finish_feed(arguments, job.program, lengths);
  if (is_chamfer) take_chamfer(arguments, options.cut, lengths);
  const Nanometres join = join_of(arguments.join, lengths);
  const bool is_nested = !arguments.nest.empty();
  const NestOptions nesting = is_nested ? nest_options_of(arguments, options.cut, lengths) : NestOptions{};
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  const bool is_on = options.side == ProfileSide::on;
  if (is_on && (!options.cut.tab_places.empty() || options.cut.lead.count > 0 || options.cut.dog_bones ||
                options.cut.allowance.count > 0)) {
    return fail(exit_bad_program, "--side on cannot be combined with --tab, --lead, --dog-bones or an allowance");
  }
  job.program.remarks.push_back(options.cut.climb ? "climb milling" : "conventional milling");

  const std::optional<PartDrawing> part = read_part(arguments, job, join, is_on ? OpenRows::kept : OpenRows::refused);
  if (!part) return exit_bad_program;
  if (is_nested) {
    const auto nested =
        nest_drawing(*part, listed(arguments.files), arguments.quantity, nesting, progress.part(0.02, 0.6));
    if (!nested) return exit_bad_program;
    warn_of_cut_tabs(nested->nest, nesting, options.cut, listed(arguments.files));
    return cut_sheets(arguments, job, options, *nested, progress.part(0.6, 1));
  }
  const std::optional<CutProfile> cut = cut_profile(arguments, *part, options);
  if (!cut) return exit_bad_program;
  const ProfilePlan& plan = cut->plan;
  return deliver(arguments, job,
                 {plan.outline.mill, plan.face, plan.unreached, plan.outline.tabs, cut->words, cut->json},
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
  options.allowance = allowance_of(arguments, options.cutter, lengths);
  options.floor_allowance = lengths.any("--floor-allowance", arguments.floor_allowance);
  if (options.floor_allowance.count < 0 || options.floor_allowance > options.step ||
      options.floor_allowance.count >= -options.depth.count) {
    lengths.refuse("--floor-allowance: expected 0 to --step, and less than the depth");
  }
  options.finishes = arguments.finish_pass;
  options.spring_passes = arguments.spring_passes;
  options.lead = lengths.perhaps("--lead", arguments.lead).value_or(Nanometres{options.cutter.count / 4});
  take_finish_feed(arguments, job.program, lengths);
  if (!arguments.link_feed.empty()) job.program.link_feed = lengths.above_0("--link-feed", arguments.link_feed);
  options.ramp_degrees = arguments.ramp;
  options.most_engagement = arguments.engagement;
  options.climb = !arguments.conventional;
  options.park = job.program.park;
  job.program.remarks.push_back(options.climb ? "climb milling" : "conventional milling");
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

  const std::optional<PocketGround> ground = read_ground(arguments, job, join);
  if (!ground) return exit_bad_program;
  Diagnostics findings;
  const Region& area = ground->area;
  const bool is_constant = options.most_engagement > 0;
  const PocketPlan plan = plan_pocket(area, options, findings, progress.part(0.02, 0.9));
  show(findings, listed(arguments.files));
  if (findings.any_error()) return exit_bad_program;
  const std::string words =
      size_words(ground->part) +
      fmt::format("{} of {} mm², {} per layer; {:g} mm² of the part lost\n", counted(plan.pockets, "pocket"),
                  sensible_number(area_mm2(area), 4), counted(plan.loops, is_constant ? "disc" : "loop"),
                  told_loss(plan.lost_mm2)) +
      (is_constant ? fmt::format("engagement: at most {:.1f} degrees, except on the way down\n", plan.engagement)
                   : std::string()) +
      unreached_words(plan.unreached_mm2) + tight_words(plan.tight, options.cutter) +
      finish_words(arguments, options.allowance, plan.finished) + unfinished_words(plan.unfinished, "pocket") +
      milling_words(options.climb) + joined_words(ground->part.loops);
  nlohmann::ordered_json json = lengths_json(plan.mill, options.park);
  json["pockets"] = plan.pockets;
  json[is_constant ? "discs" : "loops"] = plan.loops;
  if (is_constant) json["engagement_degrees"] = plan.engagement;
  json["area_mm2"] = area_mm2(area);
  json["lost_mm2"] = plan.lost_mm2;
  json["unreached_mm2"] = plan.unreached_mm2;
  json["tight"] = plan.tight;
  json["finished"] = plan.finished;
  json["unfinished"] = plan.unfinished;
  json["climb"] = options.climb;
  return deliver(arguments, job, {plan.mill, area, plan.unreached, {}, words, json}, progress.part(0.9, 1));
}

}  // namespace passo
