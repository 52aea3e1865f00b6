#include "cam_board_maker.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "background_process.hpp"
#include "cam_job.hpp"
#include "progress_display.hpp"

#include "passo/judge/check_page.hpp"
#include "passo/report/flip_picture.hpp"

namespace passo {
namespace {

// The duration of the program, from the planner. Empty: the program has errors, which are shown.
std::optional<Seconds> time_of(const std::string& program, const MachineDescription& machine,
                               const WorkProgress& progress) {
  ProgramArguments arguments;
  arguments.program = program;
  std::optional<ProgramReader> reader = streamed_program(arguments);
  const std::optional<InterpreterOptions> options = machine_options(arguments);
  if (!reader || !options) return std::nullopt;
  Diagnostics findings;
  const ProgramCheck checked = check_program(reader->again(), machine, *options, findings);
  if (!checked.good) {
    show(findings);
    return std::nullopt;
  }
  return judge(std::move(*reader), machine, *options, checked, {}, progress).summary.time();
}

CamOpeningArguments opening_arguments(const CamIsolateArguments& isolate, const std::string& tool,
                                      const std::string& depth) {
  CamOpeningArguments arguments;
  static_cast<CamMillArguments&>(arguments) = isolate;
  arguments.tool = tool;
  arguments.depth = depth;
  return arguments;
}

}  // namespace

template <class Arguments>
int BoardMaker::add(Arguments arguments,
                    int (*command)(const Arguments&, const WorkProgress&, const CamSources*, CamMade*),
                    const CamSources& sources, BoardStep step) {
  const WorkProgress progress = next_step();
  const bool is_timed = machine_ != nullptr;
  CamMade made;
  const int code = command(arguments, progress.part(0, is_timed ? 0.6 : 1), &sources, &made);
  if (code != exit_done) return code;
  step.program = std::filesystem::path(arguments.output).filename().string();
  joined_nets += made.joined_nets;
  last_ = sources.link.ends_in_place ? made.last : std::nullopt;
  step.tools = made.tools;
  step.figures = made.summary;
  step.picture = content_of(arguments.picture);
  if (is_timed) step.time = time_of(arguments.output, *machine_, progress.part(0.6, 1));
  tell(step);
  page.steps.push_back(std::move(step));
  return exit_done;
}

void BoardMaker::tell_files() const {
  if (arguments_.json) return;
  for (const BoardPageFile& file : page.files) fmt::print("{}\n", words_for(file));
}

// The steps that take time: holes, each side, the outline.
WorkProgress BoardMaker::next_step() {
  const std::size_t sides = (plan_.front ? 1 : 0) + (plan_.back ? 1 : 0);
  return steps_progress_.stage(steps_begun_++, sides + 2);
}

RouteLink BoardMaker::link(bool is_last) const {
  if (arguments_.park != "last") return {};
  return {.start = last_, .changes_in_place = true, .ends_in_place = !is_last};
}

void BoardMaker::tell(const BoardStep& step) const {
  if (arguments_.json) return;
  ProgressDisplay::clear_shown();
  const std::string time = step.time ? ", " + clock_words(*step.time) : "";
  fmt::print("{}: {}{}\n{}", step.program, step.title, time, step.figures);
}

// Two holes beside the board, which is flipped about the line midway between them.
std::array<DrawnPoint, 2> BoardMaker::pins(Nanometres distance) const {
  const DrawnBox& box = plan_.box;
  const DrawnPoint centre{{(box.least.x.count + box.most.x.count) / 2}, {(box.least.y.count + box.most.y.count) / 2}};
  // Both holes are equally far from the middle, so each comes to the position of the other.
  const std::int64_t off =
      distance.count + (is_x() ? box.most.x.count - box.least.x.count : box.most.y.count - box.least.y.count) / 2;
  const DrawnPoint a{{centre.x.count - (is_x() ? off : 0)}, {centre.y.count - (is_x() ? 0 : off)}};
  const DrawnPoint b{{2 * middle().count - a.x.count}, {2 * middle().count - a.y.count}};
  return {a, {is_x() ? b.x : a.x, is_x() ? a.y : b.y}};
}

int BoardMaker::add_probing(const ProbingCycle& cycle, const char* what, BoardStep step) {
  const auto program = probing_program(cycle);
  if (!program) return fail(exit_bad_program, program.error());
  step.program = fmt::format("{}-{}.ngc", ++programs_, what);
  const int code = write_text((folder_ / step.program).string(), *program);
  if (code == exit_done) tell(step);
  page.steps.push_back(std::move(step));
  return code;
}

// Each hole comes to the position of the other, so both programs use the same two positions.
int BoardMaker::turn_over(const CamDrillArguments& drill, std::optional<std::array<DrawnPoint, 2>> holes) {
  const std::string over = is_x() ? "from left to right" : "from top to bottom";
  BoardStep step{.kind = "turn", .title = "Flip the board"};
  if (holes) {
    if (const int code = draw_turn(drill, *holes, step); code != exit_done) return code;
  }
  if (!holes || !arguments_.probe_holes) {
    step.words = {fmt::format("Flip it {}{}.", over, holes ? ", and insert the pins" : ""),
                  "X0 Y0 stays where it is; set Z0 on the upper face."};
    if (holes) std::ranges::move(registration_words(), std::back_inserter(step.words));
    page.steps.push_back(std::move(step));
    return exit_done;
  }
  LengthArguments lengths(*mm_of_unit(drill.units));
  const double width = to_mm(lengths.above_0("--align-drill", drill.align_drill)).value();
  const auto [x, y] = in_program(holes->front());
  const auto [second_x, second_y] = in_program(holes->back());
  const char* const which = is_x() ? "left" : "front";
  step.kind = "find-holes";
  step.title = "Flip the board, and probe its position";
  step.words = {fmt::format("Flip it {}, and clamp it; a small shift or rotation is fine.", over),
                fmt::format("Move the probe into the {} of the two holes, below its rim, and run the program.", which),
                "G54 is then aligned with the board; set Z0 on the upper face."};
  return add_probing({.kind = ProbingKind::bores,
                      .touch = {.reach = width, .back = std::min(0.3, width / 10)},
                      .x = x,
                      .y = y,
                      .second_x = second_x,
                      .second_y = second_y},
                     "find-holes", std::move(step));
}

std::string BoardMaker::copy_words() const {
  if (plan_.grid.copies() == 1) return {};
  return fmt::format("It holds {} boards of {:.4g} x {:.4g} mm in {} columns and {} rows, {:.4g} mm apart.",
                     plan_.grid.copies(), page.copy_width, page.copy_height, plan_.grid.columns, plan_.grid.rows,
                     to_mm(plan_.grid.gap).value());
}

void BoardMaker::name_holes(const std::array<DrawnPoint, 2>& holes) {
  const DrawnPoint axis = to_program({middle(), middle()});
  page.registration = {{in_program(holes[0]), in_program(holes[1])}, to_mm(is_x() ? axis.x : axis.y).value()};
}

// Reports the position of each hole, and why both sides match.
std::vector<std::string> BoardMaker::registration_words() const {
  const auto& [one, other] = page.registration->holes;
  return {fmt::format("Hole 1 is at X{:.6g} Y{:.6g}, hole 2 at X{:.6g} Y{:.6g} mm: after the flip, hole 1 is where "
                      "hole 2 was, and hole 2 where hole 1 was.",
                      one.first, one.second, other.first, other.second),
          fmt::format("The programs of the back are mirrored about {}{:.6g}, midway between the holes, so both sides "
                      "match as exactly as the pins fit in their holes.",
                      is_x() ? "X" : "Y", page.registration->axis)};
}

int BoardMaker::draw_turn(const CamDrillArguments& drill, const std::array<DrawnPoint, 2>& holes, BoardStep& step) {
  const auto moved = [&](Region region) {
    for (DrawnRing& ring : region.rings) {
      for (DrawnPoint& point : ring) point = to_program(point);
    }
    return region;
  };
  LengthArguments lengths(*mm_of_unit(drill.units));
  const Region face = moved(plan_.face);
  const Region front = moved(plan_.front->face);
  const Region back = moved(plan_.back->face);
  const DrawnPoint axis = to_program({middle(), middle()});
  const FlipScene scene{.face = face,
                        .front = front,
                        .back = back,
                        .holes = {to_program(holes[0]), to_program(holes[1])},
                        .diameter = lengths.above_0("--align-drill", drill.align_drill),
                        .mirror = {is_x() ? Mirror::Turned::x : Mirror::Turned::y, is_x() ? axis.x : axis.y}};
  const std::string file = (folder_ / fmt::format("{}-flip.svg", programs_ + 1)).string();
  const int code = write_picture(file, "Flip the board", [&](const PictureOptions& options, OutputFile& picture) {
    return draw_flip(scene, options, picture);
  });
  if (code == exit_done) step.picture = content_of(file);
  return code;
}

// The solder mask is applied to the side that has just been milled.
int BoardMaker::mill_mask(const CamIsolateArguments& isolate, bool is_back, CamSources sources) {
  if (arguments_.mask.empty() || plan_.mask[is_back].empty()) return exit_done;
  CamOpeningArguments mask = opening_arguments(isolate, arguments_.mask, arguments_.mask_depth);
  place(mask, is_back);
  name(mask, is_back ? "mask-back" : "mask-front");
  sources.layer = {.face = plan_.mask[is_back], .lines = {}, .bare = {}, .nets = {}};
  return add(mask, &cam_mask, sources,
             {.kind = is_back ? "mask-back" : "mask-front",
              .title = is_back ? "Mask the back" : "Mask the front",
              .words = {"Coat this side with solder mask, and cure it; the blank stays where it is.",
                        "Insert the cutter, and set Z0 on the cured mask.", "Run the program: it clears the pads."}});
}

int BoardMaker::cut_stencils(const CamIsolateArguments& isolate, CamSources sources) {
  if (arguments_.stencil.empty()) return exit_done;
  for (const bool is_back : {false, true}) {
    if (plan_.paste[is_back].empty()) continue;
    CamOpeningArguments stencil = opening_arguments(isolate, arguments_.stencil, arguments_.stencil_depth);
    place(stencil, is_back);
    name(stencil, is_back ? "stencil-back" : "stencil-front");
    sources.layer = {.face = plan_.paste[is_back], .lines = {}, .bare = {}, .nets = {}};
    BoardStep step{.kind = is_back ? "stencil-back" : "stencil-front",
                   .title = is_back ? "Cut the stencil of the back" : "Cut the stencil of the front",
                   .words = {"Tape the film flat onto a spoilboard, and set Z0 on it; X0 Y0 stays where it is.",
                             "Insert the cutter, and run the program."}};
    if (const int code = add(stencil, &cam_stencil, sources, std::move(step)); code != exit_done) return code;
  }
  return exit_done;
}

int BoardMaker::find_heights(const char* side) {
  if (arguments_.heights.empty()) return exit_done;
  unsigned columns = 0;
  unsigned rows = 0;
  char beyond = 0;
  if (std::sscanf(arguments_.heights.c_str(), "%3ux%3u%c", &columns, &rows, &beyond) != 2)
    return fail(exit_bad_program, "--heights: expected COLUMNSxROWS, e.g. 9x6, not '" + arguments_.heights + "'");
  const auto [x, y] = in_program(plan_.box.least);
  const std::string map = fmt::format("heights-{}.csv", side);
  const std::string mill = fmt::format("{}-isolate-{}", programs_ + 2, side);
  BoardStep step{.kind = fmt::format("heights-{}", side), .title = fmt::format("Measure the {}", side)};
  step.words = {
      "Insert the probe, set Z0 on the face, and run the program with the option --log " + map + ".",
      fmt::format("passo level {0}.ngc --map {1} -o {0}-level.ngc writes the program for the next step.", mill, map)};
  return add_probing({.kind = ProbingKind::map,
                      .clearance = 2,
                      .size_x = to_mm(plan_.box.most.x - plan_.box.least.x).value(),
                      .size_y = to_mm(plan_.box.most.y - plan_.box.least.y).value(),
                      .x = x,
                      .y = y,
                      .columns = static_cast<double>(columns),
                      .rows = static_cast<double>(rows)},
                     fmt::format("heights-{}", side).c_str(), std::move(step));
}

int BoardMaker::make(CamDrillArguments drill, CamIsolateArguments isolate, CamOutlineArguments outline,
                     const WorkProgress& progress) {
  steps_progress_ = progress;
  const bool two_sides = plan_.front && plan_.back;
  const bool only_back = plan_.back && !plan_.front;
  LengthArguments lengths(1);
  margin_ = lengths.any("--margin", arguments_.margin);
  const Nanometres distance = lengths.any("--pins", arguments_.pin_distance);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  const std::string zero =
      fmt::format("The lower left corner of the board is at X{0:.4g} Y{0:.4g} mm; Z0 is the face of the blank.",
                  to_mm(margin_).value());
  page.width = to_mm(plan_.box.most.x - plan_.box.least.x).value();
  page.height = to_mm(plan_.box.most.y - plan_.box.least.y).value();
  page.margin = to_mm(margin_).value();
  page.copies = plan_.grid.copies();
  page.copy_width = to_mm(plan_.one.most.x - plan_.one.least.x).value();
  page.copy_height = to_mm(plan_.one.most.y - plan_.one.least.y).value();
  page.up = only_back ? "back" : "front";
  page.turn = !two_sides ? "" : is_x() ? "x" : "y";
  page.steps.push_back(
      {.kind = "blank",
       .title = "Fix the blank",
       .words = {fmt::format("The {} is {:.4g} x {:.4g} mm; leave some margin around it.",
                             page.copies > 1 ? "panel" : "board", page.width, page.height),
                 only_back ? "The copper (the back of the board) faces up." : "The front faces up.", zero}});
  if (page.copies > 1) page.steps.back().words.insert(page.steps.back().words.begin() + 1, copy_words());
  CamSources sources{.drills = plan_.drills, .layer = {}, .board = plan_.face, .copies = page.copies};
  const bool has_pins = two_sides && distance.count > 0;
  if (has_pins) page.holes = arguments_.probe_holes ? "probe" : "pins";
  std::optional<std::array<DrawnPoint, 2>> holes;
  if (has_pins) {
    holes = pins(distance);
    name_holes(*holes);
    drill.align = fmt::format("{},{},{},{}", exact_mm(holes->front().x), exact_mm(holes->front().y),
                              exact_mm(holes->back().x), exact_mm(holes->back().y));
  }
  if (!plan_.drills.empty() || has_pins) {
    place(drill, only_back);
    name(drill, "drill");
    std::vector<std::string> words = {"Run the program; at each message, change the drill and set Z0 again."};
    if (has_pins) {
      words.emplace_back(
          arguments_.probe_holes
              ? "Two of the holes are next to the board: the probe measures them after the board is flipped."
              : "Two of the holes are for pins: drill them deeper, into the table, without moving the blank.");
      words.push_back(registration_words().front());
    }
    BoardStep step{.kind = "drill", .title = "Drill", .words = std::move(words)};
    sources.link = link(!plan_.front && !plan_.back && !plan_.edge);
    if (const int code = add(drill, &cam_drill, sources, std::move(step)); code != exit_done) return code;
  }
  for (const bool is_back : {false, true}) {
    const std::optional<BoardLayer>& side = is_back ? plan_.back : plan_.front;
    if (!side) continue;
    if (is_back && two_sides) {
      if (const int code = turn_over(drill, holes); code != exit_done) return code;
    }
    if (const int code = find_heights(is_back ? "back" : "front"); code != exit_done) return code;
    CamIsolateArguments copper = isolate;
    place(copper, is_back);
    name(copper, is_back ? "isolate-back" : "isolate-front");
    sources.layer = *side;
    const bool is_masked = !arguments_.mask.empty() && !plan_.mask[is_back].empty();
    sources.link = link(is_masked || (two_sides && !is_back) || !plan_.edge);
    BoardStep step{.kind = is_back ? "back" : "front",
                   .title = is_back ? "Mill the back" : "Mill the front",
                   .words = {"Insert the cutter, and set Z0 with care: the width of the cut depends on its depth.",
                             "Run the program."}};
    const int code = add(copper, &cam_isolate, sources, std::move(step));
    if (code != exit_done) return code;
    if (const int masked = mill_mask(isolate, is_back, sources); masked != exit_done) return masked;
  }
  if (!plan_.edge) return cut_stencils(isolate, sources);
  place(outline, plan_.back.has_value());
  name(outline, "outline");
  sources.layer = *plan_.edge;
  sources.link = link(true);
  const int code =
      add(outline, &cam_outline, sources,
          {.kind = "edge",
           .title = page.copies > 1 ? "Cut the boards out" : "Cut the board out",
           .words = {"Insert the cutter, and set Z0.", "Run the program.", "Cut the tabs, if there are any."}});
  return code == exit_done ? cut_stencils(isolate, sources) : code;
}

}  // namespace passo
