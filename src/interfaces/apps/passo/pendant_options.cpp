#include "pendant_options.hpp"

#include <array>

#include "machine_options.hpp"
#include "pendant_command.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

void add_list_options(CLI::App& command, PendantListArguments& arguments) {
  command.add_flag("--json", arguments.json, "print the list as JSON");
  add_system(command, arguments.system);
}

void add_watch_options(CLI::App& command, PendantWatchArguments& arguments) {
  command
      .add_option(
          "PENDANT", arguments.pendant,
          "auto: the first known pendant; hidraw:DEVICE; or a table FILE.toml, for the device that it describes")
      ->capture_default_str();
  command.add_option("--count", arguments.count, "exit after this many reports (default: at Ctrl-C)");
  add_system(command, arguments.system);
  command.footer(R"(Examples:
  passo pendant watch                        the first known pendant: bytes, and what they mean
  passo pendant watch hidraw:/dev/hidraw3    any device: its bytes, to write a table
  passo pendant watch mine.toml              try your own table

Nothing moves. Tables and the udev rule: docs/manual/pendants.md.)");
}

}  // namespace

std::span<const Command> pendant_commands() {
  static constexpr std::array<Command, 2> commands{
      {{"list", "list the HID devices of this computer, and which of them are known pendants",
        options_of<PendantListArguments, add_list_options, pendant_list>},
       {"watch", "show what is done at a pendant, live; nothing moves",
        options_of<PendantWatchArguments, add_watch_options, pendant_watch>}}};
  return commands;
}

}  // namespace passo
