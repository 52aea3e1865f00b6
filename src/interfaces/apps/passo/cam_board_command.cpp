// passo cam board: from the files of a board to numbered programs, a picture each, and a page that says what to do
// when.
#include <array>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "background_process.hpp"
#include "cam_board_page.hpp"
#include "cam_job.hpp"
#include "progress_display.hpp"
#include "unfinished_job.hpp"

#include "passo/cam/board_job.hpp"
#include "passo/judge/check_page.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/probing/probing_cycle.hpp"
#include "passo/report/board_picture.hpp"

namespace passo {
namespace {

// The board, and where it lies.
struct BoardPlan {
  std::vector<Drawing> drills;
  std::optional<BoardLayer> front;
  std::optional<BoardLayer> back;
  std::optional<BoardLayer> edge;
  Region face;
  DrawnBox box;
};

std::string exact(Nanometres length) {
  return fmt::format("{:.6f}mm", to_mm(length).value());
}

// Several files may be one side, which is told.
void add_copper(const BoardFile& file, std::optional<BoardLayer>& side, bool is_told) {
  const GerberLayer& layer = *file.layer;
  if (side && is_told) {
    note(fmt::format("'{}' and '{}' are both {}, so they are milled as one; --as FILE=nothing ignores a file",
                     side->lines.file, file.name, words_for(file.kind)));
  }
  if (!side) side = BoardLayer{};
  side->lines.file = file.name;
  std::ranges::move(net_places_of(layer), std::back_inserter(side->nets));
  if (layer.is_negative) {
    side->bare = united(side->bare.value_or(Region{}), layer.dark);
  } else {
    side->face = united(side->face, layer.dark);
  }
}

BoardPlan plan_of(const BoardJob& job, Nanometres join, Diagnostics& findings) {
  refuse_two_boards(job, findings);
  BoardPlan plan;
  std::string edge_name;
  for (const BoardFile& file : job.files) {
    if (file.drills && file.kind.role == BoardRole::drill) plan.drills.push_back(*file.drills);
    if (!file.layer) continue;
    if (file.kind.role == BoardRole::outline) {
      plan.edge = BoardLayer{file.layer->dark, file.layer->strokes};
      edge_name = file.name;
    }
    if (file.kind.role != BoardRole::copper) continue;
    const bool is_told = !findings.any_error();
    if (file.kind.side == BoardSide::top) add_copper(file, plan.front, is_told);
    if (file.kind.side == BoardSide::bottom) add_copper(file, plan.back, is_told);
  }
  if (plan.edge) {
    plan.edge->lines.file = edge_name;
    plan.face = board_edge(*plan.edge, join, findings).board;
    if (plan.face.empty() && !findings.any_error()) {
      note(edge_name + ": it has no closed outline, so no board is cut out");
      plan.edge.reset();
    }
  }
  std::vector<Region> all = {plan.face};
  for (std::optional<BoardLayer>* const side : {&plan.front, &plan.back}) {
    if (!*side) continue;
    (*side)->face = covered_by(**side, plan.face, findings);
    (*side)->bare.reset();
    if (plan.face.empty()) all.push_back((*side)->face);
  }
  plan.box = bounds(united(all)).value_or(DrawnBox{});
  return plan;
}

// How long the program takes, by the planner. Empty: it has errors, which are shown.
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

class BoardMaker {
 public:
  // Writes into `folder`.
  BoardMaker(const CamBoardArguments& arguments, std::filesystem::path folder, const BoardPlan& plan,
             const MachineDescription* machine)
      : arguments_(arguments), folder_(std::move(folder)), plan_(plan), machine_(machine) {}

  int make(CamDrillArguments drill, CamIsolateArguments isolate, CamOutlineArguments outline,
           const WorkProgress& progress);
  const std::filesystem::path& folder() const { return folder_; }
  bool accepts_joined() const { return arguments_.accept_joined; }
  void tell_files() const;
  BoardPage page;
  std::size_t joined_nets = 0;

 private:
  bool is_x() const { return arguments_.turn == "x"; }
  Nanometres middle() const {
    const DrawnBox& box = plan_.box;
    return {is_x() ? (box.least.x.count + box.most.x.count) / 2 : (box.least.y.count + box.most.y.count) / 2};
  }
  // Both sides have one zero: the board is turned over about its middle.
  template <class Arguments>
  void place(Arguments& arguments, bool is_turned) const {
    const DrawnPoint corner = plan_.box.least;
    arguments.zero = exact(corner.x - margin_) + "," + exact(corner.y - margin_);
    arguments.mirror = is_turned ? arguments_.turn : "";
    arguments.mirror_at = is_turned ? exact(middle()) : "";
  }
  // The names of the step's files.
  template <class Arguments>
  void name(Arguments& arguments, const char* what) {
    const std::string stem = fmt::format("{}-{}", ++programs_, what);
    arguments.output = (folder_ / (stem + ".ngc")).string();
    arguments.picture = (folder_ / (stem + ".svg")).string();
  }
  template <class Arguments>
  int add(Arguments arguments, int (*command)(const Arguments&, const WorkProgress&, const CamSources*, CamMade*),
          const CamSources& sources, BoardStep step);
  WorkProgress next_step();
  void tell(const BoardStep& step) const;
  std::array<DrawnPoint, 2> pins(Nanometres distance) const;
  // In the programs, of either side.
  std::pair<double, double> in_program(DrawnPoint at) const {
    const DrawnPoint corner = plan_.box.least;
    return {to_mm(at.x - corner.x + margin_).value(), to_mm(at.y - corner.y + margin_).value()};
  }
  int turn_over(const CamDrillArguments& drill, std::optional<std::array<DrawnPoint, 2>> holes);
  int find_heights(const char* side);
  int add_probing(const ProbingCycle& cycle, const char* what, BoardStep step);

  const CamBoardArguments& arguments_;
  std::filesystem::path folder_;
  const BoardPlan& plan_;
  const MachineDescription* machine_;
  Nanometres margin_;
  int programs_ = 0;
  WorkProgress steps_progress_;
  std::size_t steps_begun_ = 0;
};

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

// The steps that take time: holes, each side, the edge.
WorkProgress BoardMaker::next_step() {
  const std::size_t sides = (plan_.front ? 1 : 0) + (plan_.back ? 1 : 0);
  return steps_progress_.stage(steps_begun_++, sides + 2);
}

void BoardMaker::tell(const BoardStep& step) const {
  if (arguments_.json) return;
  ProgressDisplay::clear_shown();
  const std::string time = step.time ? ", " + clock_words(*step.time) : "";
  fmt::print("{}: {}{}\n{}", step.program, step.title, time, step.figures);
}

// Two holes beside the board, midway between which it is turned over.
std::array<DrawnPoint, 2> BoardMaker::pins(Nanometres distance) const {
  const DrawnBox& box = plan_.box;
  const DrawnPoint centre{{(box.least.x.count + box.most.x.count) / 2}, {(box.least.y.count + box.most.y.count) / 2}};
  // The same distance from the middle on both sides, so that each hole comes to where the other was.
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

// Each hole comes to where the other was, so the first program and this one speak of the same two places.
int BoardMaker::turn_over(const CamDrillArguments& drill, std::optional<std::array<DrawnPoint, 2>> holes) {
  const std::string over = is_x() ? "from left to right" : "from top to bottom";
  BoardStep step{.kind = "turn", .title = "Flip the board"};
  if (!holes || !arguments_.probe_holes) {
    step.words = {fmt::format("Flip it {}{}.", over, holes ? ", and insert the pins" : ""),
                  "X0 Y0 stays where it is; set Z0 on the upper face."};
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
  page.up = only_back ? "back" : "front";
  page.turn = !two_sides ? "" : is_x() ? "x" : "y";
  page.steps.push_back(
      {.kind = "blank",
       .title = "Fix the blank",
       .words = {fmt::format("The board is {:.4g} x {:.4g} mm; leave some margin around it.", page.width, page.height),
                 only_back ? "The copper (the back of the board) faces up." : "The front faces up.", zero}});
  CamSources sources{.drills = plan_.drills, .layer = {}, .board = plan_.face};
  const bool has_pins = two_sides && distance.count > 0;
  if (has_pins) page.holes = arguments_.probe_holes ? "probe" : "pins";
  std::optional<std::array<DrawnPoint, 2>> holes;
  if (has_pins) {
    holes = pins(distance);
    drill.align = fmt::format("{},{},{},{}", exact(holes->front().x), exact(holes->front().y), exact(holes->back().x),
                              exact(holes->back().y));
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
    }
    BoardStep step{.kind = "drill", .title = "Drill", .words = std::move(words)};
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
    BoardStep step{.kind = is_back ? "back" : "front",
                   .title = is_back ? "Mill the back" : "Mill the front",
                   .words = {"Insert the cutter, and set Z0 with care: the width of the cut depends on its depth.",
                             "Run the program."}};
    const int code = add(copper, &cam_isolate, sources, std::move(step));
    if (code != exit_done) return code;
  }
  if (!plan_.edge) return exit_done;
  place(outline, plan_.back.has_value());
  name(outline, "outline");
  sources.layer = *plan_.edge;
  return add(outline, &cam_outline, sources,
             {.kind = "edge",
              .title = "Cut the board out",
              .words = {"Insert the cutter, and set Z0.", "Run the program.", "Cut the tabs, if there are any."}});
}

// "gerbers" of "gerbers/", and of "." where that is the folder.
std::string name_of(const std::string& job) {
  std::filesystem::path path = std::filesystem::absolute(job).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return path.filename().string();
}

std::string nothing_to_make(const BoardJob& job) {
  constexpr std::size_t most_told = 10;
  std::string files;
  for (std::size_t i = 0; i < std::min(most_told, job.files.size()); ++i)
    files += fmt::format("{}{} ({})", i == 0 ? "" : ", ", short_name(job.files[i]), words_for(job.files[i].kind));
  if (job.files.size() > most_told) files += ", ...";
  return fmt::format(
      "these files include no copper layer, outline or drill file: {}; --as FILE=LAYER sets the layer of a file",
      files);
}

// What --as says. Returns why it cannot be; empty: done.
std::string heed_words(BoardJob& job, const std::vector<std::string>& told) {
  for (const std::string& one : told) {
    const std::size_t at = one.rfind('=');
    if (at == std::string::npos) return "--as: expected FILE=LAYER, not '" + one + "'";
    const std::string why = set_kind(job, one.substr(0, at), one.substr(at + 1));
    if (!why.empty()) return "--as: " + why;
  }
  return {};
}

// The programs, their pictures, and the page.
int make_all(BoardMaker& maker, const BoardJob& job, CamDrillArguments drill, CamIsolateArguments isolate,
             CamOutlineArguments outline, const WorkProgress& progress) {
  const std::filesystem::path& folder = maker.folder();
  if (isolate.tools.empty() && isolate.v.empty()) isolate.tools = usual_isolation_tool;
  isolate.accept_joined = isolate.accept_joined || maker.accepts_joined();
  maker.tell_files();
  int code = maker.make(std::move(drill), std::move(isolate), std::move(outline), progress);
  if (code != exit_done) return code;
  const std::string picture = (folder / "board.svg").string();
  code = write_picture(picture, maker.page.name,
                       [&](const PictureOptions& options, OutputFile& file) { return draw_board(job, options, file); });
  if (code != exit_done) return code;
  maker.page.steps.front().picture = content_of(picture);
  return write_text((folder / "board.html").string(), to_html(maker.page));
}

}  // namespace

int cam_board(const CamBoardArguments& arguments, const WorkProgress& progress, CamDrillArguments drill,
              CamIsolateArguments isolate, CamOutlineArguments outline) {
  if (std::ranges::find(arguments.paths, "") != arguments.paths.end()) {
    return fail(exit_bad_program, "expected a folder, an archive or files, but the name is empty");
  }
  Diagnostics findings;
  std::optional<MachineDescription> machine;
  if (!arguments.machine.empty()) {
    machine = load_machine_file(arguments.machine, findings);
    show(findings);
    if (!machine) return exit_bad_machine;
  }
  BoardJob job = read_board_job(arguments.paths, findings);
  if (!findings.any_error()) {
    if (const std::string why = heed_words(job, arguments.told); !why.empty()) return fail(exit_bad_program, why);
  }
  LengthArguments lengths(*mm_of_unit(outline.units));
  const Nanometres join = lengths.any("--join", outline.join);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  const BoardPlan plan = plan_of(job, join, findings);
  UnfinishedJob unfinished(arguments.output);
  BoardMaker maker(arguments, unfinished.made(), plan, machine ? &*machine : nullptr);
  maker.page.name = name_of(arguments.paths.front());
  if (machine) maker.page.machine = machine->name;
  for (const BoardFile& file : job.files) {
    maker.page.files.push_back(
        {file.name, short_name(file), words_for(file.kind), file.kind.told_by, file.drills.has_value()});
  }
  maker.page.left_out = job.left_out;
  int code = exit_done;
  if (!lengths.message().empty()) code = fail(exit_bad_program, lengths.message());
  show(findings);
  if (findings.any_error()) code = exit_bad_program;
  if (code == exit_done && plan.drills.empty() && !plan.front && !plan.back && !plan.edge) {
    code = fail(exit_bad_program, nothing_to_make(job));
  }
  if (code == exit_done) code = unfinished.begin();
  if (code == exit_done)
    code = make_all(maker, job, std::move(drill), std::move(isolate), std::move(outline), progress.part(0.1, 0.95));
  if (code == exit_done) code = unfinished.finish();
  if (code == exit_done) progress.update(1);
  // What was read helps to mend what was refused.
  if (code != exit_done) maker.page.steps.clear();
  if (arguments.json) fmt::print("{}", to_json(maker.page));
  if (code != exit_done || maker.joined_nets == 0) return code;
  return fail(exit_failed, fmt::format("{} still joined; the programs were written (--accept-joined accepts this)",
                                       counted(maker.joined_nets, "net") + " are"));
}

}  // namespace passo
