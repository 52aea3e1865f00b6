#include "motor_options.hpp"

#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* description =
    "Torque over speed of a stepping motor: pull-out, pull-in, and what is left to accelerate a load. Prints a table "
    "(CSV), or a picture or a summary instead. Rates are full steps a second.";

constexpr const char* examples = R"(Give the motor's data and its supply, or points of its data sheet's curve.

Examples:
  A small motor (1.7 A, 0.45 N·m) on 24 V, that moves as much inertia again against 0.1 N·m:
    passo motor --holding-torque 0.45 --current 1.7 --resistance 1.5 --inductance 2.8 --rotor-inertia 68 \
      --supply 24 --load-inertia 68 --friction 0.1 --picture motor.svg
  The same on 12 V through a resistor; how fast it starts and runs:
    passo motor --holding-torque 0.45 --current 1.7 --resistance 1.5 --inductance 2.8 --rotor-inertia 68 \
      --supply 12 --regulation resistive --friction 0.1 --json
  From points of a data sheet, as a table:
    passo motor --curve 0:0.40,1000:0.36,2000:0.25,4000:0.10,6000:0.04 --rotor-inertia 68

The model and its limits: docs/ramps/torque.md.)";

}  // namespace

CLI::App& add_motor_command(CLI::App& app, MotorArguments& arguments) {
  CLI::App& command = *app.add_subcommand("motor", description);
  command.footer(examples);
  const auto option = [&](const char* name, auto& value, const char* unit, const char* words) {
    return command.add_option(name, value, words)->type_name(unit);
  };

  option("--steps-per-rev", arguments.steps_per_revolution, "N", "full steps a revolution, a multiple of 4")
      ->capture_default_str()
      ->group("Motor");
  option("--rotor-inertia", arguments.rotor_inertia, "G_CM2", "inertia of the rotor, g·cm²")
      ->required()
      ->group("Motor");
  option("--holding-torque", arguments.holding_torque, "NM", "both phases on at the rated current, N·m")
      ->group("Motor");
  option("--current", arguments.current, "A", "rated current of a phase, A")->group("Motor");
  option("--resistance", arguments.resistance, "OHM", "of a phase, ohm")->group("Motor");
  option("--inductance", arguments.inductance, "MH", "of a phase, mH")->group("Motor");
  option("--data", arguments.data, "KIND",
         "connection that these four values are for: bipolar (whole coils) or unipolar (half coils, from the centre "
         "tap); without it, that of --drive")
      ->check(CLI::IsMember({"bipolar", "unipolar"}))
      ->group("Motor");

  option("--supply", arguments.supply, "V", "supply voltage, V")->group("Drive");
  option("--drive", arguments.drive, "KIND", "bipolar or unipolar")
      ->check(CLI::IsMember({"bipolar", "unipolar"}))
      ->capture_default_str()
      ->group("Drive");
  option("--regulation", arguments.regulation, "KIND",
         "chopper (holds the rated current) or resistive (a resistor in series limits it)")
      ->check(CLI::IsMember({"chopper", "resistive"}))
      ->capture_default_str()
      ->group("Drive");

  option("--curve", arguments.pull_out, "HZ:NM,...",
         "pull-out, instead of motor and drive: rate:torque,rate:torque,...")
      ->delimiter(',')
      ->group("Measured curves");
  option("--pull-in", arguments.pull_in, "HZ:NM,...", "pull-in of the rotor alone; without it, computed")
      ->delimiter(',')
      ->group("Measured curves");

  option("--load-inertia", arguments.load_inertia, "G_CM2", "as felt at the motor's shaft, g·cm²")->group("Load");
  option("--friction", arguments.friction, "NM", "at any speed, N·m")->group("Load");
  option("--viscous-friction", arguments.friction_per_speed, "NMS", "on top, growing with the speed, N·m·s/rad")
      ->group("Load");
  option("--margin", arguments.margin, "0...1", "part of the torque left over that may accelerate")
      ->capture_default_str()
      ->group("Load");

  option("--max-rate", arguments.max_rate, "HZ", "where table and picture end, full steps/s")->group("Output");
  option("--rows", arguments.rows, "N", "of the table")->capture_default_str()->group("Output");
  option("-p,--picture", arguments.pictures, "FILE", "draw the curves (FILE.svg or FILE.png), print no table")
      ->group("Output");
  command.add_flag("--json", arguments.json, "print a summary as JSON, no table")->group("Output");
  return command;
}

}  // namespace passo
