// passo frame, passo go and passo macro.
#include "going_commands.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>

#include "cam_job.hpp"
#include "named_files.hpp"
#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/activity/program.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/interpreter/saved_offsets.hpp"
#include "passo/macro/macro.hpp"

namespace passo {
namespace {

std::optional<MachineDescription> machine_of(const std::string& file) {
  Diagnostics diagnostics;
  auto machine = load_machine_file(file, diagnostics);
  show(diagnostics);
  return machine;
}

int fail(const Sentence& sentence) {
  return fail(exit_bad_program, fmt::format("{} [{}]", sentence.text, sentence.code));
}

// In millimetres, whatever the unit of the file.
SavedParameters parameters_in_mm(const InterpreterOptions& options) {
  SavedParameters parameters = options.parameters;
  if (options.machine_units == LengthUnits::mm) return parameters;
  const auto scale = [&](int first) {
    for (const Axis axis : all_axes) {
      const auto found = parameters.find(first + static_cast<int>(index_of(axis)));
      if (found != parameters.end() && !is_rotary(axis)) found->second *= mm_per_inch;
    }
  };
  for (const int home : {1, 2}) scale(home_parameter(home));
  scale(g92_parameter);
  for (int system = 1; system <= work_systems; ++system) scale(work_offset_parameter(system));
  return parameters;
}

// The work coordinate system with which programs begin.
Frame first_frame(const SavedParameters& parameters) {
  const int system = static_cast<int>(saved_value(parameters, work_system_parameter));
  const int known = system >= 1 && system <= work_systems ? system : 1;
  Frame frame;
  frame.follow({operation::SetWorkOffset{.offset = saved_point(parameters, work_offset_parameter(known))}, {}});
  frame.follow({operation::SetRotation{saved_value(parameters, rotation_parameter(known))}, {}});
  return frame;
}

// NAME=VALUE. Returns whether it is one.
bool add_value(std::string_view text, MacroValues& values) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string_view::npos) return false;
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + equals + 1, end, value);
  values[std::string(text.substr(0, equals))] = value;
  return error == std::errc() && rest == end && std::isfinite(value);
}

}  // namespace

int frame(const FrameArguments& arguments) {
  NamedFiles files;
  files.reads("the program", arguments.program.program);
  files.reads("the machine file", arguments.machine);
  files.reads("--tools", arguments.program.tools);
  files.reads("--parameters", arguments.program.parameters);
  files.writes("--output", arguments.output);
  if (!files.are_apart()) return exit_bad_program;
  const auto machine = machine_of(arguments.machine);
  if (!machine) return exit_bad_machine;
  std::optional<ProgramReader> program = streamed_program(arguments.program);
  const std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  JobOutline outline;
  Diagnostics findings;
  const std::string name = program->name();
  const ProgramCheck check = check_program(std::move(*program), *machine, *options, findings,
                                           [&](const PathItem& item) { outline.add(item); });
  if (!check.good) {
    show(findings);
    return exit_bad_program;
  }
  if (!arguments.machine_zero && !outline.empty() && outline.work_zero() == Point()) {
    return fail(Sentence{.code = "framing.no-zero",
                         .text =
                             "the work zero is not set, so the job lies at machine zero: give the parameter file with "
                             "--parameters, or accept this with --machine-zero"});
  }
  const auto text = framing_program(outline, arguments.framing, *machine, name);
  return text ? write_text(arguments.output, *text) : fail(text.error());
}

int go(const GoArguments& arguments) {
  NamedFiles files;
  files.reads("the machine file", arguments.machine);
  files.reads("--parameters", arguments.files.parameters);
  files.writes("--output", arguments.output);
  if (!files.are_apart()) return exit_bad_program;
  const auto machine = machine_of(arguments.machine);
  if (!machine) return exit_bad_machine;
  const std::optional<InterpreterOptions> options = machine_options(arguments.files);
  if (!options) return exit_bad_program;
  const SavedParameters saved = parameters_in_mm(*options);
  const auto text = go_to_program(arguments.destination, *machine, saved, first_frame(saved));
  return text ? write_text(arguments.output, *text) : fail(text.error());
}

int macro(const MacroArguments& arguments) {
  NamedFiles files;
  files.reads("the macro", arguments.macro);
  files.writes("--output", arguments.output);
  if (!files.are_apart()) return exit_bad_program;
  MacroValues values;
  for (const std::string& one : arguments.values) {
    if (!add_value(one, values)) {
      return fail(exit_bad_program, fmt::format("expected NAME=VALUE, e.g. width=100, not '{}' [macro.value]", one));
    }
  }
  Diagnostics findings;
  const auto bytes =
      read_bytes(arguments.macro, {.area = "macro", .expected = "a macro", .most = Macro::longest}, findings);
  const auto read =
      bytes ? parse_macro(*bytes, std::filesystem::path(arguments.macro).stem().string(), arguments.macro, findings)
            : std::nullopt;
  show(findings);
  if (!read) return exit_bad_program;
  const auto text = macro_program(*read, values);
  return text ? write_text(arguments.output, *text) : fail(text.error());
}

}  // namespace passo
