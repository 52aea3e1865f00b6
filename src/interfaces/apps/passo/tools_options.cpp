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

void add_import_options(CLI::App& command, ToolsImportArguments& arguments) {
  command.add_option("FILE", arguments.file, "tool library of Fusion, FreeCAD or LinuxCNC, or our own JSON")
      ->required();
  command.add_option("-o,--output", arguments.output, "the new tool library (TOML)")->required();
  command.add_option("--units", arguments.units, "units of a LinuxCNC tool table, which does not state them")
      ->check(CLI::IsMember({"mm", "inch"}));
  command.add_option("--shape", arguments.shape, "shape of the tools of a LinuxCNC tool table, which has none")
      ->check(CLI::IsMember({"flat", "ball", "drill"}));
  command.add_flag("--force", arguments.force, "replace an existing file");
  command.add_flag("--json", arguments.json, "print what was imported, changed and left out as JSON");
  command.footer(R"(Examples:
  passo tools import Router.tools -o tools.toml                              Fusion: cloud export, or JSON
  passo tools import Tools/Library/Default.fctl -o tools.toml                FreeCAD: a library, or one .fctb
  passo tools import tool.tbl --units mm --shape flat -o tools.toml          LinuxCNC

What is not understood is listed, and nothing is guessed: docs/manual/tools.md.)");
}

void add_export_options(CLI::App& command, ToolsExportArguments& arguments) {
  command.add_option("FILE", arguments.library, "tool library (TOML)")->required();
  command.add_option("-o,--output", arguments.output, "the new file, .tbl (LinuxCNC) or .json")->required();
  command.add_option("--format", arguments.format, "format of the new file (default: as its name ends)")
      ->check(CLI::IsMember({"linuxcnc", "json"}));
  command.add_option("--units", arguments.units, "units of the machine, for LinuxCNC")
      ->check(CLI::IsMember({"mm", "inch"}));
  command.add_flag("--force", arguments.force, "replace an existing file");
  command.footer(R"(Examples:
  passo tools export tools.toml -o tool.tbl --units mm     numbers, diameters and names for LinuxCNC
  passo tools export tools.toml -o tools.json              everything, for other programs

The JSON: docs/manual/tools.md.)");
}

void add_life_options(CLI::App& command, ToolsLifeArguments& arguments) {
  command.add_option("FILE", arguments.library, "tool library (TOML) with names and limits");
  command.add_option(
      "--tool-records", arguments.records,
      "file that counts what tools cut: tools.sqlite in the folder of passo serve --data (default: "
      "$XDG_STATE_HOME/passo/tools.sqlite or ~/.local/state/passo/tools.sqlite, where passo run counts)");
  command.add_option("--tools", arguments.table, "tool table (.tbl) with lengths and pockets");
  command.add_option("--machine-units", arguments.units, "unit of lengths in the tool table")
      ->check(CLI::IsMember({"mm", "inch"}))
      ->capture_default_str();
  command.add_option("--replaced", arguments.replaced, "tool that is new now, e.g. T3; can be repeated");
  command.add_flag("--json", arguments.json, "print the tools as JSON");
  command.footer(R"(Examples:
  passo tools life tools.toml                                     what passo run has counted
  passo tools life tools.toml --tool-records data/tools.sqlite    what passo serve --data data has counted
  passo tools life --replaced T3                                  T3 is new now

The limits and the count: docs/manual/tools.md.)");
}

}  // namespace

std::span<const Command> tools_commands() {
  static const std::array<Command, 5> commands{
      {{"list", "list the tools of a library", options_of<ToolsListArguments, add_list_options, tools_list>},
       {"feeds", "calculate the feeds and speeds of a tool in a material, with reasons",
        options_of<ToolsFeedsArguments, add_feeds_options, tools_feeds>},
       {"life", "show what tools have cut and what is left of their lives, or record a new tool",
        options_of<ToolsLifeArguments, add_life_options, tools_life>},
       {"import", "make a tool library from one of Fusion, FreeCAD or LinuxCNC",
        options_of<ToolsImportArguments, add_import_options, tools_import>},
       {"export", "write a tool library as a tool table for LinuxCNC, or as JSON",
        options_of<ToolsExportArguments, add_export_options, tools_export>}}};
  return commands;
}

}  // namespace passo
