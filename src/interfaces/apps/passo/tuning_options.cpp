#include "tuning_options.hpp"

#include "number_range.hpp"
#include <CLI/CLI.hpp>

namespace passo {

void add_tune_options(CLI::App& command, TuneArguments& arguments) {
  command.add_option("-m,--machine", arguments.machine, "machine file (TOML) with tables [axis.X.torque]")->required();
  command.add_option("--margin", arguments.margin, "fraction of the guaranteed torque that is reserved for cutting")
      ->check(number_range(0.1, 0.9))
      ->capture_default_str();
  command.add_option("--axes", arguments.axes, "axes to tune, e.g. XY (default: all with motor data in the file)");
  command
      .add_option("--way", arguments.way,
                  "length of the move to optimize for, mm or degrees (default: half of the axis' travel)")
      ->check(number_range(0.001, 1e6));
  command.add_flag("--keep-velocity", arguments.keep_velocity,
                   "keep the velocities of the file as upper limits, e.g. if a leadscrew limits them");
  command.add_option("-o,--output", arguments.output, "file for a copy of the machine file with the proposed values");
  command.add_option("-p,--picture", arguments.picture, "picture of torque over speed (FILE.svg or FILE.png)");
  command.add_flag("--json", arguments.json, "print the proposal as JSON");
  command.footer(
      R"(The proposal is checked as by passo check: the verdict for strokes, zigzags and circles at these limits is safe.
The copy keeps all comments. Homing and start-stop velocities above a lowered velocity are lowered with it.

Examples:
  passo tune -m router.toml                                 limits with a torque margin of 30 %
  passo tune -m router.toml --margin 0.5 -o tuned.toml      half of the torque reserved for cutting; write a copy
  passo tune -m router.toml --axes Z --way 10               short moves of one axis
  passo tune -m router.toml --picture curves.svg            available and required torque over speed

Criterion and curves: docs/manual/tuning.md.)");
}

}  // namespace passo
