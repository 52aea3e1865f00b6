// passo check: interprets the program, builds its path, and says what is wrong. Nothing runs on a machine. With
// --motion the path is also planned and stepped, and the motion is measured.
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "check_page.hpp"
#include "commands.hpp"
#include "findings_json.hpp"
#include "named_files.hpp"
#include "operator_prompt.hpp"
#include "program_input.hpp"
#include "program_messages.hpp"
#include "progress_display.hpp"
#include <fmt/format.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/program.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/link/await.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/proof/motion_proof.hpp"
#include "passo/proof/proof_text.hpp"
#include "passo/report/motion_picture.hpp"
#include "passo/report/output_file.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {
namespace {

const char* name_of(Action::Kind kind) {
  if (kind == Action::Kind::tool_change) return "M6";
  return kind == Action::Kind::optional_stop ? "M1" : "M0";
}

nlohmann::ordered_json as_json(const Diagnostics& findings, const ProgramStops& stops) {
  nlohmann::ordered_json waits = nlohmann::ordered_json::array();
  for (const OperatorWait& stop : stops.first()) {
    waits.push_back({{"line", stop.line}, {"for", name_of(stop.kind)}});
    if (stop.kind == Action::Kind::tool_change) waits.back()["tool"] = stop.tool;
  }
  return {{"good", !findings.any_error()},
          {"errors", findings.errors()},
          {"findings", as_json(findings.all())},
          {"waits", stops.count()},
          {"waits_first_at", waits}};
}

// Plays the whole program on a virtual machine and measures its motion. `nominal` is the time for the progress line.
MotionProof prove(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                  Seconds nominal, Diagnostics& findings, MotionRecorder* recorder) {
  constexpr unsigned turns_between_looks = 1024;
  MotionProver prover(proof_options(machine));
  ProgressDisplay progress(program.name());
  VirtualMachine board(machine.motor_count(), machine.board.clock, machine.board.highest_event_rate);
  IdealPlant plant = plant_of(machine, options.start);
  board.connect(plant);
  board.wire(pin_setup(machine));
  MachineSession session(machine, board, {.start = {.place = options.start, .trust = Trust::commanded}});
  while (session.state() == MachineState::offline) session.turn(endless);
  request::Start start{.program = std::move(program),
                       .options = options,
                       .nominal_time = nominal,
                       .waits_for_operator = false,
                       .live = false,
                       .answers_probes = false,
                       .findings = &findings};
  start.watchers.path = [&](const PathItem& item) {
    prover.watch(item);
    if (recorder != nullptr) recorder->watch(item);
  };
  start.watchers.motion = [&](const MotionItem& item) {
    prover.watch(item);
    if (recorder != nullptr) recorder->watch(item);
  };
  start.watchers.items = [&](const BoardItem& item) { prover.watch(item); };
  static_cast<void>(session.request(std::move(start)).has_value());
  for (unsigned turns = 0; session.busy(); ++turns) {
    session.turn(endless);
    if (turns % turns_between_looks == 0) progress.update(session.program()->nominal_time() / nominal);
  }
  return prover.finish();
}

int draw(const MotionRecorder& motion, const MotionProof& proof, const CheckArguments& arguments) {
  Result<OutputFile, OutputError> file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  const std::string name = std::filesystem::path(arguments.program.program).filename().string();
  const PictureOptions options{
      .format = *picture_format_of(arguments.picture),
      .program = name,
      .machine = fmt::format("{:.4f} s; on this path at least {:.4f} s, on any path within the "
                             "tolerance at least {:.4f} s",
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
            const InterpreterOptions& options, Seconds nominal, Diagnostics& findings) {
  MotionRecorder recorder(motion_limits(machine));
  const bool draws = !arguments.picture.empty();
  const MotionProof proof = prove(std::move(program), machine, options, nominal, findings, draws ? &recorder : nullptr);
  std::fputs((arguments.json ? to_json(proof) : to_text(proof)).c_str(), stdout);
  if (draws) {
    const int code = draw(recorder, proof, arguments);
    if (code != exit_done) return code;
  }
  return proof.good() ? exit_done : exit_failed;
}

}  // namespace

int check(const CheckArguments& arguments) {
  if (!arguments.picture.empty() && !picture_format_of(arguments.picture)) {
    return fail(exit_bad_program, arguments.picture + ": a picture's name ends in .svg or .png");
  }
  const bool draws_margin = arguments.colour_by == "margin";
  if (!arguments.colour_by.empty() && (!draws_margin || arguments.picture.empty() || arguments.motion)) {
    return fail(exit_bad_program, "--colour-by margin is for a --picture without --motion");
  }
  Diagnostics diagnostics;
  const auto machine = load_machine_file(arguments.machine, diagnostics);
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  std::optional<ProgramReader> program = open_program(arguments.program);
  const std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  NamedFiles files = files_of(arguments.program, *options);
  files.reads("the machine file", arguments.machine);
  files.writes("--picture", arguments.picture);
  if (!files.are_apart()) return exit_bad_program;

  Diagnostics findings;
  ProgramStops stops;
  ProgramMessages messages(arguments.program.program, !arguments.json);
  FindingsDisplay display(findings);
  const auto watch_path = [&](const PathItem& item) {
    stops.watch(item);
    if (!arguments.json) display.update();
  };
  const auto watch_operations = [&](const Operation& operation) { messages.show(operation); };
  const ProgramCheck result =
      check_program(program->again(), *machine, *options, findings, watch_path, watch_operations);
  if (result.good && (arguments.motion || (!arguments.picture.empty() && !draws_margin))) {
    display.finish();
    return measure(arguments, *machine, std::move(*program), *options, result.nominal_time, findings);
  }
  if (!arguments.json) display.finish();
  std::optional<CheckPage> page;
  PathRecorder path;
  if (result.good) page = judge(std::move(*program), *machine, *options, result, draws_margin ? &path : nullptr);
  if (page && draws_margin) {
    const int code = draw(path, *machine, arguments);
    if (code != exit_done) return code;
  }
  if (arguments.json) {
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    nlohmann::ordered_json json = as_json(findings, stops);
    if (page) add_to(json, *page, *machine);
    std::puts(json.dump(2, ' ', false, replace).c_str());
  } else {
    const char* const name = arguments.program.program.c_str();
    if (result.good) std::printf("%s: no errors\n", name);
    if (stops.count() > 0) std::printf("%s: waits for somebody at %s\n", name, stops.words().c_str());
    if (page) std::fputs(to_text(*page, *machine).c_str(), stdout);
  }
  if (page && page->lost()) {
    return fail(exit_failed, "the motors would lose steps: this part would be scrap [check.steps-lost]");
  }
  return result.good ? exit_done : exit_bad_program;
}

}  // namespace passo
