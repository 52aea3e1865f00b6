// The options of the commands that study one thing at a time: pulses, chords, ramps, motors.
#include "study_options.hpp"

#include <array>

#include "number_range.hpp"
#include <CLI/CLI.hpp>

#include "passo/emulator/emulated_follower.hpp"

namespace passo {
namespace {

constexpr const char* motor_examples = R"(Give the motor's data and its supply, or points of its data sheet's curve.

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

void add_follower_options(CLI::App& command, FollowerArguments& arguments) {
  const std::vector<std::string> names = emulated_followers();
  command
      .add_option("FOLLOWER", arguments.follower,
                  "first_board, or board and drive: pic_, uno_, mega_ with two_on, wave, half_step")
      ->required()
      ->check(CLI::IsMember(names));
  command.add_option("--clock", arguments.clock, "pulses a second on the clock lines; without it none")
      ->check(number_range(0.0, 1e6));
  command.add_option("--axes", arguments.axes, "whose clock lines, as XZ")->capture_default_str();
  command.add_option("--down", arguments.down, "axes whose direction line is high from the start");
  command.add_option("--from", arguments.from, "SECONDS: the first pulse")
      ->check(number_range(0.0, 600.0))
      ->capture_default_str();
  command.add_option("--time", arguments.time, "SECONDS: how long it runs")
      ->check(number_range(0.001, 600.0))
      ->capture_default_str();
  command.add_option("-k,--key", arguments.keys, "KEY@FROM[:TO]: a key is held, else for 0.1 s; as 6@0.5:0.9 or #@0.1");
  command.add_option("--line", arguments.lines, "LINE@FROM[:TO]: a line is high, as relay@0.3:0.6 or direction.x@0.5");
  command.add_option("--image", arguments.image,
                     "another file than the one that the build made: .elf, .cod, or .hex, which is flashed");
  command.add_option("-t,--trace", arguments.traces, "write lines and outputs (FILE.vcd or FILE.csv), no table");
  command.add_option("-p,--picture", arguments.picture, "draw them (FILE.svg or FILE.png), no table");
  command.footer(
      R"(Prints a row at each change: the windings of each motor, the relay, the LEDs, and the keys and lines that are down.
Times are from the end of the reset. Lines are clock.x and direction.x (also y and z), relay, button and reset, which is
the emergency button. The first board waits for a key: without --key somebody presses * at 0.05 s.

Examples:
  passo follower sim first_board --clock 20                         as in its day: 20 Hz, and the windings on LEDs
  passo follower sim first_board --clock 20 --line reset@0.5        an emergency: the pulses go on, the motor does not
  passo follower sim first_board --key '#@0.1' --key 6@0.3:0.7      by hand
  passo follower sim uno_half_step --clock 200 --axes XY --down Y --time 0.3 --picture xy.svg
  passo follower sim pic_wave --clock 1000 --trace wave.vcd         for GTKWave)");
}

}  // namespace

void add_interpolate_options(CLI::App& command, InterpolateArguments& arguments) {
  command.add_option(
      "--method", arguments.method,
      "master-slave, lean, dda, slope-recalculated, slope-blocks, point-comparison or midpoint; bresenham is "
      "lean, or for an arc midpoint");
  command.add_option("--to", arguments.to, "end of the move in steps, X,Y[,Z...]")->required();
  command.add_option("--from", arguments.from, "its start; zero without it");
  command.add_option("--center", arguments.center, "an arc about X,Y; where start and end are the same, a full circle");
  command.add_flag("--cw", arguments.clockwise, "clockwise; else counterclockwise");
  command.add_flag("--half-loaded", arguments.half_loaded, "dda: the accumulators start half full");
  command.add_option("--register-bits", arguments.register_bits, "dda: longer registers than the move needs")
      ->check(CLI::Range(1, 31));
  command.add_option("--end", arguments.end, "point-comparison: how the end is judged")
      ->check(CLI::IsMember({"coordinates", "projection", "total"}));
  command.add_flag("--beats", arguments.beats,
                   "each pulse with its four beats: what is judged, what is fed, the new deviation, what is left");
  command.add_option("--time", arguments.time, "seconds for the whole move: each pulse with its duration");
  command.add_option("--feed", arguments.feed, "mm a minute, instead of --time");
  command
      .add_option("--rule", arguments.rule,
                  "of durations: roots (\u221An for a pulse of n axes; the usual one), exact, or beats (all the same)")
      ->check(CLI::IsMember({"roots", "exact", "beats"}));
  command.add_flag("--compare", arguments.compare, "every method that takes the move, side by side");
  command.add_option("-p,--picture", arguments.picture, "draw the pulses on the grid (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "write the pulses to a file");
  command.add_flag("--json", arguments.json, "the figures of the comparison, or of one method, as JSON");
  command.add_option("--steps-per-mm", arguments.steps_per_mm, "for deviations in \u00B5m, and for --feed")
      ->capture_default_str();
  command.footer(
      R"(Prints a line a pulse: its number, where each axis stands after it, and the method's decision variables.

Examples:
  passo interpolate --method lean --to 10,4                             master and slaves, as an interrupt does it
  passo interpolate --method dda --half-loaded --to 10,4,7              three axes, integrators half full
  passo interpolate --method midpoint --from 10,0 --to 0,10 --center 0,0
  passo interpolate --method master-slave --beats --to 7,3              the fractions and midlines of the cells
  passo interpolate --method point-comparison --beats --to 10,4         judge, feed, deviation, end counter
  passo interpolate --method bresenham --to 10,4 --time 1               how long each pulse lasts for an even speed
  passo interpolate --compare --to 27,10 --picture lines.svg            all methods for lines, as figures and drawn
  passo interpolate --compare --from 20,0 --to 20,0 --center 0,0 --cw   a full circle, by all methods for arcs)");
}

void add_chords_options(CLI::App& command, ChordsArguments& arguments) {
  command.add_option("--curve", arguments.curve, "line, arc, helix, ellipse, parabola, bezier or nurbs")->required();
  command.add_option("--from", arguments.from, "its start in mm, X,Y or X,Y,Z");
  command.add_option("--to", arguments.to, "its end; as high as the start unless told otherwise");
  command.add_option("--center", arguments.center, "arc, helix, ellipse: X,Y of the centre");
  command.add_flag("--cw", arguments.clockwise, "arc, helix: clockwise; else counterclockwise");
  command.add_option("--turns", arguments.turns, "arc, helix: of N turns, the last one as far as --to")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command.add_option("--radii", arguments.radii, "ellipse: A,B");
  command.add_option("--rotate", arguments.rotate, "ellipse: degrees from X to A");
  command.add_option("--angles", arguments.angles, "ellipse: FROM,TO in degrees from A towards B; all of it without");
  command.add_option("--vertex", arguments.vertex, "parabola: X,Y");
  command.add_option("--focus", arguments.focus, "parabola: X,Y");
  command.add_option("--control", arguments.control,
                     "bezier: the one or two control points between the ends; nurbs: all control points");
  command.add_option("--degree", arguments.degree, "nurbs: 1 to 9")->capture_default_str();
  command.add_option("--weights", arguments.weights, "nurbs: one a control point; 1 without");
  command.add_option("--knots", arguments.knots, "nurbs: points + degree + 1 of them; clamped and even without");
  CLI::Option* const tolerance =
      command.add_option("-t,--tolerance", arguments.tolerance, "how far chord and curve may be apart, in mm")
          ->capture_default_str();
  CLI::Option* const feed = command.add_option("--feed", arguments.feed, "mm a minute, for --period");
  CLI::Option* const period =
      command
          .add_option("--period", arguments.period,
                      "seconds: one chord in each period, equal chords of the length feed \u00B7 period")
          ->needs(feed)
          ->excludes(tolerance);
  feed->needs(period);
  command.add_option("--steps-per-mm", arguments.steps_per_mm, "N or X,Y,Z: where the chords end in steps as well");
  command.add_option("--fine", arguments.fine,
                     "step along the chords by this method for lines (lean, dda, ...): a line a pulse, not a chord");
  command.add_option("-p,--picture", arguments.picture,
                     "draw curve, chords and tolerance, with --fine the pulses (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "write the chords to a file");
  command.footer(
      R"(Prints a line a chord: its number, where it ends, and how far from the curve it is at most. Line 0 is the start.

Examples:
  passo chords --curve arc --from 10,0 --to 0,10 --center 0,0 --tolerance 0.1
  passo chords --curve arc --from 10,0 --to 10,0 --center 0,0 --picture circle.svg         a full circle, drawn
  passo chords --curve helix --from 8,0,0 --to 8,0,12 --center 0,0 --turns 4 --cw          a thread
  passo chords --curve ellipse --center 0,0 --radii 40,15 --rotate 30 --angles 0,-180      half of it, clockwise
  passo chords --curve parabola --vertex 0,0 --focus 0,10 --from -20,10 --to 30,22.5       a dish of 10 mm focal length
  passo chords --curve bezier --from 0,0 --control 0,20 --control 30,20 --to 30,0 --steps-per-mm 100
  passo chords --curve nurbs --degree 2 --control 10,0 10,10 0,10 --weights 1 0.70710678 1   a quarter of a circle
  passo chords --curve arc --from 10,0 --to 0,10 --center 0,0 --feed 600 --period 0.1      equal chords of 1 mm
  passo chords --curve ellipse --center 0,0 --radii 8,4 --tolerance 0.1 --steps-per-mm 5 --fine lean --picture e.svg)");
}

void add_ramp_options(CLI::App& command, RampArguments& arguments) {
  command
      .add_option("--method", arguments.method, "exact, table, recursive, or midpoint (the recursion that is exact)")
      ->check(CLI::IsMember({"exact", "recursive", "table", "midpoint"}));
  command.add_option("--clock", arguments.clock, "the timer's clock, Hz");
  command.add_option("--steps-per-rev", arguments.steps_per_turn, "of the motor");
  command.add_option("--accel", arguments.acceleration, "rad/s\u00B2");
  command.add_option("--max-rate", arguments.max_rate, "the wanted rate, steps/s; without it: as fast as it gets");
  command.add_option("--start-rate", arguments.start_rate, "what the motor starts and stops with at once, steps/s");
  command.add_option("--steps", arguments.steps, "the first N intervals of the ramp up");
  command.add_option("--move", arguments.move, "a whole move of N steps, from rest to rest");
  command.add_option("--stop-after", arguments.stop_after, "the --move is told to stop after N steps");
  command.add_option("--reverse-after", arguments.reverse_after,
                     "the --move is told after N steps to go back to its start; the CSV has its place too");
  command.add_option("--jerk", arguments.jerk, "bounds the jerk of a --move, rad/s\u00B3");
  command.add_option("--table-size", arguments.table_size, "entries of the table; without it: as many as needed");
  command.add_flag("--whole-ticks", arguments.whole_ticks, "exact, recursive: as the chip plays it");
  command.add_flag("--limit", arguments.limit,
                   "what a table can do: the acceleration --max-rate needs, the rate --accel"
                   " reaches. With --picture as charts over all motors, with -o as their table");
  command.add_option(
      "--print-table", arguments.print_table,
      "print the table of N entries (256, 512, ...) for a chip, with K_b and limits if the motor is named");
  command.add_option("--format", arguments.format, "of --print-table: c (without it), asm (GNU as) or csv")
      ->check(CLI::IsMember({"c", "asm", "csv"}));
  command.add_option("-p,--picture", arguments.picture, "draw all methods (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "write the intervals to a file");
  command.add_flag("--json", arguments.json, "the answer of --limit as JSON");
  command.footer(
      R"(Prints a line a step: its number, the timer counts to the next step, and the counts from rest to there.

Examples:
  passo ramp --method exact --clock 1000000 --steps-per-rev 200 --accel 10 --steps 20
  passo ramp --method table --clock 250000 --steps-per-rev 400 --accel 50 --max-rate 1500 --move 1000
  passo ramp --method exact --clock 1e6 --steps-per-rev 200 --accel 50 --max-rate 1500 --move 1000 --jerk 500
  passo ramp --method table --clock 250000 --steps-per-rev 400 --accel 50 --move 1000 --stop-after 40
  passo ramp --method table --clock 250000 --steps-per-rev 400 --accel 50 --move 1000 --reverse-after 40
  passo ramp --clock 250000 --steps-per-rev 400 --accel 50 --steps 24 --picture ramp.svg
  passo ramp --print-table 256 --format c --clock 250000 --steps-per-rev 400 --accel 50 -o ramp_table.h
  passo ramp --limit --table-size 256 --steps-per-rev 100 --max-rate 280      the acceleration that it takes
  passo ramp --limit --table-size 256 --steps-per-rev 100 --accel 20          the rate that is reached
  passo ramp --limit --max-rate 280 --picture limits.svg                      both, for all motors and two tables)");
}

void add_motor_options(CLI::App& command, MotorArguments& arguments) {
  command.footer(motor_examples);
  const auto option = [&](const char* name, auto& value, const char* unit, const char* what) {
    return command.add_option(name, value, what)->type_name(unit);
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

  option("--trial", arguments.trial, "KIND",
         "tries the motor out with its physics: torque (pull-out and pull-in over the rate), step (the response to one "
         "step), stop (steps at an even rate, without any ramp), resonance (the lag over the rate)")
      ->check(CLI::IsMember({"torque", "step", "stop", "resonance"}))
      ->group("Trials");
  option("--excitation", arguments.excitation, "KIND", "two-on, wave, half-step or microsteps:N")
      ->capture_default_str()
      ->group("Trials");
  option("--detent", arguments.detent, "NM", "torque of the motor without current, N·m")->group("Trials");
  option("--damping", arguments.damping, "0...1", "of the rotor's ringing; 1 is critical")
      ->capture_default_str()
      ->group("Trials");
  option("--rate", arguments.trial_rate, "HZ", "of step and stop, full steps/s")
      ->capture_default_str()
      ->group("Trials");
  option("--steps", arguments.trial_steps, "N", "of stop, steps of the driver")->capture_default_str()->group("Trials");
  option("--after", arguments.trial_after, "S", "how long step and stop go on after the last step")
      ->capture_default_str()
      ->group("Trials");

  option("--max-rate", arguments.max_rate, "HZ", "where table and picture end, full steps/s")->group("Output");
  option("--rows", arguments.rows, "N", "of the table")->capture_default_str()->group("Output");
  option("-p,--picture", arguments.pictures, "FILE", "draw the curves (FILE.svg or FILE.png), print no table")
      ->group("Output");
  command.add_flag("--json", arguments.json, "print a summary as JSON, no table")->group("Output");
}

void add_loop_options(CLI::App& command, LoopArguments& arguments) {
  command.add_option("--of", arguments.of, "what is controlled: speed, or position (a loop around that of the speed)")
      ->check(CLI::IsMember({"speed", "position"}))
      ->capture_default_str();
  command.add_option("--to", arguments.to, "the jump: rad/s (30 without it), or degrees (90)")
      ->check(number_range(-1e5, 1e5));
  command
      .add_option("--rule", arguments.rule, "of Ziegler and Nichols: p, pi or pid, from the gain at which it swings")
      ->check(CLI::IsMember({"p", "pi", "pid"}))
      ->capture_default_str();
  command.add_option("--gains", arguments.gains, "KP,KI,KD by hand, instead of the rule")
      ->delimiter(',')
      ->expected(3)
      ->check(number_range(0.0, 1e9));
  command.add_option("--speed-gains", arguments.speed_gains, "KP,KI,KD of the inner loop; without it PI by the rule")
      ->delimiter(',')
      ->expected(3)
      ->check(number_range(0.0, 1e9));
  command.add_flag("--compare", arguments.compare, "P, PI and PID by the rule side by side, and the --gains");
  command.add_option("--load", arguments.load, "NM@S: a torque against the motion, from a time on");
  command.add_option("--time", arguments.time, "seconds that are shown")
      ->check(number_range(0.001, 100.0))
      ->capture_default_str();
  command.add_option("--period", arguments.period_us, "of the control, in microseconds")
      ->check(number_range(10.0, 1e5))
      ->capture_default_str();
  command.add_option("--smoothing", arguments.smoothing_us, "of the counted speed: a time constant in microseconds")
      ->check(number_range(0.0, 1e6))
      ->capture_default_str();
  command.add_option("--counts", arguments.counts, "of the encoder, a turn")
      ->check(CLI::Range(4, 10'000'000))
      ->capture_default_str();
  command.add_option("-m,--machine", arguments.machine, "the motor of a machine file, with --axis; else a small one");
  command.add_option("--axis", arguments.axis, "its letter");
  command.add_option("-p,--picture", arguments.picture, "draw the response (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "write the table to a file");
  command.add_flag("--json", arguments.json, "gains and figures as JSON, no table");
  command.footer(
      R"(Prints a line for each period as CSV: the time, the wanted and the counted value, the true one, and the torques
that were asked for and given. The small motor: 0.45 N·m, 1.7 A, 24 V, with as much inertia again as load.

Examples:
  passo loop --rule p --json                                          P alone leaves an error
  passo loop --rule pi --load 0.1@0.05 --picture speed.svg            the integral brings the speed back
  passo loop --compare --picture rules.svg                            P, PI and PID by the rule
  passo loop --of position --gains 60,0,0 --picture place.svg         a loop around a loop, by hand
  passo loop --of position --period 1000 --counts 400 --rule p -o place.csv

The chapter: docs/ramps/loop.md.)");
}

void add_windings_options(CLI::App& command, WindingsArguments& arguments) {
  command.add_option("--drive", arguments.drive, "two-on, wave, half-step or microsteps:N (2 to 256)")->required();
  command.add_option("--full-steps", arguments.full_steps, "of the motors, a revolution")
      ->check(CLI::Range(4, 100'000))
      ->capture_default_str();
  InterpolateArguments& line = arguments.line;
  line.method = "bresenham";
  command.add_option("--to", line.to, "end of a line or an arc in the driver's steps, X,Y[,Z...]")->group("Line, arc");
  command.add_option("--from", line.from, "its start; zero without it")->group("Line, arc");
  command.add_option("--center", line.center, "an arc about X,Y")->group("Line, arc");
  command.add_flag("--cw", line.clockwise, "clockwise; else counterclockwise")->group("Line, arc");
  command.add_option("--method", line.method, "as of passo interpolate")->capture_default_str()->group("Line, arc");
  command.add_option("--time", line.time, "seconds for the whole move, at an even speed")->group("Line, arc");
  command.add_option("--feed", line.feed, "mm a minute, instead of --time")->group("Line, arc");
  command.add_option("--steps-per-mm", line.steps_per_mm, "for --feed")->capture_default_str()->group("Line, arc");
  RampArguments& ramp = arguments.ramp;
  ramp.method = "exact";
  command.add_option("--move", ramp.move, "a move of one motor, N of the driver's steps")->group("One motor");
  command.add_option("--clock", ramp.clock, "the timer's clock, Hz")->group("One motor");
  command.add_option("--accel", ramp.acceleration, "rad/s\u00B2")->group("One motor");
  command.add_option("--max-rate", ramp.max_rate, "the wanted rate, steps/s")->group("One motor");
  command.add_option("--start-rate", ramp.start_rate, "what it starts and stops with at once")->group("One motor");
  command.add_option("--reverse-after", ramp.reverse_after, "after N steps it is told to go back")->group("One motor");
  command.add_option("-t,--trace", arguments.traces, "write windings, currents and rotors (FILE.vcd or FILE.csv)");
  command.add_option("-p,--picture", arguments.picture, "draw them (FILE.svg or FILE.png)");
  command.footer(
      R"(Prints a line a pulse as CSV: the time, then for each motor its place, F1 to F4, the currents of phases A and B
as shares of the rated current, and the degrees that an unloaded rotor has turned. Line 1 is the start.

Examples:
  passo windings --drive two-on --to 10,4 --time 0.1
  passo windings --drive half-step --to 10,4,7 --time 0.1 --trace windings.vcd     for GTKWave
  passo windings --drive microsteps:16 --from 40,0 --to 0,40 --center 0,0 --time 0.5 --picture windings.svg
  passo windings --drive wave --move 40 --clock 250000 --accel 50 --reverse-after 12 --picture turn.svg)");
}

std::span<const Command> follower_commands() {
  static constexpr std::array<Command, 1> commands{
      {{"sim", "runs a follower's image on its emulated chip",
        options_of<FollowerArguments, add_follower_options, follower_sim>}}};
  return commands;
}

}  // namespace passo
