#include "run_outputs.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "passo/interpreter/tool_table_file.hpp"
#include "passo/machine_file/machine_kind.hpp"
#include "passo/report/path_recorder.hpp"
#include "passo/report/picture.hpp"
#include "passo/report/trace_csv.hpp"
#include "passo/report/trace_vcd.hpp"

namespace passo {
namespace {

bool ends_with(std::string_view path, std::string_view ending) {
  if (path.size() < ending.size()) return false;
  const std::string_view tail = path.substr(path.size() - ending.size());
  for (std::size_t i = 0; i < ending.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(tail[i])) != ending[i]) return false;
  }
  return true;
}

TraceOptions trace_options(const MachineDescription& machine) {
  TraceOptions options{.motors = {},
                       .clock = machine.board.clock,
                       .step_pulse = machine.board.step_pulse,
                       .windings = machine.board.windings};
  for (const AxisDescription& axis : machine.axes) options.motors.push_back({axis.axis, axis.inverted});
  return options;
}

PictureOptions picture_look(const RunArguments& arguments, const MachineDescription& machine) {
  PictureOptions look;
  if (arguments.colour_by == "depth") look.colour = PathColour::depth;
  if (arguments.colour_by == "tool") look.colour = PathColour::tool;
  if (arguments.view == "top") look.view = FlatView::top;
  if (arguments.view == "front") look.view = FlatView::front;
  if (arguments.view == "side") look.view = FlatView::side;
  if (arguments.view == "lathe") look.view = FlatView::lathe;
  look.rapids = !arguments.no_rapids;
  look.is_lathe = is_lathe(machine);
  return look;
}

}  // namespace

struct RunOutputs::State {
  struct PictureFile {
    OutputFile file;
    PictureFormat format;
  };
  struct TraceFile {
    // The trace writes into this file, so the file must stay at one place in memory.
    std::unique_ptr<OutputFile> file;
    std::unique_ptr<Trace> trace;
  };

  std::vector<PictureFile> pictures;
  PictureOptions look;  // of all pictures
  std::vector<TraceFile> traces;
  std::optional<OutputFile> log;
  std::optional<OutputFile> report;
  std::optional<OutputFile> true_path;
  std::optional<OutputFile> parameters;
  std::optional<OutputFile> tools;
  std::string tool_lines;  // the text of the tool table before the run
  bool report_is_json = false;
  PathRecorder recorder;
  VirtualMachine* machine = nullptr;

  Status<OutputError> add_picture(const std::string& path);
  Status<OutputError> add_trace(const std::string& path, const TraceOptions& options);
};

Status<OutputError> RunOutputs::State::add_picture(const std::string& path) {
  const std::optional<PictureFormat> format = picture_format_of(path);
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return Failure{file.error()};
  pictures.push_back({.file = std::move(*file), .format = *format});
  return Unit{};
}

Status<OutputError> RunOutputs::State::add_trace(const std::string& path, const TraceOptions& options) {
  Result<OutputFile, OutputError> opened = OutputFile::open(path);
  if (!opened) return Failure{opened.error()};
  auto file = std::make_unique<OutputFile>(std::move(*opened));
  const TraceSink sink = [to = file.get()](std::string_view text) { to->write(text); };
  std::unique_ptr<Trace> trace;
  if (ends_with(path, ".vcd")) {
    trace = std::make_unique<TraceVcd>(options, sink);
  } else {
    trace = std::make_unique<TraceCsv>(options, sink);
  }
  traces.push_back({.file = std::move(file), .trace = std::move(trace)});
  return Unit{};
}

RunOutputs::RunOutputs(std::unique_ptr<State> state) : state_(std::move(state)) {}
RunOutputs::RunOutputs(RunOutputs&&) noexcept = default;
RunOutputs& RunOutputs::operator=(RunOutputs&&) noexcept = default;
RunOutputs::~RunOutputs() = default;

bool is_trace_name(const std::string& path) {
  return ends_with(path, ".vcd") || ends_with(path, ".csv");
}

Result<RunOutputs, OutputError> RunOutputs::open(const RunArguments& arguments, const MachineDescription& machine,
                                                 const std::string& parameters, const std::string& tools) {
  auto state = std::make_unique<State>();
  state->look = picture_look(arguments, machine);
  for (const std::string& path : arguments.pictures) {
    const Status<OutputError> added = state->add_picture(path);
    if (!added) return Failure{added.error()};
  }
  for (const std::string& path : arguments.traces) {
    const Status<OutputError> added = state->add_trace(path, trace_options(machine));
    if (!added) return Failure{added.error()};
  }
  if (!arguments.log.empty()) {
    Result<OutputFile, OutputError> file = OutputFile::open(arguments.log);
    if (!file) return Failure{file.error()};
    state->log.emplace(std::move(*file));
  }
  if (!arguments.report.empty()) {
    Result<OutputFile, OutputError> file = OutputFile::open(arguments.report);
    if (!file) return Failure{file.error()};
    state->report.emplace(std::move(*file));
    state->report_is_json = ends_with(arguments.report, ".json");
  }
  if (!arguments.motors.true_path.empty()) {
    Result<OutputFile, OutputError> file = OutputFile::open(arguments.motors.true_path);
    if (!file) return Failure{file.error()};
    state->true_path.emplace(std::move(*file));
  }
  if (!parameters.empty()) {
    Result<OutputFile, OutputError> file = OutputFile::open(parameters);
    if (!file) return Failure{file.error()};
    state->parameters.emplace(std::move(*file));
  }
  if (!tools.empty()) {
    std::ifstream before(tools, std::ios::binary);
    state->tool_lines.assign(std::istreambuf_iterator<char>(before), {});
    Result<OutputFile, OutputError> file = OutputFile::open(tools);
    if (!file) return Failure{file.error()};
    state->tools.emplace(std::move(*file));
  }
  return RunOutputs(std::move(state));
}

void RunOutputs::watch(VirtualMachine& machine, Watchers& watchers) {
  state_->machine = &machine;
  for (State::TraceFile& trace : state_->traces) machine.add_observer(*trace.trace);
  if (state_->log) {
    watchers.operations = [log = &*state_->log, before = std::move(watchers.operations)](const Operation& operation) {
      if (before) before(operation);
      const auto* line = std::get_if<operation::Log>(&operation.what);
      if (line == nullptr || line->kind != operation::Log::Kind::line) return;
      log->write(line->text);
      log->write("\n");
    };
  }
  if (state_->pictures.empty()) return;
  watchers.motion = [state = state_.get(), before = std::move(watchers.motion)](const MotionItem& item) {
    if (before) before(item);
    const auto* move = std::get_if<PlannedMove>(&item);
    state->recorder.watch(item, move != nullptr ? move->segment.work_zero : Point());
  };
}

OutputFile* RunOutputs::true_path() {
  return state_->true_path ? &*state_->true_path : nullptr;
}

bool RunOutputs::failed() const {
  if (state_->true_path && state_->true_path->failed()) return true;
  for (const State::TraceFile& trace : state_->traces) {
    if (trace.file->failed()) return true;
  }
  return false;
}

// Writes all files before the first one gets its name, so that a failed write leaves none of them.
Status<OutputError> RunOutputs::commit(const RunSummary& summary, const SavedParameters& parameters,
                                       const ToolTable& tools, LengthUnits machine_units) {
  for (State::TraceFile& trace : state_->traces) trace.trace->finish(state_->machine->now());
  for (State::PictureFile& picture : state_->pictures) {
    const std::string title = std::filesystem::path(summary.program).filename();
    PictureOptions options = state_->look;
    options.format = picture.format;
    options.program = title;
    options.machine = summary.machine;
    Status<OutputError> drawn = draw_picture(state_->recorder, options, picture.file);
    if (!drawn) return drawn;
  }
  if (state_->report) state_->report->write(state_->report_is_json ? to_json(summary) : to_text(summary, false));
  if (state_->parameters) state_->parameters->write(parameter_file_text(parameters));
  if (state_->tools) state_->tools->write(tool_table_text(state_->tool_lines, machine_units, tools));

  std::vector<OutputFile*> files;
  for (State::TraceFile& trace : state_->traces) files.push_back(trace.file.get());
  for (State::PictureFile& picture : state_->pictures) files.push_back(&picture.file);
  if (state_->log) files.push_back(&*state_->log);
  if (state_->report) files.push_back(&*state_->report);
  if (state_->true_path) files.push_back(&*state_->true_path);
  if (state_->parameters) files.push_back(&*state_->parameters);
  if (state_->tools) files.push_back(&*state_->tools);
  for (OutputFile* file : files) {
    Status<OutputError> committed = file->commit();
    if (!committed) return committed;
  }
  return Unit{};
}

}  // namespace passo
