// passo cam outline: a program that cuts boards out along their edge.
#include <cmath>

#include "cam_job.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/cam/outline.hpp"

namespace passo {

OutlineOptions outline_options_of(const CamOutlineArguments& arguments, const MillJob& job, LengthArguments& lengths) {
  OutlineOptions options;
  options.cutter = lengths.above_0("--tool", arguments.tool);
  options.words = fmt::format("cutter {:.4g} mm", to_mm(options.cutter).value());
  options.depth = lengths.below_0("--depth", arguments.depth, "-1.8");
  options.step = lengths.above_0("--step", arguments.step);
  constexpr std::int64_t finest_step = 1'000;  // nm: less makes programs without end
  if (options.step.count < finest_step) lengths.refuse("--step: expected 0.001 mm or more");
  constexpr std::int64_t most_turns = 1'000;
  if (options.step.count > 0 && -options.depth.count / options.step.count > most_turns) {
    lengths.refuse(fmt::format("--step: expected a depth of at most {} steps", most_turns));
  }
  constexpr double flattest = 0.1;
  if (arguments.ramp > 0 && arguments.ramp < flattest) {
    lengths.refuse(fmt::format("--ramp: expected 0, or {} degrees or more, found {:g}", flattest, arguments.ramp));
  }
  options.tabs = arguments.no_tabs ? 0 : arguments.tabs;
  if (arguments.no_tabs && !arguments.tab_places.empty()) lengths.refuse("--no-tabs and --tab cannot be combined");
  for (const std::string& place : arguments.tab_places) options.tab_places.push_back(lengths.place("--tab", place));
  options.tab_width = lengths.above_0("--tab-width", arguments.tab_width);
  options.tab_height = lengths.above_0("--tab-height", arguments.tab_height);
  options.ramp_degrees = arguments.ramp;
  options.lead = lengths.perhaps("--lead", arguments.lead).value_or(Nanometres{});
  options.dog_bones = arguments.dog_bones;
  options.climb = !arguments.conventional;
  options.park = job.program.park;
  return options;
}

namespace {

std::string board_words(const Region& board, const OutlinePlan& plan, const EdgeLoops& loops) {
  std::string text = fmt::format("{} and {} around {} mm² of board, {}; {:g} mm² of it lost\n",
                                 counted(plan.outsides, "outline"), counted(plan.openings, "opening"),
                                 sensible_number(area_mm2(board), 4), counted(plan.tabs.size(), "tab"), plan.lost_mm2);
  if (plan.tight > 0) text += counted(plan.tight, "opening") + " as wide as the cutter, along the centre line\n";
  if (plan.slots > 0)
    text += fmt::format("{} as wide as the cutter, along single lines of the drawing\n", counted(plan.slots, "slot"));
  if (loops.joined > 0) {
    text += fmt::format("joined: ends with gaps at {}, at most {:.4g} mm wide\n", counted(loops.joined, "place"),
                        to_mm(loops.widest_joined).value());
  }
  return text;
}

nlohmann::ordered_json as_json(const OutlinePlan& plan, const EdgeLoops& loops, const Region& board, DrawnPoint park) {
  MillLengths lengths;
  if (!plan.mill.tools.empty()) lengths = lengths_of(plan.mill.tools.front(), park);
  nlohmann::ordered_json tabs = nlohmann::ordered_json::array();
  for (const DrawnPoint& tab : plan.tabs) {
    tabs.push_back({{"x_mm", to_mm(tab.x).value()}, {"y_mm", to_mm(tab.y).value()}});
  }
  return {{"outsides", plan.outsides},
          {"openings", plan.openings},
          {"slots", plan.slots},
          {"joined", loops.joined},
          {"board_mm2", area_mm2(board)},
          {"lost_mm2", plan.lost_mm2},
          {"runs", lengths.runs},
          {"milled_mm", lengths.milled_nm / nanometres_per_mm},
          {"rapids_mm", lengths.rapids_nm / nanometres_per_mm},
          {"tabs", tabs}};
}

}  // namespace

int cam_outline(const CamOutlineArguments& arguments, const WorkProgress& progress, const CamSources* given,
                CamMade* made) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  MillJob job = mill_job_of(arguments, "passo cam outline", lengths);
  job.reading.is_edge = true;
  OutlineOptions options = outline_options_of(arguments, job, lengths);
  if (given != nullptr) take_link(given->link, options.link, job.program.change);
  const Nanometres join = lengths.any("--join", arguments.join);
  if (join.count < 0) lengths.refuse("--join: expected a length of 0 or more");
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());

  const std::optional<BoardLayer> layer = given != nullptr ? given->layer : read_layers(arguments.files, job);
  if (!layer) return exit_bad_program;
  Diagnostics findings;
  const BoardEdge edge = board_edge(*layer, join, findings);
  note_repeated(edge.loops);
  Region board = mirrored(edge.board, job.mirror);
  constexpr Nanometres chords{500};
  Region slots;
  for (const std::vector<PathPoint>& line : edge.loops.open) slots.rings.push_back(chords_of_path(line, false, chords));
  slots = mirrored(slots, job.mirror);
  move_to_zero(job.zero, board, {&board, &slots});
  options.slots = slots.rings;
  OutlinePlan plan;
  progress.update(0.2);
  if (!findings.any_error()) plan = plan_outline(board, options, findings);
  show(findings, layer->lines.file);
  if (findings.any_error()) return exit_bad_program;
  for (const std::string& words : plan.mill.notes) note(words);
  if (const int code = write_program(arguments, plan.mill, job.program); code != exit_done) {
    return code;
  }
  progress.update(0.9);
  if (!arguments.picture.empty()) {
    const Region nothing;
    const MillScene scene{.plan = plan.mill,
                          .face = board,
                          .face_name = "Board",
                          .warned = nothing,
                          .marks = plan.tabs,
                          .mark_name = "Tab",
                          .park = options.park,
                          .link = options.link};
    const int code = write_picture(arguments.picture, job.program.name, scene);
    if (code != exit_done) return code;
  }
  progress.update(1);
  if (arguments.json) {
    say_summary(as_json(plan, edge.loops, board, options.park), arguments);
    return exit_done;
  }
  const std::string words =
      summary_of(plan.mill, options.park, arguments.units, options.link) + board_words(board, plan, edge.loops);
  return tell(arguments.output, plan.mill, words, made);
}

}  // namespace passo
