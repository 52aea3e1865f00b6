#include "spindle_options.hpp"

#include <array>

#include "machine_options.hpp"
#include "spindle_command.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

void add_json(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print the result as JSON");
}

void add_show_options(CLI::App& command, SpindleShowArguments& arguments) {
  add_machine(command, arguments.machine);
  add_json(command, arguments.json);
}

void add_run_of_spindle_options(CLI::App& command, SpindleRunArguments& arguments) {
  command.add_option("RPM", arguments.rpm, "speed, rpm")->required()->check(CLI::Range(1.0, 65535.0));
  add_machine(command, arguments.machine);
  command.add_option("--for", arguments.seconds, "time at that speed, seconds")
      ->check(CLI::Range(0.1, 600.0))
      ->capture_default_str();
  command.add_flag("--reverse", arguments.reverse, "run counterclockwise (M4)");
  add_json(command, arguments.json);
  command.footer(R"(Examples:
  passo spindle run 12000 -m router.toml             12000 rpm for 5 s; Ctrl-C stops the spindle
  passo spindle run 8000 -m router.toml --for 60     a warm-up

The spindle turns! Take the tool out for the first try, and keep clear.)");
}

void add_scan_options(CLI::App& command, SpindleScanArguments& arguments) {
  add_machine(command, arguments.machine);
  command.add_option("--addresses", arguments.addresses, "highest address to try, from 1")
      ->check(CLI::Range(1, 247))
      ->capture_default_str();
  add_json(command, arguments.json);
  command.footer(R"(Example:
  passo spindle scan -m router.toml

It only reads: nothing turns. It tries the device and the kind of drive of the machine file at 2400 to 38400 baud, with
each parity.)");
}

}  // namespace

std::span<const Command> spindle_commands() {
  static constexpr std::array<Command, 3> commands{
      {{"show", "show what the spindle's drive reports; the spindle is stopped",
        options_of<SpindleShowArguments, add_show_options, spindle_show>},
       {"run", "run the spindle at a speed for some seconds, and report speed, current and load",
        options_of<SpindleRunArguments, add_run_of_spindle_options, spindle_run>},
       {"scan", "look for the address and the serial settings of the spindle's drive; nothing turns",
        options_of<SpindleScanArguments, add_scan_options, spindle_scan>}}};
  return commands;
}

}  // namespace passo
