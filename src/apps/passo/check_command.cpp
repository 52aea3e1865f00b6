// passo check: interpret the program and build its path, and say what is wrong. Nothing runs; with --motion the path is
// planned and stepped all the same, and the motion measured.
#include <cstdio>

#include "commands.hpp"
#include "findings_json.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"

#include "passo/activity/program.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/proof/motion_proof.hpp"
#include "passo/proof/proof_text.hpp"

namespace passo {
namespace {

nlohmann::ordered_json findings_as_json(const Diagnostics& findings) {
  return {{"good", !findings.any_error()}, {"errors", findings.errors()}, {"findings", as_json(findings.all())}};
}

// Plays the whole program, watched; `nominal` is for the progress line.
MotionProof prove(Job& job, const MachineDescription& machine, const std::string& program, Seconds nominal) {
  constexpr unsigned segments_between_looks = 1024;
  MotionProver prover(proof_options(machine));
  job.path().watch([&](const PathItem& item) { prover.watch(item); });
  job.motion().watch([&](const MotionItem& item) { prover.watch(item); });
  job.board().watch([&](const BoardItem& item) { prover.watch(item); });
  ProgressDisplay progress(program);
  for (unsigned played = 0; job.advance(); ++played) {
    if (played % segments_between_looks == 0) progress.update(job.nominal_time() / nominal);
  }
  return prover.finish();
}

}  // namespace

int check(const CheckArguments& arguments) {
  Diagnostics diagnostics;
  const auto machine = load_machine_file(arguments.machine, diagnostics);
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  std::optional<ProgramReader> program = open_program(arguments.program);
  const std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;

  Diagnostics findings;
  const ProgramCheck result = check_program(program->again(), *machine, *options, findings);
  if (result.good && arguments.motion) {
    show(findings);
    Job job(std::move(*program), *machine, *options, findings, {.probing = Job::Probing::nominal});
    const MotionProof proof = prove(job, *machine, arguments.program.program, result.nominal_time);
    std::fputs((arguments.json ? to_json(proof) : to_text(proof)).c_str(), stdout);
    return proof.good() ? exit_done : exit_failed;
  }
  if (arguments.json) {
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    std::puts(findings_as_json(findings).dump(2, ' ', false, replace).c_str());
  } else {
    show(findings);
    if (result.good) std::printf("%s: no errors\n", arguments.program.program.c_str());
  }
  return result.good ? exit_done : exit_bad_program;
}

}  // namespace passo
