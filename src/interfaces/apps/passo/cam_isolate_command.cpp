// passo cam isolate: a program that mills free the copper of a layer.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "cam_job.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/sensible_number.hpp"
#include "passo/cam/isolation.hpp"
#include "passo/cam/isolation_proof.hpp"

namespace passo {
namespace {

std::string mm_words(Nanometres length) {
  return fmt::format("{:.4g} mm", to_mm(length).value());
}

void add_v_cutter(const CamIsolateArguments& arguments, Nanometres depth, LengthArguments& lengths,
                  std::vector<IsolationCutter>& cutters) {
  const std::size_t comma = arguments.v.find(',');
  double angle = 0;
  try {
    angle = std::stod(arguments.v);
  } catch (const std::exception&) {
    angle = 0;
  }
  if (comma == std::string::npos || !(angle > 0 && angle < 180)) {
    lengths.refuse(
        fmt::format("--v: expected ANGLE,TIP with an angle in degrees, e.g. 30,0.1, found '{}'", arguments.v));
    return;
  }
  const Nanometres tip = lengths.any("--v", arguments.v.substr(comma + 1));
  const Nanometres width = v_cutter_width(tip, angle, {-depth.count});
  if (tip.count < 0 || width.count <= 0) lengths.refuse("--v: expected a tip of 0 or more");
  cutters.push_back(
      {width, fmt::format("V {:g} degrees, tip {}: {} at the face", angle, mm_words(tip), mm_words(width))});
}

IsolationOptions options_of(const CamIsolateArguments& arguments, const MillJob& job, LengthArguments& lengths) {
  IsolationOptions options;
  options.depth = lengths.below_0("--depth", arguments.depth, "-0.05");
  if (!arguments.tools.empty()) {
    for (const Nanometres width : lengths.list("--tool", arguments.tools)) {
      constexpr std::int64_t finest = 1'000;  // nm
      if (width.count < finest) lengths.refuse("--tool: expected widths of 0.001 mm or more");
      options.cutters.push_back({width, "cutter " + mm_words(width)});
    }
  }
  if (!arguments.v.empty()) add_v_cutter(arguments, options.depth, lengths, options.cutters);
  if (options.cutters.empty()) lengths.refuse("expected a cutter, e.g. --tool 0.2 or --v 30,0.1 (angle, tip width)");
  options.passes = arguments.passes;
  options.width = lengths.perhaps("--width", arguments.width);
  options.overlap = arguments.overlap / 100;
  options.clear = arguments.clear;
  options.voronoi = arguments.voronoi;
  if (options.clear && options.voronoi) lengths.refuse("--clear and --voronoi cannot be combined");
  options.climb = !arguments.conventional;
  options.tolerance = lengths.above_0("--tolerance", arguments.tolerance);
  options.park = job.program.park;
  return options;
}

nlohmann::ordered_json as_json(const IsolationPlan& plan, const IsolationProof& proof, DrawnPoint park) {
  nlohmann::ordered_json tools = nlohmann::ordered_json::array();
  for (const MillTool& tool : plan.mill.tools) {
    const MillLengths lengths = lengths_of(tool, park);
    tools.push_back({{"words", tool.words},
                     {"width_mm", to_mm(tool.width).value()},
                     {"runs", lengths.runs},
                     {"milled_mm", lengths.milled_nm / nanometres_per_mm},
                     {"rapids_mm", lengths.rapids_nm / nanometres_per_mm}});
  }
  nlohmann::ordered_json gaps = nlohmann::ordered_json::array();
  for (const CopperGap& gap : plan.gaps) {
    gaps.push_back(
        {{"x_mm", to_mm(gap.at.x).value()}, {"y_mm", to_mm(gap.at.y).value()}, {"width_mm", to_mm(gap.width).value()}});
  }
  nlohmann::ordered_json openings = nlohmann::ordered_json::array();
  for (const DrawnPoint& at : plan.narrow_openings) {
    openings.push_back({{"x_mm", to_mm(at.x).value()}, {"y_mm", to_mm(at.y).value()}});
  }
  return {{"tools", tools},
          {"islands", proof.islands},
          {"gaps", gaps},
          {"narrow_openings", openings},
          {"proof",
           {{"copper_mm2", proof.copper_mm2},
            {"lost_mm2", proof.lost_mm2},
            {"milled_mm2", proof.milled_mm2},
            {"joined", proof.joined},
            {"groups", proof.groups}}}};
}

std::string proof_words(const IsolationProof& proof) {
  std::string text =
      fmt::format("proof: {} mm² milled, {:g} of {} mm² of copper lost; {}", sensible_number(proof.milled_mm2, 4),
                  proof.lost_mm2, sensible_number(proof.copper_mm2, 4), counted(proof.islands, "island"));
  return text + (proof.joined == 0
                     ? ", all apart\n"
                     : fmt::format(", {} of them still joined in {}\n", proof.joined, counted(proof.groups, "piece")));
}

// `of`: the copper.
void note_gaps(const IsolationPlan& plan, const std::string& of) {
  constexpr std::size_t most_told = 5;
  for (std::size_t i = 0; i < std::min(most_told, plan.gaps.size()); ++i) {
    const CopperGap& gap = plan.gaps[i];
    note(fmt::format("{}: the cutter does not fit between two islands at X{:.4f} Y{:.4f} mm, which are {} apart", of,
                     to_mm(gap.at.x).value(), to_mm(gap.at.y).value(), mm_words(gap.width)));
  }
  if (plan.gaps.size() > most_told) {
    note(fmt::format("{}: and {} more; --json lists them, --picture marks them", of,
                     counted(plan.gaps.size() - most_told, "gap")));
  }
  if (!plan.narrow_openings.empty()) {
    const DrawnPoint& at = plan.narrow_openings.front();
    note(fmt::format(
        "{}: {} in the copper, e.g. of thermal reliefs, too narrow for the cutter, so copper remains there; the first "
        "at X{:.4f} Y{:.4f} mm",
        of,
        plan.narrow_openings.size() == 1 ? "1 opening is" : counted(plan.narrow_openings.size(), "opening") + " are",
        to_mm(at.x).value(), to_mm(at.y).value()));
  }
}

// The board inside the edge drawing; its findings are shown.
std::optional<Region> board_of(const std::string& edge, Nanometres join, MillJob job) {
  job.reading.is_edge = true;
  job.reading.dxf.layers.clear();  // they are of the copper
  const std::optional<BoardLayer> layer = read_layers({edge}, job);
  if (!layer) return std::nullopt;
  Diagnostics findings;
  Region board = board_edge(*layer, join, findings).board;
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return board;
}

std::optional<CamSources> read(const CamIsolateArguments& arguments, Nanometres join, const MillJob& job) {
  CamSources sources;
  std::optional<BoardLayer> layer = read_layers(arguments.files, job);
  if (!layer) return std::nullopt;
  sources.layer = std::move(*layer);
  if (arguments.edge.empty()) return sources;
  std::optional<Region> board = board_of(arguments.edge, join, job);
  if (!board) return std::nullopt;
  sources.board = std::move(*board);
  return sources;
}

}  // namespace

int cam_isolate(const CamIsolateArguments& arguments, const WorkProgress& progress, const CamSources* given,
                CamMade* made) {
  if (!outputs_are_good(arguments, arguments.edge)) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob job = mill_job_of(arguments, "passo cam isolate", lengths);
  IsolationOptions options = options_of(arguments, job, lengths);
  const Nanometres join = lengths.any("--join", arguments.join);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());

  const std::optional<CamSources> sources = given != nullptr ? *given : read(arguments, join, job);
  if (!sources) return exit_bad_program;
  Diagnostics findings;
  Region copper = mirrored(covered_by(sources->layer, sources->board, findings), job.mirror);
  if (findings.any_error()) {
    show(findings);
    return exit_bad_program;
  }
  options.board = mirrored(sources->board, job.mirror);
  if (const std::optional<DrawnBox> box = bounds(copper); options.clear && options.board.empty() && box) {
    options.board = grown(filled({rectangle(*box)}), {2'000'000});
  }
  move_to_zero(job.zero, options.board.empty() ? copper : options.board, {&copper, &options.board});

  progress.update(0.05);
  const IsolationPlan plan = plan_isolation(copper, options, findings, progress.part(0.05, 0.6));
  if (findings.any_error()) {
    show(findings, sources->layer.lines.file);
    return exit_bad_program;
  }
  const IsolationProof proof =
      prove_isolation(copper, plan.mill, options.voronoi ? options.board : Region{}, progress.part(0.6, 0.9));
  if (proof.lost_mm2 > 0) {
    return fail(exit_failed,
                fmt::format("the program would remove {:g} mm² of the circuit's copper, so it was not written",
                            proof.lost_mm2));
  }
  for (const std::string& words : plan.mill.notes) note(words);
  note_gaps(plan, std::filesystem::path(sources->layer.lines.file).filename().string());
  if (const int code = write_text(arguments.output, write_mill_program(plan.mill, job.program)); code != exit_done) {
    return code;
  }
  progress.update(0.95);
  if (!arguments.picture.empty()) {
    MillScene scene{plan.mill, copper, "Copper", plan.unmilled, {}, "Gap too narrow", options.park};
    for (const CopperGap& gap : plan.gaps) scene.marks.push_back(gap.at);
    std::ranges::copy(plan.narrow_openings, std::back_inserter(scene.marks));
    const int code = write_picture(
        arguments.picture, job.program.name,
        [&](const PictureOptions& picture, OutputFile& file) { return draw_mill_plan(scene, picture, file); });
    if (code != exit_done) return code;
  }
  progress.update(1);
  if (arguments.json) {
    fmt::print("{}\n", as_json(plan, proof, options.park).dump(2));
    return exit_done;
  }
  return tell(arguments.output, plan.mill, summary_of(plan.mill, options.park, arguments.units) + proof_words(proof),
              made);
}

}  // namespace passo
