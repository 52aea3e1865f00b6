// passo cam relief: a program that carves a picture, or a body seen from above.
#include <filesystem>

#include "cam_job.hpp"
#include "cam_program.hpp"
#include "cam_relief_job.hpp"
#include "cam_tools.hpp"
#include "named_files.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include <nlohmann/json.hpp>

#include "passo/report/output_file.hpp"

namespace passo {

int cam_relief(const CamReliefArguments& arguments, const WorkProgress& progress) {
  if (arguments.two_sided != "no") return cam_relief_sides(arguments, progress);
  NamedFiles files;
  files.reads("the file", arguments.file);
  files.reads("--within", arguments.within);
  name_texts_read(arguments, files);
  name_library_read(arguments, files);
  files.writes("--output", arguments.output);
  files.writes("--picture", arguments.picture);
  if (!files.are_apart() || !program_words_are_good(arguments, arguments.units)) return exit_bad_program;
  if (!has_room_for_json(arguments.json, arguments.output)) return exit_bad_program;
  ReliefReading reading(*mm_of_unit(arguments.units));
  ReliefJob job = relief_job_of(arguments, reading);
  if (!reading.message().empty()) return fail(exit_bad_program, reading.message());
  if (!arguments.picture.empty() && !arguments.picture.ends_with(".png")) {
    return fail(exit_bad_program,
                fmt::format("--picture: expected a name that ends with .png, found '{}'", arguments.picture));
  }
  if (!read_curves(arguments.within, job.program.area.within)) return exit_bad_program;
  Diagnostics findings;
  const std::optional<ReliefGrid> read = read_relief(arguments, job, ModelSide::as_told, findings);
  if (!read) {
    show(findings);
    return exit_bad_program;
  }
  // A rim that stays is the stock's edge, or its face goes on: nothing is cut beyond.
  if (job.shape.margin.value() > 0 && job.shape.margin_at_top && !job.program.overrun) job.program.overrun = Mm(0);
  // A body ends at its edges, and its sides are cut. A picture's edges are where it was cut off.
  job.program.beside = read->is_body ? BesideGrid::nothing : BesideGrid::goes_on;
  if (!fits_memory(job.program, read->grid, arguments.file, findings)) {
    show(findings);
    return exit_bad_program;
  }
  place_relief(arguments, read->grid, reading, job.program);
  if (!reading.message().empty()) return fail(exit_bad_program, reading.message());
  if (!meet(job.program.area.within, read->grid, job.program, arguments.within, findings)) {
    show(findings);
    return exit_bad_program;
  }
  const std::string what = std::filesystem::path(arguments.file).filename().string();
  job.program.words = {fmt::format("from {}: {}", what, read->words), grid_words(read->grid)};
  for (const std::string& remark : arguments.tool_remarks) job.program.words.push_back(remark);

  Result<OutputFile, OutputError> file = OutputFile::open(arguments.output.empty() ? "-" : arguments.output);
  if (!file) return fail(exit_failed, file.error().message);
  std::optional<std::string> refused;
  const ReliefReport report =
      write_relief_in_words(arguments, job.program, *file, refused, [&](const ReliefSink& sink) {
        return write_relief(read->grid, job.program, sink, progress.part(0.05, 0.95), !arguments.picture.empty());
      });
  if (refused) return fail(exit_bad_program, fmt::format("--for {}: {}", arguments.controller, *refused));
  ProgressDisplay::clear_shown();  // the program may go to the same terminal
  if (const Status<OutputError> written = file->commit(); !written) return fail(exit_failed, written.error().message);
  if (!arguments.picture.empty()) {
    const std::string picture = draw_carved(report.carved, read->grid.pitch_x, read->grid.pitch_y);
    if (picture.empty()) return fail(exit_failed, "the picture cannot be drawn: out of memory");
    if (const int code = write_text(arguments.picture, picture); code != exit_done) return code;
  }
  progress.update(1);
  if (arguments.json) {
    const nlohmann::ordered_json json = {{"input", read->words},
                                         {"width_mm", read->grid.width().value()},
                                         {"length_mm", read->grid.length().value()},
                                         {"depth_mm", 0.0 - static_cast<double>(floor_of(read->grid))},
                                         {"columns", read->grid.columns},
                                         {"rows", read->grid.rows},
                                         {"passes", json_of(report)}};
    say_summary(json, arguments);
  } else if (!arguments.output.empty() && arguments.output != "-") {
    say(fmt::format("{}: {}\n{}\n{}", arguments.file, read->words, grid_words(read->grid), summary_of(report)));
  }
  return exit_done;
}

}  // namespace passo
