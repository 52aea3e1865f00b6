#include "cam_program.hpp"

#include <algorithm>
#include <utility>

#include "cam_job.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

const ControllerWords& controller_of(const CamProgramArguments& arguments) {
  const ControllerWords* const found = find_controller(arguments.controller);
  return found == nullptr ? controllers().front() : *found;
}

OperatorText read_text(const std::string& path, OperatorText::Place place, const ControllerWords& controller,
                       Diagnostics& findings) {
  if (path.empty()) return {};
  constexpr std::size_t most = 65'536;
  const auto bytes = read_bytes(path, {.area = "post", .expected = "a text of G-code lines", .most = most}, findings);
  return bytes ? OperatorText::read(*bytes, path, place, controller, findings) : OperatorText();
}

void read_texts(const CamProgramArguments& arguments, PostProcessorOptions& options, Diagnostics& findings) {
  const ControllerWords& controller = controller_of(arguments);
  options.start = read_text(arguments.start_text, OperatorText::Place::start, controller, findings);
  options.tool_change = read_text(arguments.tool_change_text, OperatorText::Place::tool_change, controller, findings);
  options.end = read_text(arguments.end_text, OperatorText::Place::end, controller, findings);
}

LengthUnit unit_of(ProgramUnits units) {
  return units == ProgramUnits::cm ? LengthUnit::cm : units == ProgramUnits::inch ? LengthUnit::inch : LengthUnit::mm;
}

int write_in_words(const CamProgramArguments& arguments, const std::string& output, const std::string& text,
                   PostProcessorOptions options) {
  std::string written;
  PostProcessor processor(controller_of(arguments), std::move(options),
                          [&](std::string_view piece) { written += piece; });
  processor.add(text);
  if (const auto why = processor.finish()) {
    return fail(exit_bad_program, fmt::format("--for {}: {}", arguments.controller, *why));
  }
  return write_text(output, written);
}

void set_place(PostProcessorOptions& options, DrawnPoint park, Nanometres height, double unit_mm) {
  options.park_x = to_mm(park.x).value() / unit_mm;
  options.park_y = to_mm(park.y).value() / unit_mm;
  options.change_height = to_mm(height).value() / unit_mm;
}

}  // namespace

bool is_plain_program(const CamProgramArguments& arguments) {
  return controller_of(arguments).knows_all() && arguments.start_text.empty() && arguments.tool_change_text.empty() &&
         arguments.end_text.empty();
}

PostProcessorOptions post_processor_options_of(const CamProgramArguments& arguments, const std::string& units,
                                               LengthUnit read_unit) {
  PostProcessorOptions options;
  options.read_unit = read_unit;
  options.written_unit = unit_of(program_units_of(units));
  options.spindle_seconds = arguments.spindle_delay;
  Diagnostics findings;  // program_words_are_good() has shown them
  read_texts(arguments, options, findings);
  return options;
}

bool program_words_are_good(const CamProgramArguments& arguments, const std::string& units) {
  if (!controller_of(arguments).knows_all() && units == "cm") {
    fail(exit_bad_program, fmt::format("--for {}: expected --units mm or inch, found cm", arguments.controller));
    return false;
  }
  Diagnostics findings;
  PostProcessorOptions options;
  read_texts(arguments, options, findings);
  show(findings);
  return !findings.any_error();
}

void name_texts_read(const CamProgramArguments& arguments, NamedFiles& files) {
  files.reads("--start-text", arguments.start_text);
  files.reads("--tool-change-text", arguments.tool_change_text);
  files.reads("--end-text", arguments.end_text);
}

void name_library_read(const CamToolArguments& arguments, NamedFiles& files) {
  files.reads("--tool-table", arguments.tool_table);
  files.reads("--limits", arguments.limits);
}

std::string_view coolant_word(const CamProgramArguments& arguments) {
  return arguments.coolant == "mist" ? "M7" : arguments.coolant == "flood" ? "M8" : "";
}

SafeChange safe_change_of(const CamProgramArguments& arguments, LengthArguments& lengths) {
  return {.height = lengths.above_0("--change-height", arguments.change_height),
          .spindle_seconds = arguments.spindle_delay,
          .coolant = coolant_word(arguments)};
}

int write_program(const CamMillArguments& arguments, const MillPlan& plan, const MillProgramOptions& options) {
  const std::string text = write_mill_program(plan, options);
  if (is_plain_program(arguments)) return write_text(arguments.output, text);
  PostProcessorOptions words = post_processor_options_of(arguments, arguments.units, unit_of(options.units));
  words.program = options.name;
  words.spindle = options.spindle;
  for (const MillTool& tool : plan.tools) words.tools.push_back({tool.words, to_mm(tool.width).value()});
  set_place(words, options.park, std::max(options.change.height, options.clearance), *mm_of_unit(arguments.units));
  return write_in_words(arguments, arguments.output, text, std::move(words));
}

int write_program(const CamDrillArguments& arguments, const DrillPlan& plan, const DrillProgramOptions& options) {
  DrillProgramOptions known = options;
  known.canned = options.canned && controller_of(arguments).knows_g("81") && controller_of(arguments).knows_g("83");
  const std::string text = write_drill_program(plan, known);
  if (is_plain_program(arguments)) return write_text(arguments.output, text);
  PostProcessorOptions words = post_processor_options_of(arguments, arguments.units, unit_of(options.units));
  words.program = options.name;
  words.spindle = options.spindle;
  for (const DrillTool& tool : plan.tools) {
    const double diameter = to_mm(tool.diameter).value();
    words.tools.push_back({fmt::format("{} {:.4g} mm", tool.is_mill ? "mill" : "drill", diameter), diameter});
  }
  set_place(words, options.park, std::max(options.change.height, options.clearance), *mm_of_unit(arguments.units));
  return write_in_words(arguments, arguments.output, text, std::move(words));
}

int write_program(const CamMillArguments& arguments, const std::string& text, const std::string& name,
                  DrawnPoint park) {
  if (is_plain_program(arguments)) return write_text(arguments.output, text);
  PostProcessorOptions words =
      post_processor_options_of(arguments, arguments.units, unit_of(program_units_of(arguments.units)));
  words.program = name;
  set_place(words, park, {}, *mm_of_unit(arguments.units));
  return write_in_words(arguments, arguments.output, text, std::move(words));
}

ReliefReport write_relief_in_words(const CamReliefArguments& arguments, const ReliefProgramOptions& program,
                                   OutputFile& file, std::optional<std::string>& refused,
                                   const std::function<ReliefReport(const ReliefSink&)>& make) {
  const auto to_file = [&](std::string_view text) { file.write(text); };
  if (is_plain_program(arguments) && arguments.units == "mm") return make(to_file);
  PostProcessorOptions options = post_processor_options_of(arguments, arguments.units, LengthUnit::mm);
  options.program = program.name;
  options.spindle = program.change.spindle;
  const auto add = [&](const ReliefTool& tool) {
    options.tools.push_back({describe(tool.cutter), 2 * tool.cutter.radius.value()});
  };
  if (program.roughing) add(program.roughing->tool);
  add(program.finish);
  if (program.rest) add(program.rest->tool);
  const double unit = *mm_of_unit(arguments.units);
  options.park_x = program.change.park.x.value() / unit;
  options.park_y = program.change.park.y.value() / unit;
  options.change_height = std::max(program.change.height, program.clearance).value() / unit;
  PostProcessor words(*find_controller(arguments.controller), std::move(options), to_file);
  ReliefReport report = make([&](std::string_view text) { words.add(text); });
  refused = words.finish();
  return report;
}

}  // namespace passo
