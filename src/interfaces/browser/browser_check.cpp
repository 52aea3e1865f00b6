#include "browser_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "request_values.hpp"
#include <fmt/format.h>

#include "passo/activity/program.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/tool_table_file.hpp"
#include "passo/judge/check_page.hpp"
#include "passo/judge/fit_proposals.hpp"
#include "passo/judge/judgement.hpp"
#include "passo/judge/proposals.hpp"
#include "passo/machine_file/machine_kind.hpp"
#include "passo/toml/toml_text.hpp"

namespace passo {
namespace {

std::optional<TomlText::Setting> setting_of(const CheckJson& value) {
  if (value.is_number()) return value.get<double>();
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return value.get<std::string>();
  return {};
}

// The machine's text with these keys of [axis.X.torque] for each axis that has no motor yet.
std::string text_with(std::string text, const MachineDescription& machine, const CheckJson& motor) {
  auto edited = TomlText::read(text);
  if (!edited) return text;
  for (const AxisDescription& axis : machine.axes) {
    if (axis.motor) continue;
    for (const auto& [key, value] : motor.items()) {
      // A turntable has no mass in kg.
      const bool of_a_slide = key == "load_mass_kg" || key == "friction_n";
      const std::optional<TomlText::Setting> setting = setting_of(value);
      if (!setting || (of_a_slide && is_rotary(axis.axis))) continue;
      static_cast<void>(edited->set(fmt::format("axis.{}.torque.{}", letter_of(axis.axis), key), *setting));
    }
  }
  return edited->text();
}

std::optional<MachineDescription> machine_of(const CheckJson& request, CheckJson& answer) {
  const auto part = request.find("machine");
  const CheckJson none = CheckJson::object();
  const CheckJson& asked = part != request.end() && part->is_object() ? *part : none;
  const auto name = value_of<std::string>(asked, "name", "machine.toml");
  auto text = value_of<std::string>(asked, "text", "");
  Diagnostics findings;
  std::optional<MachineDescription> machine = parse_machine(text, name, findings);
  const auto motor = asked.find("motor");
  if (machine && motor != asked.end() && motor->is_object()) {
    text = text_with(std::move(text), *machine, *motor);
    findings.clear();
    machine = parse_machine(text, name, findings);
  }
  CheckJson told = {{"good", machine.has_value()}, {"findings", findings_with_sentences(findings)}};
  if (machine) {
    told["name"] = machine->name;
    told["lathe"] = is_lathe(*machine);
    CheckJson axes = CheckJson::array();
    for (const AxisDescription& axis : machine->axes) {
      axes.push_back({{"axis", std::string(1, letter_of(axis.axis))},
                      {"rotary", is_rotary(axis.axis)},
                      {"travel", {axis.travel_low, axis.travel_high}},
                      {"motor", axis.motor.has_value()}});
    }
    told["axes"] = std::move(axes);
  }
  answer["machine"] = std::move(told);
  return machine;
}

// As `passo check` sets them.
std::optional<InterpreterOptions> options_of(const CheckJson& request, Diagnostics& findings) {
  InterpreterOptions options;
  options.on_machine = true;
  options.dialect = value_of<std::string>(request, "dialect", "") == "grbl" ? Dialect::grbl : Dialect::linuxcnc;
  options.units = value_of(request, "inches", false) ? LengthUnits::inch : LengthUnits::mm;
  options.block_delete = value_of(request, "block_delete", false);
  options.machine_units = LengthUnits::mm;
  const auto tools = value_of<std::string>(request, "tools", "");
  if (!tools.empty() && !read_tool_table(tools, options.machine_units, options.tools, findings)) return std::nullopt;
  return options;
}

CheckJson as_json(const ProgramPath::Range& range) {
  if (range.empty()) return CheckJson();
  return {{"low", range.low}, {"high", range.high}};
}

CheckJson path_json(const ProgramPath& path, const MachineDescription& machine, const ToolTable& table) {
  CheckJson tools = CheckJson::array();
  for (const ProgramPath::UsedTool& used : path.tools()) {
    const Tool* const tool = table.find(used.number);
    const double by_table = tool == nullptr ? 0 : std::abs(tool->diameter.value());
    const double diameter = by_table > 0 ? by_table : machine.tool.diameter.value();
    tools.push_back({{"tool", used.number},
                     {"diameter", diameter > 0 ? CheckJson(diameter) : CheckJson()},
                     {"zero_z", used.zero_z},
                     {"feeds", used.feeds}});
  }
  CheckJson speeds;
  if (!path.speeds().empty()) {
    speeds = {{"low", path.speeds().low.value() * seconds_per_minute},
              {"high", path.speeds().high.value() * seconds_per_minute}};
  }
  return {{"cut_off", path.cut_off()},     {"points", path.points()},     {"chunks", path.chunks()},
          {"levels", ProgramPath::levels}, {"all", as_json(path.all())},  {"cuts", as_json(path.cuts())},
          {"work", as_json(path.work())},  {"speeds", std::move(speeds)}, {"tools", std::move(tools)}};
}

// How much of the program was read. Lines of loops come again, and count once.
class ReadBytes {
 public:
  explicit ReadBytes(std::uint64_t whole) : whole_(std::max(1.0, static_cast<double>(whole))) {}
  void watch(const Operation& operation) {
    if (operation.source.line <= line_) return;
    line_ = operation.source.line;
    read_ += static_cast<double>(operation.text.size()) + 1;
  }
  double share() const { return std::min(1.0, read_ / whole_); }

 private:
  double whole_;
  double read_ = 0;
  std::uint32_t line_ = 0;
};

constexpr std::uint64_t items_between_looks = 4096;

struct Looked {
  Diagnostics findings;
  ProgramStops stops;
  ProgramCheck result;
};

}  // namespace

std::string BrowserCheck::check(const std::string& request_text) {
  path_ = ProgramPath();
  CheckJson answer;
  const CheckJson request = CheckJson::parse(request_text, nullptr, false);
  const std::optional<MachineDescription> machine =
      machine_of(request.is_object() ? request : CheckJson::object(), answer);
  if (!machine) return written(answer);

  Looked first;
  const auto refused = [&] {
    answer.update(findings_as_json(first.findings, first.stops));
    answer["findings"] = findings_with_sentences(first.findings);
    return written(answer);
  };
  const std::optional<InterpreterOptions> options = options_of(request, first.findings);
  if (!options) return refused();
  Result<ProgramReader, Diagnostic> program = ProgramReader::open(value_of<std::string>(request, "program", ""));
  if (!program) {
    first.findings.add(program.error());
    return refused();
  }

  ReadBytes read(program->size());
  progress_(CheckStage::reading, 0);
  ProgramChecker checker(program->again(), *machine, *options, first.findings);
  checker.watch([&](const PathItem& item) {
    first.stops.watch(item);
    path_.add(item, checker.frame());
  });
  checker.watch_operations([&](const Operation& operation) {
    read.watch(operation);
    first.stops.watch(operation, options->tools);
  });
  while (!checker.go_on(items_between_looks)) progress_(CheckStage::reading, read.share());
  path_.finish();
  first.result = checker.result();

  std::optional<Judgement> page;
  if (first.result.good) {
    progress_(CheckStage::planning, 0);
    page = judge(program->again(), *machine, *options, first.result, {},
                 [&](double share) { progress_(CheckStage::planning, std::clamp(share, 0.0, 1.0)); });
  }
  answer.update(findings_as_json(first.findings, first.stops));
  answer["findings"] = findings_with_sentences(first.findings);
  if (page) add_to(answer, *page, *machine);
  if (page) {
    answer["cutting_s"] = page->summary.cutting_time.value();
    answer["rapid_s"] = page->summary.rapid_time.value();
    answer["feed_mm"] = page->summary.cutting_distance.value();
    answer["rapid_mm"] = page->summary.rapid_distance.value();
  }
  answer["path"] = path_json(path_, *machine, options->tools);
  // They take several times as long as the check, so the page asks for them alone.
  answer["proposals"] = CheckJson::array();
  if (value_of(request, "proposals", true)) {
    progress_(CheckStage::proposals, 0);
    answer["proposals"] = passo::as_json(
        proposals_of({*program, *machine, *options}, first.result, first.findings, page ? &*page : nullptr));
  }
  return written(answer);
}

}  // namespace passo
