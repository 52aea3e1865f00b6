#include "tools_options.hpp"

#include <array>
#include <string>
#include <vector>

#include "number_range.hpp"
#include "tools_command.hpp"
#include <CLI/CLI.hpp>

#include "passo/tooling/work_material.hpp"

namespace passo {
namespace {

void add_list_options(CLI::App& command, ToolsListArguments& arguments) {
  command.add_option("FILE", arguments.library, "tool library (TOML)")->required();
  command.add_flag("--json", arguments.json, "print the tools as JSON");
  command.footer(R"(Examples:
  passo tools list tools.toml                     the tools, one per line
  passo tools list tools.toml --json | jq '.tools[].number'

The file: docs/manual/tools.md.)");
}

void add_feeds_options(CLI::App& command, ToolsFeedsArguments& arguments) {
  const auto names = work_material_names();
  command.add_option("FILE", arguments.library, "tool library (TOML)")->required();
  command.add_option("-t,--tool", arguments.tool, "number of the tool, e.g. 3 or T3")->required();
  command.add_option("--material", arguments.material, "material to cut")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
  command.add_option("-m,--machine", arguments.machine, "machine file; its highest speeds are not exceeded");
  command.add_option("--depth", arguments.depth, "depth of a pass, mm (default: from the tables)")
      ->check(number_range(0.001, 1000));
  command
      .add_option(
          "--width", arguments.width,
          "radial width of the cut, % of the diameter; below 50 the feed is raised, because the chips become thinner")
      ->check(number_range(1, 100))
      ->capture_default_str();
  command.add_option("--rpm", arguments.rpm, "spindle speed (default: from the tables)")->check(number_range(1, 1e6));
  command.add_option("--min-rpm", arguments.least_rpm, "lowest spindle speed")->check(number_range(0, 1e6));
  command.add_option("--max-rpm", arguments.most_rpm, "highest spindle speed (default: from the machine file)")
      ->check(number_range(1, 1e6));
  command.add_flag("--json", arguments.json, "print the numbers as JSON");
  command.footer(R"(Examples:
  passo tools feeds tools.toml -t 3 --material plywood                  speeds, depth and stepover, with reasons
  passo tools feeds tools.toml -t 3 --material plywood -m router.toml   within the limits of the machine
  passo tools feeds tools.toml -t 1 --material aluminium --min-rpm 10000 --max-rpm 30000
  passo tools feeds tools.toml -t 1 --material hdpe --width 10          adaptive clearing with narrow cuts

These numbers are for a first test cut. The tables and their sources: docs/manual/tools.md.)");
}

}  // namespace

std::span<const Command> tools_commands() {
  static const std::array<Command, 2> commands{
      {{"list", "list the tools of a library", options_of<ToolsListArguments, add_list_options, tools_list>},
       {"feeds", "calculate the feeds and speeds of a tool in a material, with reasons",
        options_of<ToolsFeedsArguments, add_feeds_options, tools_feeds>}}};
  return commands;
}

}  // namespace passo
