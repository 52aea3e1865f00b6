// passo cam job: the programs of a part, from a job file with a list of operations.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "cam_job.hpp"
#include "cam_profile_nest.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include "loose_pieces.hpp"
#include "named_files.hpp"
#include "part_job_nest.hpp"
#include "part_job_operation.hpp"
#include "part_job_programs.hpp"
#include "part_job_record.hpp"
#include "part_job_tool_use.hpp"
#include "part_job_trial.hpp"
#include "picture_names.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/confinement/temporary_folder.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/part_job/joined_program.hpp"

namespace passo {
namespace {

struct JobRun {
  const CamJobArguments& arguments;
  PartJob job;
  std::string text;  // of the job file
  std::string output = {};
  std::string fingerprint = {};
  PartJobZero zero = {};
  std::vector<OrderedOperation> order = {};
  std::vector<MadeOperation> made = {};  // as in PartJob::operations
  std::optional<NestedJob> nested = {};
  std::vector<TrialProgram> programs = {};
  std::vector<std::vector<LoosePiece>> loose = {};  // on each sheet

  std::size_t sheets() const { return nested ? nested->nest.sheets.size() : 1; }
};

// A program that is written to /dev/null has no record.
bool keeps_record(const JobRun& run) {
  return run.output != "/dev/null";
}

// "flat end mill 6 mm", without the number.
std::string tool_words(const PartJob& job, std::int32_t number) {
  const std::string words = describe(job.tools.at(number).tool);
  return words.substr(words.find(' ') + 1);
}

// A length of the job as a word of the program: "5" of "5mm" in a program in mm.
std::string program_number(const PartJob& job, std::string_view key, const std::string& text) {
  const double unit = *mm_of_unit(job.units);
  const Result<Mm, std::string> length = parse_length(std::string(key).c_str(), text, unit);
  const double value = length ? length->value() / unit : 0;
  return fmt::format("{:.5g}", std::round(value * 1e5) / 1e5 + 0.0);
}

// The park position "X0 Y0" as the operation's own program has it.
std::string park_words(const PartJob& job, const PartOperation& operation) {
  const std::string park = option_text(operation, "park");
  const std::size_t comma = park.find(',');
  if (comma == std::string::npos) return "X0 Y0";
  return fmt::format("X{} Y{}", program_number(job, "park", park.substr(0, comma)),
                     program_number(job, "park", park.substr(comma + 1)));
}

JoinedOperation joined_operation(const JobRun& run, std::size_t index, std::string program) {
  const PartOperation& operation = run.job.operations[index];
  JoinedOperation joined{
      .title = fmt::format("{}: {}, tool {}", operation.title, name_of(operation.kind), operation.tool),
      .program = std::move(program)};
  for (const std::int32_t tool : {operation.first_tool, operation.tool}) {
    if (tool > 0) joined.tools.push_back({tool, tool_words(run.job, tool)});
  }
  joined.park = park_words(run.job, operation);
  return joined;
}

// An operation once, or for each copy on the sheet. Facing is of the whole sheet.
void join_operation(const JobRun& run, std::size_t index, TrialProgram& program, JoinedProgram& joined) {
  const std::string& made = run.made[index].program;
  std::vector<std::string> texts = {made};
  if (run.nested && run.job.operations[index].kind != PartKind::face) {
    texts =
        programs_on_sheet(run.job, made, park_words(run.job, run.job.operations[index]), *run.nested, program.sheet);
  }
  for (std::string& text : texts) {
    joined.add(joined_operation(run, index, std::move(text)));
    program.operations.push_back(index);
  }
}

void join_sheet(JobRun& run, std::size_t sheet) {
  const PartJob& job = run.job;
  const std::string output = sheet_file(run.output, sheet, run.sheets());
  std::size_t number = 0;
  std::size_t at = 0;
  while (at < run.order.size()) {
    TrialProgram program{.sheet = sheet};
    const std::int32_t tool = job.operations[run.order[at].index].tool;
    program.file = job.one_program ? output : program_of_tool(output, ++number, tool);
    std::vector<std::string> head = {
        fmt::format("{}, by passo cam job", std::filesystem::path(program.file).filename().string()),
        fmt::format("from {}, inputs {}", std::filesystem::path(job.file).filename().string(), run.fingerprint)};
    if (!job.one_program) head.push_back(fmt::format("tool {}: {}", tool, tool_words(job, tool)));
    JoinedProgram joined(head, job.one_program ? JoinedProgram::Tools::changed : JoinedProgram::Tools::in_spindle);
    for (; at < run.order.size(); ++at) {
      const std::size_t index = run.order[at].index;
      if (!job.one_program && job.operations[index].tool != tool) break;
      join_operation(run, index, program, joined);
    }
    program.first_lines = joined.first_lines();
    program.text = joined.take();
    run.programs.push_back(std::move(program));
  }
}

// What the operations take on all sheets.
Trial all_of_trials(const std::vector<Trial>& trials) {
  Trial all = trials.front();
  for (std::size_t sheet = 1; sheet < trials.size(); ++sheet) {
    all.stock_mm3 += trials[sheet].stock_mm3;
    for (std::size_t i = 0; i < all.operations.size(); ++i) {
      TriedOperation& sum = all.operations[i];
      const TriedOperation& one = trials[sheet].operations[i];
      sum.moves += one.moves;
      sum.cut_mm += one.cut_mm;
      sum.cut_s += one.cut_s;
      sum.rapid_mm += one.rapid_mm;
      sum.removed_mm3 += one.removed_mm3;
      sum.depth_mm = std::max(sum.depth_mm, one.depth_mm);
      sum.pass_mm = std::max(sum.pass_mm, one.pass_mm);
      sum.plunges = sum.plunges || one.plunges;
    }
  }
  return all;
}

// Without tabs, parts and the scrap in their holes are meant to come loose.
void find_loose_pieces(JobRun& run, const HeightField& left, std::size_t sheet, Diagnostics& findings) {
  const Region parts = run.nested ? run.nested->outlines_on(sheet, *run.job.stock) : outline_of_part(run.job, run.zero);
  std::vector<LoosePiece> pieces = pieces_cut_free(left, parts);
  const bool has_no_tabs = std::ranges::any_of(run.job.operations, [](const PartOperation& operation) {
    const auto* const profile = std::get_if<CamProfileArguments>(&operation.arguments);
    return profile != nullptr && profile->no_tabs;
  });
  if (has_no_tabs) std::erase_if(pieces, &LoosePiece::is_part);
  if (!pieces.empty()) {
    Diagnostic finding = of_file("job.loose", run.job.file, describe(pieces, run.sheets() > 1 ? sheet + 1 : 0),
                                 "tabs, a larger nest.gap, or tape or a vacuum below the stock");
    finding.severity = Severity::warning;
    findings.add(std::move(finding));
  }
  run.loose.push_back(std::move(pieces));
}

std::vector<Trial> try_sheets(JobRun& run, Diagnostics& findings) {
  std::vector<Trial> trials;
  for (std::size_t sheet = 0; sheet < run.sheets(); ++sheet) {
    std::vector<TrialProgram> programs;
    std::ranges::copy_if(run.programs, std::back_inserter(programs),
                         [&](const TrialProgram& program) { return program.sheet == sheet; });
    trials.push_back(try_programs(run.job, programs, findings));
    // A field for each of many sheets would need much memory.
    if (std::optional<HeightField>& left = trials.back().field; left) {
      if (run.job.stock) find_loose_pieces(run, *left, sheet, findings);
      left.reset();
    }
  }
  return trials;
}

// All operations are tried, so that all errors are shown at once.
bool make_operations(JobRun& run, Diagnostics& findings, const WorkProgress& progress) {
  const std::optional<PartJobZero> zero = find_zero(run.job, findings);
  if (!zero) return false;
  run.zero = *zero;
  TemporaryFolder folder;
  if (!folder.make()) {
    findings.add(of_file("job.operation", run.job.file, "a temporary folder cannot be created", "space in TMPDIR"));
    return false;
  }
  run.made.resize(run.job.operations.size());
  const double share = 0.8 / static_cast<double>(run.order.size());
  for (std::size_t i = 0; i < run.order.size(); ++i) {
    const std::size_t index = run.order[i].index;
    const PartOperation& operation = run.job.operations[index];
    const double from = share * static_cast<double>(i);
    auto made = make_operation(run.job, operation, *zero, folder.name(), findings, progress.part(from, from + share));
    if (made) run.made[index] = std::move(*made);
  }
  if (findings.any_error() || !run.job.nesting) return !findings.any_error();
  run.nested = nest_job(run.job, run.made, *zero, findings, progress.part(0.8, 0.84));
  constexpr std::size_t most_sheets = 100;  // each is simulated
  if (run.nested && run.sheets() > most_sheets) {
    findings.add(run.job.finding("job.nest-sheets", run.job.nesting->place,
                                 fmt::format("the copies need {} sheets", run.sheets()),
                                 fmt::format("fewer copies, or a larger sheet: at most {} sheets", most_sheets)));
  }
  if (run.nested && run.sheets() > 1 && run.arguments.only_folder) {
    findings.add(
        run.job.finding("job.nest-sheets", run.job.nesting->place,
                        fmt::format("{} sheets need a program each, and only one is possible here", run.sheets()),
                        "fewer copies, or a larger sheet"));
  }
  return !findings.any_error();
}

// The programs in the words of the controller of the job file. They were tried in Passo's own words.
bool rewrite_programs(JobRun& run, Diagnostics& findings) {
  const PartJob& job = run.job;
  if (is_plain_program(job.program)) return true;
  const ControllerWords* const words = find_controller(job.program.controller);
  const LengthUnit unit = job.units == "inch" ? LengthUnit::inch : LengthUnit::mm;
  for (TrialProgram& program : run.programs) {
    PostProcessorOptions options = post_processor_options_of(job.program, job.units, unit);
    const PartOperation& first = job.operations[program.operations.front()];
    options.program = std::filesystem::path(program.file).filename().string();
    options.tools.resize(static_cast<std::size_t>(job.tools.rbegin()->first));
    for (const auto& [number, tool] : job.tools) {
      options.tools[static_cast<std::size_t>(number) - 1] = {tool_words(job, number), tool.tool.diameter.value()};
    }
    const std::int32_t called = first.first_tool > 0 ? first.first_tool : first.tool;
    options.first_tool = static_cast<std::uint32_t>(called);
    std::visit([&](const auto& arguments) { options.spindle = arguments.spindle; }, first.arguments);
    options.change_height =
        std::atof(program_number(job, "change-height", option_text(first, "change-height")).c_str());
    std::string written;
    PostProcessor processor(*words, std::move(options), [&](std::string_view piece) { written += piece; });
    processor.add(program.text);
    if (const auto why = processor.finish()) {
      findings.add(of_file("job.controller", program.file,
                           fmt::format("{} cannot run the program: {}", job.program.controller, *why),
                           "another controller in job.for"));
      return false;
    }
    program.text = std::move(written);
  }
  return true;
}

Status<OutputError> write_all(const JobRun& run, const std::string& record) {
  std::vector<OutputFile> files;
  const auto add = [&](const std::string& name, const std::string& text) -> Status<OutputError> {
    Result<OutputFile, OutputError> file = OutputFile::open(name);
    if (!file) return Failure{file.error()};
    file->write(text);
    files.push_back(std::move(*file));
    return Unit{};
  };
  for (const TrialProgram& program : run.programs) {
    if (auto added = add(program.file, program.text); !added) return added;
  }
  if (keeps_record(run)) {
    if (auto added = add(record_file_of(run.output), record); !added) return added;
  }
  for (OutputFile& file : files) {
    if (auto done = file.commit(); !done) return done;
  }
  return Unit{};
}

int draw(const JobRun& run, const Trial& trial, std::size_t sheet) {
  MillPlan plan;
  for (const OrderedOperation& ordered : run.order) {
    const PartOperation& operation = run.job.operations[ordered.index];
    std::vector<MillRun> ways = trial.operations[ordered.index].ways;
    std::erase_if(ways, [](const MillRun& way) { return way.size() < 2; });
    if (ways.empty()) continue;
    const Cutter& cutter = run.job.tools.at(operation.tool).shape.cutter;
    const bool is_vee = cutter.kind() == Cutter::Kind::v;
    plan.tools.push_back({.width = to_nanometres(is_vee ? 2 * cutter.flat : 2 * cutter.radius),
                          .words = operation.title,
                          .runs = std::move(ways)});
  }
  Region face;
  const Region nothing;
  MillScene scene{.plan = plan, .face = face, .face_name = "Stock", .warned = nothing};
  if (run.job.stock) {
    const PartStock& stock = *run.job.stock;
    const DrawnBox box{{to_nanometres(Mm(stock.x)), to_nanometres(Mm(stock.y))},
                       {to_nanometres(Mm(stock.x + stock.width)), to_nanometres(Mm(stock.y + stock.length))}};
    face = filled({rectangle(box)});
    if (run.nested) {
      face = run.nested->outlines_on(sheet, stock);
      scene.face_name = "Parts";
      scene.sheet = box;
      scene.offcut = run.nested->offcut_of(sheet, stock);
    }
  }
  scene.rapids = trial.rapids;
  const std::string file_name = sheet_file(run.arguments.picture, sheet, run.sheets());
  return write_picture(file_name, run.job.name, scene);
}

int check_only(const JobRun& run) {
  const auto record = read_job_record(run.output);
  const std::string why = record ? out_of_date(*record, run.fingerprint, run.output)
                                 : fmt::format("{} is missing", record_file_of(run.output));
  if (!why.empty()) {
    return fail(exit_failed, fmt::format("{}: out of date: {} [job.out-of-date]", run.output, why));
  }
  if (!run.arguments.json) say(fmt::format("{}: up to date\n", run.output));
  return exit_done;
}

bool names_are_apart(const JobRun& run) {
  NamedFiles files;
  files.reads("the job file", run.job.file);
  for (const PartOperation& operation : run.job.operations) {
    for (const std::string& file : operation.files) files.reads("a drawing", file);
  }
  files.reads("the tool library", run.job.library);
  name_texts_read(run.job.program, files);
  files.writes("--output", run.output);
  if (!run.job.one_program || run.sheets() > 1) {
    for (const TrialProgram& program : run.programs) files.writes("a program", program.file);
  }
  if (keeps_record(run)) files.writes("the record", record_file_of(run.output));
  for (std::size_t sheet = 0; sheet < run.sheets(); ++sheet) {
    files.writes("--picture", sheet_file(run.arguments.picture, sheet, run.sheets()));
  }
  return files.are_apart();
}

bool is_outside(const std::string& file) {
  const std::filesystem::path path(file);
  return path.is_absolute() || std::ranges::any_of(path, [](const auto& part) { return part == ".."; });
}

// An untrusted job file must not reveal the contents of other files of this computer.
void check_folder(const JobRun& run, Diagnostics& findings) {
  const auto refuse = [&](const SourceLocation& place, const std::string& file) {
    findings.add(run.job.finding("job.outside", place, fmt::format("'{}' is outside the job's folder", file),
                                 "a file in the folder of the job file"));
  };
  if (is_outside(run.job.library)) refuse({}, run.job.library);
  if (run.arguments.output.empty() && is_outside(run.job.output)) refuse({}, run.job.output);
  if (!run.job.one_program) {
    findings.add(run.job.finding("job.outside", {}, "only one program is possible here", "programs = \"one\""));
  }
  for (const std::string& file :
       {run.job.program.start_text, run.job.program.tool_change_text, run.job.program.end_text}) {
    if (is_outside(file)) refuse({}, file);
  }
  for (const PartOperation& operation : run.job.operations) {
    for (const std::string& file : operation.files) {
      if (is_outside(file)) refuse(operation.place, file);
    }
    PartOperation copy = operation;
    for (const CamOption& option : cam_options_of(copy)) {
      const auto key = std::ranges::find(operation.keys, option.name, &PartKey::name);
      if (option.kind != CamKind::file || key == operation.keys.end()) continue;
      if (const std::string file = text_of(option); is_outside(file)) refuse(key->place, file);
    }
  }
}

// The messages after everything is written.
void report(const JobRun& run, nlohmann::ordered_json record, const std::vector<std::string>& changes, bool is_again,
            const std::vector<std::string>& removed) {
  if (run.arguments.json) {
    record["changes"] = changes;
    record["removed"] = removed;
    say_summary(std::move(record));
    return;
  }
  std::string text = report_of(record);
  if (run.nested) text += nest_words(run.nested->nest, run.nested->options, 1);
  for (const OrderedOperation& ordered : run.order) {
    for (const std::string& words : run.made[ordered.index].notes) {
      text += fmt::format("note: '{}': {}\n", run.job.operations[ordered.index].title, words);
    }
  }
  for (const std::string& change : changes) text += "changed: " + change + "\n";
  if (is_again && changes.empty()) text += "changed: nothing since the last run\n";
  for (const TrialProgram& program : run.programs) text += fmt::format("written: {}\n", program.file);
  for (const std::string& file : removed)
    text += fmt::format("removed: {}, which the job does not make any more\n", file);
  say(text);
}

// Cuts far beside the stock: the drawing is probably larger, or elsewhere. The cutter may run along the stock's edge.
void warn_beside_stock(const JobRun& run, const Trial& trial, Diagnostics& findings) {
  if (!run.job.stock) return;
  const PartStock& stock = *run.job.stock;
  for (std::size_t i = 0; i < run.job.operations.size(); ++i) {
    const PartOperation& operation = run.job.operations[i];
    const double room = 3 * run.job.tools.at(operation.tool).shape.cutter.radius.value();
    const auto is_beside = [&](const MillPoint& point) {
      const double x = to_mm(point.at.x).value();
      const double y = to_mm(point.at.y).value();
      return x < stock.x - room || x > stock.x + stock.width + room || y < stock.y - room ||
             y > stock.y + stock.length + room;
    };
    for (const MillRun& way : trial.operations[i].ways) {
      const auto found = std::ranges::find_if(way, is_beside);
      if (found == way.end()) continue;
      Diagnostic finding = run.job.finding(
          "job.beside-stock", operation.place,
          fmt::format("'{}' cuts at X{:.4g} Y{:.4g} mm, beside the stock", operation.title, to_mm(found->at.x).value(),
                      to_mm(found->at.y).value()),
          fmt::format("a stock from X{:.4g} Y{:.4g} to X{:.4g} Y{:.4g} that the drawing fits on, or another zero",
                      stock.x, stock.y, stock.x + stock.width, stock.y + stock.length));
      finding.severity = Severity::warning;
      findings.add(std::move(finding));
      break;
    }
  }
}

int make_job(JobRun& run, const WorkProgress& progress) {
  Diagnostics findings(1000);
  if (run.arguments.only_folder) check_folder(run, findings);
  if (findings.any_error()) {
    show(findings, run.job.file);
    return exit_bad_program;
  }
  run.order = order_operations(run.job);
  for (const PartOperation& operation : run.job.operations) {
    if (run.job.one_program || operation.first_tool == 0 || operation.first_tool == operation.tool) continue;
    findings.add(run.job.finding("job.two-tools", operation.place, fmt::format("'{}' needs two tools", operation.title),
                                 "programs = \"one\""));
  }
  warn_of_idle_defaults(run.job, findings);
  const bool is_made = make_operations(run, findings, progress);
  if (!is_made || findings.any_error()) {
    show(findings, run.job.file);
    return exit_bad_program;
  }
  if (run.sheets() > 1 && run.output == "/dev/null") {
    return fail(exit_bad_program,
                fmt::format("{} sheets have a program each; --output must name a file", run.sheets()));
  }
  for (std::size_t sheet = 0; sheet < run.sheets(); ++sheet) join_sheet(run, sheet);
  if (!names_are_apart(run)) return exit_bad_program;
  progress.update(0.85);
  const std::vector<Trial> trials = try_sheets(run, findings);
  const Trial trial = all_of_trials(trials);
  warn_beside_stock(run, trial, findings);
  if (!findings.any_error()) static_cast<void>(rewrite_programs(run, findings));
  if (findings.any_error()) {
    show(findings, run.job.file);
    return exit_bad_program;
  }
  const auto before = keeps_record(run) ? read_job_record(run.output) : std::nullopt;
  const std::vector<EarlierProgram> earlier =
      before ? earlier_programs(*before, run.output, run.programs) : std::vector<EarlierProgram>();
  check_edited(earlier, run.arguments.force, findings);
  show(findings, run.job.file);
  if (findings.any_error()) return exit_failed;
  for (std::size_t i = 0; i < run.made.size(); ++i) {
    const std::vector<std::string> notes = tool_notes(run.job, run.job.operations[i], trial.operations[i]);
    run.made[i].notes.insert(run.made[i].notes.end(), notes.begin(), notes.end());
  }
  nlohmann::ordered_json record = record_of({run.job, run.order, run.made, trial, run.programs, run.fingerprint});
  if (run.nested) record["nest"] = nest_json(run.nested->nest, run.nested->options, corner_of(*run.job.stock));
  for (const auto& pieces : run.loose) record["loose"].push_back(loose_json(pieces));
  const std::vector<std::string> changes = before ? changes_of(*before, record) : std::vector<std::string>();
  const std::string text = record.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (const auto written = write_all(run, text); !written) return fail(exit_failed, written.error().message);
  if (!run.arguments.picture.empty()) {
    for (std::size_t sheet = 0; sheet < run.sheets(); ++sheet) {
      if (const int code = draw(run, trials[sheet], sheet); code != exit_done) return code;
    }
  }
  progress.update(1);
  report(run, record, changes, before.has_value(), remove_old_programs(earlier));
  return exit_done;
}

}  // namespace

int cam_job_file(const CamJobArguments& arguments, const WorkProgress& progress) {
  if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
  if (arguments.files.size() != 1) return fail(exit_bad_program, "expected one job file");
  Diagnostics findings;
  const auto text = read_bytes(arguments.files.front(), {.area = "job", .expected = "a job file in TOML"}, findings);
  auto job = text ? parse_part_job(*text, arguments.files.front(), findings) : std::nullopt;
  show(findings);
  if (!job) return exit_bad_program;
  JobRun run{.arguments = arguments, .job = std::move(*job), .text = *text};
  run.output = arguments.output.empty() ? run.job.output : arguments.output;
  if (run.output == "-")
    return fail(exit_bad_program, "--output: expected a file, because the record of the job is written next to it");
  if (!names_are_apart(run)) return exit_bad_program;
  if (!program_words_are_good(run.job.program, run.job.units)) return exit_bad_program;
  run.fingerprint = fingerprint_of_inputs(run.job, run.text);
  return arguments.check ? check_only(run) : make_job(run, progress);
}

}  // namespace passo
