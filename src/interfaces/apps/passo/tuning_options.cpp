#include "tuning_options.hpp"

#include "number_range.hpp"
#include <CLI/CLI.hpp>

namespace passo {

void add_tune_options(CLI::App& command, TuneArguments& arguments) {
  command.add_option("-m,--machine", arguments.machine, "machine file (TOML) with tables [axis.X.torque]")->required();
  command
      .add_option("--margin", arguments.margin,
                  "the share of the weakest motor's torque that is never asked for: cutting needs it")
      ->check(number_range(0.1, 0.9))
      ->capture_default_str();
  command.add_option("--axes", arguments.axes, "only these, as XY; without it all whose motors the file describes");
  command
      .add_option("--way", arguments.way,
                  "the move whose time is made short, mm or degrees; without it half of an axis's travel")
      ->check(number_range(0.001, 1e6));
  command.add_flag("--keep-velocity", arguments.keep_velocity,
                   "no velocity above the file's, where something else than the motor sets it");
  command.add_option("-o,--output", arguments.output, "write a copy of the machine file with these values");
  command.add_option("-p,--picture", arguments.picture, "draw torque over speed (FILE.svg or FILE.png)");
  command.add_flag("--json", arguments.json, "print the proposal as JSON");
  command.footer(
      R"(What is proposed is checked, as by passo check: the verdict on strokes, zigzags and circles at these limits is safe.
The copy keeps all comments. Values that must not be above the velocity (homing, starting) are lowered with it.

Examples:
  passo tune -m router.toml                                 what its motors can do with a margin of 30 %
  passo tune -m router.toml --margin 0.5 -o tuned.toml      half of the torque for cutting; written into a copy
  passo tune -m router.toml --axes Z --way 10               short strokes of one axis
  passo tune -m router.toml --picture curves.svg            torque over speed, there and needed

The criterion and the curves: docs/manual/tuning.md.)");
}

}  // namespace passo
