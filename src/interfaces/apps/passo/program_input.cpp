#include "program_input.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "progress_display.hpp"
#include <fmt/format.h>
#include <unistd.h>

#include "passo/interpreter/tool_table_file.hpp"

namespace passo {

std::optional<ProgramReader> streamed_program(const ProgramArguments& arguments) {
  Result<ProgramReader, Diagnostic> reader = ProgramReader::open(arguments.program);
  if (reader) return std::move(*reader);
  Diagnostics diagnostics;
  diagnostics.add(reader.error());
  show(diagnostics);
  return std::nullopt;
}

namespace {

LengthUnits machine_units(const ProgramArguments& arguments, const InterpreterOptions& options) {
  if (arguments.machine_units.empty() && options.settings) {
    if (const auto units = options.settings->machine_units()) return *units;
  }
  const std::string name = arguments.machine_units.empty() ? arguments.default_units : arguments.machine_units;
  return name == "inch" ? LengthUnits::inch : LengthUnits::mm;
}

void read_files(const ProgramArguments& arguments, InterpreterOptions& options, Diagnostics& diagnostics) {
  if (!arguments.settings.empty()) {
    auto settings = std::make_shared<SettingsFile>();
    if (!settings->read(arguments.settings, diagnostics)) return;
    const std::vector<std::string> folders = settings->sub_folders();
    options.sub_folders.insert(options.sub_folders.end(), folders.begin(), folders.end());
    options.settings = std::move(settings);
  }
  options.machine_units = machine_units(arguments, options);
  const std::string tools = tool_table_file(arguments, options);
  if (!tools.empty() && !read_tool_table(tools, options.machine_units, options.tools, diagnostics)) return;

  const std::string parameters = parameter_file(arguments, options);
  std::error_code problem;
  const bool may_lack = arguments.parameters_may_lack || arguments.parameters.empty();
  if (parameters.empty() || (may_lack && !std::filesystem::exists(parameters, problem))) return;
  (void)read_parameter_file(parameters, options.parameters, diagnostics);
}

}  // namespace

std::string tool_table_file(const ProgramArguments& arguments, const InterpreterOptions& options) {
  if (!arguments.tools.empty() || !options.settings || !arguments.files_of_settings) return arguments.tools;
  return options.settings->path_of("EMCIO", "TOOL_TABLE");
}

std::string parameter_file(const ProgramArguments& arguments, const InterpreterOptions& options) {
  if (!arguments.parameters.empty() || !options.settings || !arguments.files_of_settings) return arguments.parameters;
  return options.settings->path_of("RS274NGC", "PARAMETER_FILE");
}

NamedFiles files_of(const ProgramArguments& arguments, const InterpreterOptions& options) {
  NamedFiles files;
  files.reads("the program", arguments.program);
  files.reads("--settings", arguments.settings);
  files.reads("the tool table", tool_table_file(arguments, options));
  files.reads("the parameter file", parameter_file(arguments, options));
  files.reads_subs(std::filesystem::path(arguments.program).parent_path().string());
  for (const std::string& folder : options.sub_folders) files.reads_subs(folder);
  return files;
}

std::optional<InterpreterOptions> interpreter_options(const ProgramArguments& arguments) {
  InterpreterOptions options;
  options.sub_folders = arguments.sub_folders;
  options.block_delete = arguments.block_delete;
  options.units = arguments.inches ? LengthUnits::inch : LengthUnits::mm;
  options.dialect = arguments.dialect == "grbl" ? Dialect::grbl : Dialect::linuxcnc;
  options.user_codes = arguments.user_codes;
  options.idle_passes = arguments.loop_limit;
  options.repeated_steps = arguments.step_limit;
  Diagnostics diagnostics;
  read_files(arguments, options, diagnostics);
  show(diagnostics);
  if (diagnostics.any_error()) return std::nullopt;
  return options;
}

std::optional<InterpreterOptions> machine_options(const ProgramArguments& arguments) {
  std::optional<InterpreterOptions> options = interpreter_options(arguments);
  if (options) options->on_machine = true;
  return options;
}

namespace {

KeptMessages* kept = nullptr;
RecordedMessages* recorded = nullptr;

// Text on standard error takes the place of a progress line.
void show(const std::string& text) {
  ProgressDisplay::clear_shown();
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace

void show(const Diagnostics& diagnostics) {
  show(diagnostics, "passo");
}

void show(const Diagnostics& diagnostics, const std::string& file) {
  if (kept != nullptr) {
    for (Diagnostic finding : diagnostics.all()) {
      if (finding.file.empty()) finding.file = file;
      kept->findings.push_back(std::move(finding));
    }
    return;
  }
  if (recorded != nullptr) {
    const auto is_warning = [](const Diagnostic& finding) { return finding.severity == Severity::warning; };
    std::ranges::copy_if(diagnostics.all(), std::back_inserter(recorded->warnings), is_warning);
  }
  const bool colour = shows_colours(STDERR_FILENO);
  std::string text;
  std::size_t unnamed = 0;  // characters
  for (Diagnostic finding : diagnostics.all()) {
    unnamed += render(finding, colour).size();
    if (finding.file.empty()) finding.file = file;
    text += render(finding, colour);
  }
  show(text + render(diagnostics, colour).substr(unnamed));
}

void FindingsDisplay::show_new() {
  for (; shown_ < findings_.all().size(); ++shown_) {
    const std::string text = render(findings_.all()[shown_], shows_colours(STDERR_FILENO));
    shown_text_ += text.size();
    show(text);
  }
}

void FindingsDisplay::finish() {
  show(render(findings_, shows_colours(STDERR_FILENO)).substr(shown_text_));
}

int fail(ExitCode code, const std::string& message) {
  if (kept != nullptr) {
    kept->failures.push_back(message);
  } else {
    show(fmt::format("passo: error: {}\n", message));
  }
  return code;
}

void note(const std::string& words) {
  if (recorded != nullptr && kept == nullptr) recorded->notes.push_back(words);
  if (kept != nullptr) {
    kept->notes.push_back(words);
  } else {
    show(fmt::format("passo: note: {}\n", words));
  }
}

void say(const std::string& text) {
  if (kept != nullptr) {
    kept->said += text;
  } else {
    fmt::print("{}", text);
  }
}

KeptMessages::KeptMessages() : outer_(kept) {
  kept = this;
}
KeptMessages::~KeptMessages() {
  kept = outer_;
}

RecordedMessages::RecordedMessages() : outer_(recorded) {
  recorded = this;
}
RecordedMessages::~RecordedMessages() {
  recorded = outer_;
}
const RecordedMessages* RecordedMessages::current() {
  return kept == nullptr ? recorded : nullptr;
}

int flush_output() {
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (!failed) return exit_done;
  return errno == EPIPE ? 128 + SIGPIPE : fail(exit_failed, "cannot write to standard output");
}

}  // namespace passo
