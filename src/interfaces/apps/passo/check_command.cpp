// passo check: interprets the program, builds its path, and says what is wrong. Nothing runs on a machine. With
// --motion the path is also planned and stepped, and the motion is measured.
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "cam_job.hpp"
#include "check_report.hpp"
#include "commands.hpp"
#include "cut_words.hpp"
#include "grbl_check.hpp"
#include "link_delay.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "program_messages.hpp"
#include "progress_display.hpp"
#include "stock_setup.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/activity/program.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/judge/check_page.hpp"
#include "passo/judge/fit_proposals.hpp"
#include "passo/judge/link_delay_words.hpp"
#include "passo/judge/motion_trial.hpp"
#include "passo/judge/program_stops.hpp"
#include "passo/proof/proof_text.hpp"
#include "passo/report/motion_picture.hpp"
#include "passo/report/output_file.hpp"
#include "passo/verdict/speed_survey.hpp"

namespace passo {
namespace {

// The first look at the program: interpreter and path. About so much of the time goes into it, the rest into planning.
constexpr double share_of_first_look = 0.3;

int draw(const MotionRecorder& motion, const MotionProof& proof, const CheckArguments& arguments) {
  Result<OutputFile, OutputError> file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  const std::string name = std::filesystem::path(arguments.program.program).filename().string();
  const PictureOptions options{
      .format = *picture_format_of(arguments.picture),
      .program = name,
      .machine = fmt::format("{:.4f} s; lower bound {:.4f} s on this path, {:.4f} s on any path within the tolerance",
                             proof.time.value(), proof.time_bound.value(), proof.tube_bound.value())};
  Status<OutputError> done = draw_motion_picture(motion, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

int draw(const PathRecorder& path, const MachineDescription& machine, const CheckArguments& arguments) {
  Result<OutputFile, OutputError> file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  const PictureOptions options{.format = *picture_format_of(arguments.picture),
                               .program = std::filesystem::path(arguments.program.program).filename().string(),
                               .machine = machine.name,
                               .colour = PathColour::margin};
  Status<OutputError> done = draw_picture(path, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

// `machine` and `program` are good.
int measure(const CheckArguments& arguments, const MachineDescription& machine, ProgramReader program,
            const InterpreterOptions& options, Seconds nominal, Diagnostics& findings, ProgressDisplay& progress) {
  MotionRecorder recorder(motion_limits(machine));
  AxisSet axes;
  for (const AxisDescription& axis : machine.axes) axes.add(axis.axis);
  SpeedSurvey survey(motion_limits(machine), axes);
  const bool draws = !arguments.picture.empty();
  const WorkProgress proving = progress.work().part(share_of_first_look, 1);
  TrialWatchers watchers{.progress = proving};
  if (draws) watchers.path = [&](const PathItem& item) { recorder.watch(item); };
  watchers.motion = [&](const MotionItem& item) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) survey.watch(*move);
    if (draws) recorder.watch(item);
  };
  const MotionProof proof = prove_motion(std::move(program), machine, options, nominal, findings, watchers);
  progress.clear();
  const SpeedReport speed = survey.report();
  if (arguments.json) {
    auto json = nlohmann::ordered_json::parse(to_json(proof));
    json["speed"] = as_json(speed);
    std::puts(json.dump(2).c_str());
  } else {
    std::fputs((to_text(proof) + speed_words(speed, proof.time)).c_str(), stdout);
  }
  if (draws) {
    const int code = draw(recorder, proof, arguments);
    if (code != exit_done) return code;
  }
  return proof.good() ? exit_done : exit_failed;
}

bool measures_motion(const CheckArguments& arguments) {
  return arguments.motion || (!arguments.picture.empty() && arguments.colour_by.empty());
}

// What is wrong with the options. Empty: nothing.
std::string refusal_of(const CheckArguments& arguments) {
  if (!arguments.board.empty() && (measures_motion(arguments) || arguments.cutting_force)) {
    return "--board cannot be combined with --motion, with a picture of the motion, or with --cutting-force";
  }
  if (std::string why = refuse_picture(arguments.picture); !why.empty()) return why;
  const bool draws_margin = arguments.colour_by == "margin";
  if (!arguments.colour_by.empty() && (!draws_margin || arguments.picture.empty() || arguments.motion)) {
    return "--colour-by margin needs --picture, and cannot be combined with --motion";
  }
  const StockArguments& stock = arguments.stock;
  const bool cuts =
      !stock.block.empty() || stock.cell || !stock.tools.empty() || !stock.clamps.empty() || arguments.spindle_speed;
  if (cuts && !arguments.cutting_force) {
    return "--cutting-force is missing: the specific cutting force of the material, e.g. 700 N/mm\u00B2 for aluminium";
  }
  if (arguments.cutting_force && measures_motion(arguments)) {
    return "--cutting-force cannot be combined with --motion or with a picture of the motion";
  }
  if (!arguments.loads.empty() && measures_motion(arguments)) {
    return "--loads cannot be combined with --motion or with a picture of the motion";
  }
  if (arguments.report.empty()) return "";
  if (!arguments.report.ends_with(".html")) return arguments.report + ": the name of a report must end with .html";
  if (measures_motion(arguments)) {
    return "--report cannot be combined with --motion or with a picture of the motion";
  }
  return "";
}

// The share of a program that was read, by the lines that came. Lines in loops come again, and count once.
class ReadShare {
 public:
  explicit ReadShare(std::uint64_t bytes) : whole_(static_cast<double>(bytes)) {}
  void watch(const Operation& operation) {
    if (operation.source.line <= line_) return;
    line_ = operation.source.line;
    read_ += operation.text.size() + 1;
  }
  double share() const { return whole_ > 0 ? static_cast<double>(read_) / whole_ : 0; }

 private:
  double whole_;
  std::uint64_t read_ = 0;
  std::uint32_t line_ = 0;
};

struct FirstLook {
  LivesLeft lives;  // of the tools of --tool-table
  Diagnostics findings;
  ProgramStops stops;
  ProgramCheck result;
};

void look(const CheckArguments& arguments, const MachineDescription& machine, const ProgramReader& program,
          const InterpreterOptions& options, const std::optional<GrblBoard>& board, ProgressDisplay& progress,
          FirstLook& first) {
  constexpr unsigned items_between_looks = 4096;
  ProgramMessages messages(arguments.program.program, !arguments.json);
  FindingsDisplay display(first.findings);
  ReadShare read(program.size());
  unsigned items = 0;
  CutForecast cuts(motion_limits(machine), first.lives);
  const auto watch_path = [&](const PathItem& item) {
    first.stops.watch(item);
    cuts.add(item);
    if (!arguments.json && display.has_news()) {
      progress.clear();
      display.update();
    }
    if (++items % items_between_looks == 0) progress.update(share_of_first_look * read.share());
  };
  const auto watch_operations = [&](const Operation& operation) {
    read.watch(operation);
    first.stops.watch(operation, options.tools);
    messages.show(operation, [&] { progress.clear(); });
  };
  first.result =
      board ? check_for_grbl(program, machine, options, board->target, first.findings, watch_path, watch_operations)
            : check_program(program.again(), machine, options, first.findings, watch_path, watch_operations);
  if (first.result.good) cuts.add_findings(arguments.program.program, first.findings);
  progress.clear();
  if (!arguments.json || (first.result.good && measures_motion(arguments))) display.finish();
}

void print(const CheckArguments& arguments, const MachineDescription& machine, const FirstLook& first,
           const std::optional<Judgement>& page, const std::optional<GrblBoard>& board,
           const std::optional<CutOutcome>& cut, const std::vector<Proposal>& proposals) {
  if (arguments.json) {
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    nlohmann::ordered_json json = findings_as_json(first.findings, first.stops);
    if (page) add_to(json, *page, machine);
    if (page && board) json["board"] = as_json(*board);
    if (cut) json["cut"] = as_json(*cut);
    json["proposals"] = passo::as_json(proposals);
    std::puts(json.dump(2, ' ', false, replace).c_str());
    return;
  }
  const char* const name = arguments.program.program.c_str();
  if (first.result.good && !first.findings.any_error()) std::printf("%s: no errors\n", name);
  if (first.stops.count() > 0) std::printf("%s: stops for the operator at %s\n", name, first.stops.words().c_str());
  if (cut) std::fputs(to_text(*cut).c_str(), stdout);
  if (page && board) std::fputs(to_text(*board).c_str(), stdout);
  if (page) std::fputs(to_text(*page, machine).c_str(), stdout);
  std::fputs(to_text(proposals).c_str(), stdout);
}

// What the stock is cut by. Nothing, with a message.
std::optional<CutOutcome> cut(const CheckArguments& arguments, const MachineDescription& machine,
                              const ProgramReader& program, const InterpreterOptions& options, Diagnostics& findings) {
  Result<StockWishes, std::string> wishes = stock_wishes(arguments.stock);
  if (!wishes) {
    fail(exit_bad_program, wishes.error());
    return std::nullopt;
  }
  if (!add_tool_shapes(arguments.stock.tool_table, *wishes)) return std::nullopt;
  const StockJob job{program.again(), options, &machine};
  Diagnostics known;  // the check has them
  const FeedLook look = shown_feeds(job, *wishes, known);
  const auto tools = shapes_or_message(job, *wishes, look);
  if (!tools) return std::nullopt;
  std::optional<HeightField> field = field_or_message(*wishes, look);
  if (!field) return std::nullopt;
  CutOutcome outcome =
      cut_with_force(job, *wishes, look, *tools, std::move(*field),
                     {.specific_force = *arguments.cutting_force, .revolutions_per_minute = arguments.spindle_speed});
  Diagnostics of_cut;
  add_findings(outcome, of_cut);
  if (!arguments.json) show(of_cut);
  for (const Diagnostic& finding : of_cut.all()) findings.add(finding);
  return outcome;
}

// Draws and writes what the arguments ask for. Returns an exit code.
int write_files(const CheckArguments& arguments, const MachineDescription& machine, const FirstLook& first,
                const std::optional<Judgement>& page, const PathRecorder& path, const LoadTrack& track) {
  if (page && !arguments.picture.empty()) {
    const int code = draw(path, machine, arguments);
    if (code != exit_done) return code;
  }
  if (arguments.report.empty()) return exit_done;
  const CheckReport report{.program = std::filesystem::path(arguments.program.program).filename().string(),
                           .machine = machine,
                           .findings = first.findings,
                           .waits = first.stops.count() > 0 ? first.stops.words() : "",
                           .page = page ? &*page : nullptr,
                           .path = path,
                           .track = track};
  Result<OutputFile, OutputError> file = OutputFile::open(arguments.report);
  if (!file) return fail(exit_failed, file.error().message);
  file->write(to_html(report));
  const Status<OutputError> done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

}  // namespace

int check(const CheckArguments& arguments) {
  if (const std::string refusal = refusal_of(arguments); !refusal.empty()) return fail(exit_bad_program, refusal);
  Diagnostics diagnostics;
  const auto machine = load_machine_file(arguments.machine, diagnostics,
                                         arguments.board.empty() ? MachineUse::own_board : MachineUse::any_board);
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  std::optional<ProgramReader> program = streamed_program(arguments.program);
  std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  NamedFiles files = files_of(arguments.program, *options);
  files.reads("the machine file", arguments.machine);
  files.reads("--tool-table", arguments.stock.tool_table);
  files.writes("--picture", arguments.picture);
  files.writes("--report", arguments.report);
  files.writes("--loads", arguments.loads);
  if (!files.are_apart()) return exit_bad_program;
  std::optional<GrblBoard> board;
  if (!arguments.board.empty()) {
    int code = exit_done;
    board = grbl_board(arguments.board, *machine, *options, code);
    if (!board) return code;
  }

  FirstLook first;
  int lives_code = exit_done;
  auto lives =
      read_lives({.library = arguments.stock.tool_table, .records = arguments.program.tool_life.records}, lives_code);
  if (!lives) return lives_code;
  first.lives = std::move(*lives);
  ProgressDisplay progress(program->name());
  look(arguments, *machine, *program, *options, board, progress, first);
  if (first.result.good && measures_motion(arguments)) {
    return measure(arguments, *machine, std::move(*program), *options, first.result.nominal_time, first.findings,
                   progress);
  }
  std::optional<CutOutcome> stock;
  if (first.result.good && arguments.cutting_force) {
    stock = cut(arguments, *machine, *program, *options, first.findings);
    if (!stock) return exit_bad_program;
  }
  std::optional<Judgement> page;
  PathRecorder path;
  LoadTrack track;
  LineTorques loads;
  if (first.result.good) {
    const bool reports = !arguments.report.empty();
    const JudgeWatchers watchers{.path = reports || !arguments.picture.empty() ? &path : nullptr,
                                 .track = reports ? &track : nullptr,
                                 .loads = stock ? &stock->loads : nullptr,
                                 .lines = arguments.loads.empty() ? nullptr : &loads};
    const auto show_share = [&](double share) {
      progress.update(share_of_first_look + (1 - share_of_first_look) * share);
    };
    page = board ? judge_on_grbl(*program, *machine, *options, first.result, watchers, show_share, *board)
                 : judge(program->again(), *machine, *options, first.result, watchers, show_share);
  }
  progress.clear();
  if (page && !board)
    page->line = line_cost_with_progress(*program, *machine, *options, first.result, page->summary.time());
  if (page && !arguments.loads.empty()) {
    const int code = write_text(arguments.loads, loads.text());
    if (code != exit_done) return code;
  }
  const int written = write_files(arguments, *machine, first, page, path, track);
  if (written != exit_done) return written;
  const std::vector<Proposal> proposals = proposals_of({*program, *machine, *options}, first.result, first.findings,
                                                       page && !stock && !board ? &*page : nullptr);
  print(arguments, *machine, first, page, board, stock, proposals);
  if (page && page->lost()) {
    return fail(exit_failed, "the motors would lose steps, and the part would be scrap [check.steps-lost]");
  }
  if (!first.result.good) return exit_bad_program;
  return first.findings.any_error() ? exit_failed : exit_done;
}

}  // namespace passo
