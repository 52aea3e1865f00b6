#include "cam_options.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <type_traits>

#include "cam_tools.hpp"
#include "command_table.hpp"
#include "idle_options.hpp"
#include "number_range.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include <CLI/CLI.hpp>

#include "passo/operations/cam_operation.hpp"
#include "passo/operations/study_arguments.hpp"

namespace passo {
namespace {

constexpr const char* show_examples =
    R"(Examples:
  passo cam show board.zip                     list the layers that the layout program has exported
  passo cam show gerbers/ -p board.png         a folder; draw the board from above and from below
  passo cam show board.GTL board.GKO board.TXT --json
  passo cam show board.kicad_pcb               a KiCad board, without an export

Attributes or file names identify the layers: docs/manual/cam.md.)";

void add_show_options(CLI::App& show, CamShowArguments& arguments) {
  show.add_option("FILE", arguments.files,
                  "Gerber and drill files, boards of KiCad, EAGLE and EasyEDA, folders and zip archives of them")
      ->required();
  show.add_option("-p,--picture", arguments.picture,
                  "picture of the board from above and from below (FILE.svg or FILE.png)");
  show.add_flag("--json", arguments.json, "print the list as JSON");
  show.add_flag("--shapes", arguments.shapes,
                "print the shapes of a drawing (SVG, DXF, HPGL, drill file) with layer, colour and names, as JSON");
  show.footer(show_examples);
}

std::string name_of(const CamOption& option) {
  const std::string name(option.name);
  if (option.kind == CamKind::drawings) return name;
  return option.traits.letter.empty() ? "--" + name : "-" + std::string(option.traits.letter) + ",--" + name;
}

template <class Number>
void check_range(CLI::Option& option, CamRange range) {
  if constexpr (std::is_integral_v<Number>) {
    option.check(CLI::Range(static_cast<Number>(range.least), static_cast<Number>(range.most)));
  } else {
    option.check(number_range(range.least, range.most));
  }
}

template <class Value>
void add_option(CLI::App& command, const CamOption& row, Value& value) {
  const std::string help(row.help);
  if constexpr (std::is_same_v<Value, bool>) {
    command.add_flag(name_of(row), value, help);
  } else {
    CLI::Option& option = *command.add_option(name_of(row), value, help);
    constexpr bool is_list = std::is_same_v<Value, std::vector<std::string>>;
    option.required(row.traits.is_required);
    if (row.kind == CamKind::drawings) {
      if (is_list && row.traits.most_files > 0) option.expected(1, row.traits.most_files);
      return;
    }
    if constexpr (is_list) option.take_all();
    if (row.kind == CamKind::choice) {
      option.check(CLI::IsMember(std::vector<std::string>(row.traits.choices.begin(), row.traits.choices.end())));
    }
    if constexpr (std::is_arithmetic_v<Value>) {
      if (row.traits.range) check_range<Value>(option, *row.traits.range);
    } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
      if (row.traits.range) check_range<double>(option, *row.traits.range);
    }
    if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>) option.capture_default_str();
  }
}

template <class Arguments>
void add_cam_options(CLI::App& command, Arguments& arguments) {
  add_options(command, cam_options_of(arguments));
  command.footer(find_cam_operation(command.get_name())->examples);
}

// Runs an operation. Its progress has the name of the first input.
template <class Arguments, class Run>
int run_with_progress(const Arguments& arguments, Run run) {
  std::string input;
  if constexpr (requires { arguments.file; }) {
    input = arguments.file;
  } else if constexpr (requires { arguments.paths; }) {
    if (!arguments.paths.empty()) input = arguments.paths.front();
  } else if (!arguments.files.empty()) {
    input = arguments.files.front();
  }
  const std::string name = std::filesystem::path(input).filename().string();
  ProgressDisplay progress(name.empty() ? "passo cam" : name);
  return run(arguments, progress.work());
}

template <class Arguments, int (*run)(const Arguments&, const WorkProgress&)>
int shown(const Arguments& arguments) {
  const RecordedMessages shown_ones;
  return run_with_progress(arguments, run);
}

template <class Arguments, int (*run)(const Arguments&, const WorkProgress&)>
constexpr auto operation_of = options_of<Arguments, add_cam_options<Arguments>, shown<Arguments, run>>;

// The same for an operation whose cutters can be tools of a library.
template <class Arguments, int (*run)(const Arguments&, const WorkProgress&)>
std::function<int()> with_tools(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  add_cam_options(command, *arguments);
  return [arguments, &command] {
    const RecordedMessages shown_ones;
    const IsGiven is_given = [&](const char* option) { return command.count(option) > 0; };
    show_idle_options(idle_options_of(*arguments, is_given));
    const int code = use_tools(*arguments, is_given);
    return code == exit_done ? run_with_progress(*arguments, run) : code;
  };
}

// The options of a command whose options can be remembered for a machine. `part` is the member that they fill in.
template <auto part, auto run>
std::function<int()> remembered_of(CLI::App& command) {
  const auto all = std::make_shared<CamArguments>();
  add_cam_options(command, (*all).*part);
  add_remember_options(command, *all);
  return [all, &command] {
    const RecordedMessages shown_ones;
    if (const int code = use_remembered(command, *all); code != exit_done) return code;
    const IsGiven is_given = [&](const char* option) { return command.count(option) > 0; };
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype((*all).*part)>, CamDrillArguments>) {
      show_idle_options(idle_options_of((*all).*part, is_given));
    }
    const int code = use_tools((*all).*part, is_given);
    if (code != exit_done) return code;
    return run_with_progress((*all).*part, [](const auto& arguments, const WorkProgress& progress) {
      return run(arguments, progress, nullptr, nullptr);
    });
  };
}

// The options for the controller that are given for the whole board.
void take_controller(const CamBoardArguments& board, const IsGiven& is_given, CamProgramArguments& arguments) {
  if (is_given("--for")) arguments.controller = board.controller;
  if (is_given("--start-text")) arguments.start_text = board.start_text;
  if (is_given("--tool-change-text")) arguments.tool_change_text = board.tool_change_text;
  if (is_given("--end-text")) arguments.end_text = board.end_text;
  if (is_given("--change-height")) arguments.change_height = board.change_height;
  if (is_given("--spindle-delay")) arguments.spindle_delay = board.spindle_delay;
  if (is_given("--coolant")) arguments.coolant = board.coolant;
}

int make_board_job(CamArguments& all, const IsGiven& is_given, const WorkProgress& progress) {
  if (const int code = read_profile(all); code != exit_done) return code;
  if (!all.board.join.empty()) all.outline.join = all.board.join;
  for (CamProgramArguments* const one :
       {static_cast<CamProgramArguments*>(&all.drill), static_cast<CamProgramArguments*>(&all.isolate),
        static_cast<CamProgramArguments*>(&all.outline)}) {
    take_controller(all.board, is_given, *one);
  }
  const auto in_profile = [&](const char* command) {
    return [&, command](const char* option) {
      const std::vector<std::string>& options = all.of_profile[command];
      return std::ranges::find(options, option + 2) != options.end();  // without "--"
    };
  };
  const int code = use_tools(all.board, all.drill, in_profile("drill"), all.isolate, in_profile("isolate"), all.outline,
                             in_profile("outline"));
  if (code != exit_done) return code;
  return cam_board(all.board, progress, all.drill, all.isolate, all.outline);
}

std::function<int()> board_job_of(CLI::App& command) {
  const auto all = std::make_shared<CamArguments>();
  add_cam_options(command, all->board);
  return [all, &command] {
    const RecordedMessages shown_ones;
    const auto is_given = [&](const char* option) { return command.count(option) > 0; };
    return run_with_progress(all->board, [&](const CamBoardArguments& /*board*/, const WorkProgress& progress) {
      return make_board_job(*all, is_given, progress);
    });
  };
}

Command command_of(const char* name, std::function<int()> (*add)(CLI::App&)) {
  return {name, find_cam_operation(name)->purpose, add};
}

}  // namespace

void add_options(CLI::App& command, std::span<const CamOption> options) {
  for (const CamOption& row : options) {
    std::visit([&](auto* value) { add_option(command, row, *value); }, row.value);
  }
}

void add_tune_options(CLI::App& command, TuneArguments& arguments) {
  add_options(command, cam_options_of(arguments));
  command.footer(tune_study().examples);
}

std::span<const Command> cam_commands() {
  static const std::array<Command, 14> commands{
      {{"show", "list and draw the layers of a circuit board",
        options_of<CamShowArguments, add_show_options, cam_show>},
       command_of("drill", remembered_of<&CamArguments::drill, cam_drill>),
       command_of("isolate", remembered_of<&CamArguments::isolate, cam_isolate>),
       command_of("outline", remembered_of<&CamArguments::outline, cam_outline>),
       command_of("board", board_job_of),
       command_of("profile", with_tools<CamProfileArguments, cam_profile>),
       command_of("pocket", with_tools<CamPocketArguments, cam_pocket>),
       command_of("engrave", with_tools<CamEngraveArguments, cam_engrave>),
       command_of("thread", with_tools<CamThreadArguments, cam_thread>),
       command_of("job", operation_of<CamJobArguments, cam_job_file>),
       command_of("plot", operation_of<CamPlotArguments, cam_plot>),
       command_of("laser", operation_of<CamLaserArguments, cam_laser>),
       command_of("wire", operation_of<CamWireArguments, cam_wire>),
       command_of("relief", with_tools<CamReliefArguments, cam_relief>)}};
  return commands;
}

}  // namespace passo
