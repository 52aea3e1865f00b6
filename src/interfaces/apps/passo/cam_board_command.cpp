// passo cam board: from the files of a board to numbered programs, a picture each, and a page that says what to do
// when.
#include <array>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "background_process.hpp"
#include "cam_board_maker.hpp"
#include "cam_job.hpp"
#include "cam_tools.hpp"
#include "progress_display.hpp"
#include "unfinished_job.hpp"
#include <nlohmann/json.hpp>

#include "passo/cam/board_job.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/report/board_picture.hpp"

namespace passo {
namespace {

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

// Checks that the layers for --mask and --stencil exist. Returns an exit code.
int check_openings(const CamBoardArguments& arguments, const BoardPlan& plan) {
  const auto has_none = [](const std::array<Region, 2>& openings) {
    return openings[0].empty() && openings[1].empty();
  };
  if (!arguments.mask.empty() && has_none(plan.mask)) {
    return fail(exit_bad_program,
                "--mask: expected a solder mask layer among the files; --as FILE='top mask' names one");
  }
  if (!arguments.stencil.empty() && has_none(plan.paste)) {
    return fail(exit_bad_program,
                "--stencil: expected a solder paste layer among the files; --as FILE='top paste' names one");
  }
  return exit_done;
}

}  // namespace

int cam_board(const CamBoardArguments& arguments, const WorkProgress& progress, CamDrillArguments drill,
              CamIsolateArguments isolate, CamOutlineArguments outline) {
  if (std::ranges::find(arguments.paths, "") != arguments.paths.end()) {
    return fail(exit_bad_program, "expected a folder, an archive or files, but the name is empty");
  }
  const bool probes = arguments.probe_holes || !arguments.heights.empty();
  if (probes && drill.controller != "passo" && drill.controller != "linuxcnc") {
    return fail(exit_bad_program, fmt::format("--for {}: --probe-holes and --heights write programs with expressions, "
                                              "which only passo and linuxcnc run",
                                              drill.controller));
  }
  Diagnostics findings;
  std::optional<MachineDescription> machine;
  if (!arguments.machine.empty()) {
    machine = load_machine_file(arguments.machine, findings, MachineUse::any_board);
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
  const Result<PanelGrid, std::string> grid = panel_of(arguments, outline);
  if (!grid) return fail(exit_bad_program, grid.error());
  const BoardPlan plan = board_plan_of(job, join, *grid, findings);
  if (!arguments.park.empty() && arguments.park != "last") {
    lengths.place("--park", arguments.park);
    if (!lengths.message().empty()) {
      return fail(exit_bad_program, fmt::format("--park: expected X,Y or last, found '{}'", arguments.park));
    }
    for (std::string* const park : {&drill.park, &isolate.park, &outline.park}) *park = arguments.park;
  }
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
  if (code == exit_done) code = check_openings(arguments, plan);
  if (code == exit_done) code = unfinished.begin();
  if (code == exit_done)
    code = make_all(maker, job, std::move(drill), std::move(isolate), std::move(outline), progress.part(0.1, 0.95));
  if (code == exit_done) code = unfinished.finish();
  if (code == exit_done) progress.update(1);
  // What was read helps to mend what was refused.
  if (code != exit_done) maker.page.steps.clear();
  if (arguments.json) say_summary(to_json(maker.page), arguments);
  if (code != exit_done || maker.joined_nets == 0) return code;
  return fail(exit_failed, fmt::format("{} still joined; the programs were written (--accept-joined accepts this)",
                                       counted(maker.joined_nets, "net") + " are"));
}

}  // namespace passo
