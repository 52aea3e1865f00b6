// passo cam isolate: a program that mills free the copper of a layer.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "cam_job.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/sensible_number.hpp"
#include "passo/cam/isolation.hpp"
#include "passo/cam/isolation_advice.hpp"
#include "passo/cam/isolation_proof.hpp"
#include "passo/cam/joined_nets.hpp"

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
  options.allowed_loss = lengths.any("--allow-loss", arguments.allow_loss);
  constexpr std::int64_t most_loss = 1'000'000;  // nm
  if (options.allowed_loss.count < 0 || options.allowed_loss.count > most_loss)
    lengths.refuse("--allow-loss: expected 0 to 1 mm");
  options.least_trace = lengths.above_0("--least-trace", arguments.least_trace);
  options.park = job.program.park;
  return options;
}

// The copper of a board, and what is known about its nets, where the program mills it.
struct PlacedCopper {
  Region copper;
  Region board;  // empty: unknown
  std::vector<NetPlace> nets;
  std::size_t outside = 0;  // islands beside the board, which are left out
};

struct IsolationResult {
  IsolationPlan plan;
  IsolationProof proof;
  JoinedNets nets;
};

nlohmann::ordered_json place_json(DrawnPoint at) {
  return {{"x_mm", to_mm(at.x).value()}, {"y_mm", to_mm(at.y).value()}};
}

nlohmann::ordered_json as_json(const IsolationResult& result, DrawnPoint park) {
  nlohmann::ordered_json tools = nlohmann::ordered_json::array();
  for (const MillTool& tool : result.plan.mill.tools) {
    const MillLengths lengths = lengths_of(tool, park);
    tools.push_back({{"words", tool.words},
                     {"width_mm", to_mm(tool.width).value()},
                     {"runs", lengths.runs},
                     {"milled_mm", lengths.milled_nm / nanometres_per_mm},
                     {"rapids_mm", lengths.rapids_nm / nanometres_per_mm}});
  }
  nlohmann::ordered_json gaps = nlohmann::ordered_json::array();
  for (const CopperGap& gap : result.nets.gaps) {
    nlohmann::ordered_json one = place_json(gap.at);
    one["width_mm"] = to_mm(gap.width).value();
    one["nets"] = {result.nets.names[gap.one], result.nets.names[gap.other]};
    gaps.push_back(std::move(one));
  }
  nlohmann::ordered_json openings = nlohmann::ordered_json::array();
  for (const DrawnPoint& at : result.plan.narrow_openings) openings.push_back(place_json(at));
  const IsolationProof& proof = result.proof;
  return {{"tools", tools},
          {"islands", proof.islands},
          {"nets", result.nets.nets},
          {"gaps", gaps},
          {"narrow_openings", openings},
          {"proof",
           {{"copper_mm2", proof.copper_mm2},
            {"lost_mm2", proof.lost_mm2},
            {"deepest_mm", to_mm(proof.deepest).value()},
            {"milled_mm2", proof.milled_mm2},
            {"joined", result.nets.joined},
            {"groups", result.nets.groups},
            {"others_joined", result.nets.others}}}};
}

std::string loss_words(double lost_mm2, Nanometres deepest) {
  return fmt::format("{} mm² of copper lost, at most {:.3f} mm deep", sensible_number(lost_mm2, 2),
                     to_mm(deepest).value());
}

// "276 nets (23 in each of 12 copies)"
std::string net_words(const JoinedNets& nets, std::size_t islands, std::size_t copies) {
  std::string words = counted(nets.nets, "net");
  if (copies > 1 && nets.nets % copies == 0)
    words += fmt::format(" ({} in each of {} copies)", nets.nets / copies, copies);
  if (islands != nets.nets) words += " in " + counted(islands, "island");
  return words;
}

std::string proof_words(const IsolationResult& result, std::size_t copies) {
  const IsolationProof& proof = result.proof;
  const JoinedNets& nets = result.nets;
  std::string text =
      fmt::format("proof: {} mm² milled, {} of {} mm² of copper lost", sensible_number(proof.milled_mm2, 4),
                  proof.lost_mm2 > 0 ? sensible_number(proof.lost_mm2, 2) : "0", sensible_number(proof.copper_mm2, 4));
  if (proof.lost_mm2 > 0) text += fmt::format(", at most {:.3f} mm deep", to_mm(proof.deepest).value());
  text += "; " + net_words(nets, proof.islands, copies);
  text += nets.joined == 0 ? ", all apart"
                           : fmt::format(", {} of them still joined in {}", nets.joined, counted(nets.groups, "piece"));
  if (nets.others > 0) text += fmt::format("; {} without a pad still joined to others", counted(nets.others, "island"));
  return text + "\n";
}

std::string joined_words(const CopperGap& gap, const JoinedNets& nets) {
  const std::string& one = nets.names[gap.one];
  const std::string& other = nets.names[gap.other];
  return fmt::format("{} are still joined at X{:.4f} Y{:.4f} mm, where they are {} apart",
                     one.empty() || other.empty() ? "two islands" : fmt::format("{} and {}", one, other),
                     to_mm(gap.at.x).value(), to_mm(gap.at.y).value(), mm_words(gap.width));
}

// `of`: the copper.
void note_gaps(const IsolationResult& result, const std::string& of) {
  constexpr std::size_t most_told = 5;
  const std::vector<CopperGap>& gaps = result.nets.gaps;
  for (std::size_t i = 0; i < std::min(most_told, gaps.size()); ++i)
    note(of + ": " + joined_words(gaps[i], result.nets));
  if (gaps.size() > most_told) {
    note(fmt::format("{}: and {} more; --json lists them, --picture marks them", of,
                     counted(gaps.size() - most_told, "gap")));
  }
  const IsolationPlan& plan = result.plan;
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

// A cutter that could be used instead of the finest one, and the option that says so.
struct FinerCutters {
  std::vector<IsolationCutter> cutters;
  std::vector<std::string> options;
};

// Shallower cuts of a V-bit.
void add_shallower(const CamIsolateArguments& arguments, const IsolationOptions& options, FinerCutters& finer) {
  constexpr std::int64_t step = 10'000;        // nm
  constexpr std::int64_t shallowest = 40'000;  // copper is 0.035 mm thick
  const std::size_t comma = arguments.v.find(',');
  LengthArguments lengths(*mm_of_unit(arguments.units));
  const Nanometres tip = lengths.any("--v", arguments.v.substr(comma + 1));
  const double angle = std::strtod(arguments.v.c_str(), nullptr);
  for (std::int64_t depth = (-options.depth.count - 1) / step * step; depth >= shallowest; depth -= step) {
    const Nanometres width = v_cutter_width(tip, angle, {depth});
    finer.cutters.push_back({width, "V"});
    finer.options.push_back(fmt::format("--depth -{:g}mm", to_mm(Nanometres{depth}).value()));
  }
}

// The finest cutter itself, and those that are finer.
FinerCutters finer_cutters(const CamIsolateArguments& arguments, const IsolationOptions& options) {
  const auto finest = std::ranges::min_element(options.cutters, {}, &IsolationCutter::width);
  const bool is_v = !arguments.v.empty() && &*finest == &options.cutters.back();
  FinerCutters finer{{*finest}, {""}};
  if (is_v) {
    add_shallower(arguments, options, finer);
    return finer;
  }
  std::string others;
  for (const IsolationCutter& cutter : options.cutters) {
    const bool is_of_v = !arguments.v.empty() && &cutter == &options.cutters.back();
    if (&cutter != &*finest && !is_of_v) others += fmt::format("{:g}mm,", to_mm(cutter.width).value());
  }
  for (const std::int64_t width : {400'000, 300'000, 250'000, 200'000, 150'000, 120'000, 100'000}) {
    if (width >= finest->width.count) continue;
    const std::string words = fmt::format("{:g}mm", to_mm(Nanometres{width}).value());
    finer.cutters.push_back({{width}, "cutter " + words});
    finer.options.push_back("--tool " + others + words);
  }
  return finer;
}

// What would part the nets; it was tried.
std::string advice_words(const CamIsolateArguments& arguments, const PlacedCopper& placed,
                         const IsolationOptions& options, const JoinedNets& joined) {
  constexpr Nanometres most_loss{50'000};
  const FinerCutters finer = finer_cutters(arguments, options);
  const std::optional<IsolationAdvice> advice =
      advise_isolation(placed.copper, placed.nets, options, joined, finer.cutters, most_loss);
  if (!advice) return {};
  std::string said = finer.options[advice->cutter];
  if (advice->allowed_loss != options.allowed_loss) {
    said += fmt::format("{}--allow-loss {:g}mm", said.empty() ? "" : " ", to_mm(advice->allowed_loss).value());
  }
  if (advice->least_trace != options.least_trace)
    said += fmt::format("{}--least-trace {:g}mm", said.empty() ? "" : " ", to_mm(advice->least_trace).value());
  return fmt::format("{} was tried: {} ({})", said,
                     advice->joined == 0 ? "all nets are apart"
                                         : fmt::format("{} still joined", counted(advice->joined, "net") +
                                                                              (advice->joined == 1 ? " is" : " are")),
                     loss_words(advice->lost_mm2, advice->deepest));
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

// Without the islands beside the board.
Region on_board(const Region& copper, const Region& board, std::size_t& outside) {
  if (board.empty()) return copper;
  Region kept;
  for (Region& part : parts_of(copper)) {
    if (common(part, board).empty()) {
      ++outside;
    } else {
      std::ranges::move(part.rings, std::back_inserter(kept.rings));
    }
  }
  return outside == 0 ? copper : kept;
}

std::optional<PlacedCopper> placed(const CamSources& sources, const MillJob& job, bool is_cleared,
                                   Diagnostics& findings) {
  PlacedCopper placed;
  Region copper = mirrored(covered_by(sources.layer, sources.board, findings), job.mirror);
  if (findings.any_error()) {
    show(findings);
    return std::nullopt;
  }
  placed.board = mirrored(sources.board, job.mirror);
  placed.nets = sources.layer.nets;
  if (!placed.nets.empty()) {
    for (const Drawing& drill : sources.drills) {
      for (const DrawnHole& hole : drill.holes) placed.nets.push_back({hole.at, "", {hole.diameter.count / 2}});
    }
  }
  placed.copper = on_board(copper, placed.board, placed.outside);
  if (const std::optional<DrawnBox> box = bounds(placed.copper); is_cleared && placed.board.empty() && box) {
    placed.board = grown(filled({rectangle(*box)}), {2'000'000});
  }
  Region places;
  places.rings.emplace_back();
  for (NetPlace& place : placed.nets) places.rings.front().push_back(mirrored(place.at, job.mirror));
  const Region whole = placed.board.empty() ? placed.copper : placed.board;
  move_to_zero(job.zero, whole, {&placed.copper, &placed.board, &places});
  for (std::size_t i = 0; i < placed.nets.size(); ++i) placed.nets[i].at = places.rings.front()[i];
  return placed;
}

// Whether the program does what it should. Otherwise the reason is shown.
bool is_sound(const IsolationProof& proof) {
  if (proof.damage_mm2 > 0) {
    fail(exit_failed, fmt::format("the program would remove {:g} mm² of the circuit's copper, so it was not written",
                                  proof.damage_mm2));
  } else if (!proof.broken.empty()) {
    fail(exit_failed, fmt::format("the program would mill {} apart, so it was not written; try a smaller --allow-loss",
                                  counted(proof.broken.size(), "island")));
  }
  return proof.damage_mm2 <= 0 && proof.broken.empty();
}

int draw(const CamIsolateArguments& arguments, const MillJob& job, const RouteLink& link, const Region& copper,
         const IsolationResult& result) {
  MillScene scene{.plan = result.plan.mill,
                  .face = copper,
                  .face_name = "Copper",
                  .warned = result.plan.unmilled,
                  .mark_name = "Gap too narrow",
                  .park = job.program.park,
                  .warned_name = "Still joined",
                  .link = link};
  for (const CopperGap& gap : result.nets.gaps) scene.marks.push_back(gap.at);
  std::ranges::copy(result.plan.narrow_openings, std::back_inserter(scene.marks));
  return write_picture(arguments.picture, job.program.name, scene);
}

}  // namespace

int cam_isolate(const CamIsolateArguments& arguments, const WorkProgress& progress, const CamSources* given,
                CamMade* made) {
  if (!outputs_are_good(arguments, arguments.edge)) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob job = mill_job_of(arguments, "passo cam isolate", lengths);
  IsolationOptions options = options_of(arguments, job, lengths);
  if (given != nullptr) take_link(given->link, options.link, job.program.change);
  const Nanometres join = lengths.any("--join", arguments.join);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());

  const std::optional<CamSources> sources = given != nullptr ? *given : read(arguments, join, job);
  if (!sources) return exit_bad_program;
  const std::string name = std::filesystem::path(sources->layer.lines.file).filename().string();
  Diagnostics findings;
  const std::optional<PlacedCopper> board = placed(*sources, job, options.clear, findings);
  if (!board) return exit_bad_program;
  options.board = board->board;
  if (board->outside > 0) {
    note(fmt::format("{}: {} of copper {} outside the board and ignored", name, counted(board->outside, "island"),
                     board->outside == 1 ? "is" : "are"));
  }

  progress.update(0.05);
  IsolationResult result;
  result.plan = plan_isolation(board->copper, options, findings, progress.part(0.05, 0.6));
  if (findings.any_error()) {
    show(findings, sources->layer.lines.file);
    return exit_bad_program;
  }
  result.proof =
      prove_isolation(board->copper, result.plan.mill, options.board, progress.part(0.6, 0.9), result.plan.kept);
  if (!is_sound(result.proof)) return exit_failed;
  const Nanometres finest = std::ranges::min_element(options.cutters, {}, &IsolationCutter::width)->width;
  result.nets = find_joined_nets(board->copper, board->nets, result.plan.mill, result.proof, finest);
  for (const std::string& words : result.plan.mill.notes) note(words);
  note_gaps(result, name);
  if (const int code = write_program(arguments, result.plan.mill, job.program); code != exit_done) {
    return code;
  }
  progress.update(0.95);
  if (!arguments.picture.empty()) {
    if (const int code = draw(arguments, job, options.link, board->copper, result); code != exit_done) return code;
  }
  std::string advice;
  if (result.nets.joined > 0) advice = advice_words(arguments, *board, options, result.nets);
  progress.update(1);
  if (!advice.empty()) note(name + ": " + advice);
  if (arguments.json) {
    say_summary(as_json(result, options.park), arguments);
  } else {
    const std::string words = summary_of(result.plan.mill, options.park, arguments.units, options.link) +
                              proof_words(result, sources->copies);
    if (const int code = tell(arguments.output, result.plan.mill, words, made); code != exit_done) return code;
  }
  if (result.nets.joined == 0 || arguments.accept_joined) return exit_done;
  if (made != nullptr) {
    made->joined_nets += result.nets.joined;
    return exit_done;
  }
  return fail(exit_failed, fmt::format("{} still joined; the program was written (--accept-joined accepts this)",
                                       counted(result.nets.joined, "net") + " are"));
}

}  // namespace passo
