// The options of the commands that study one thing at a time: pulses, chords, ramps, motors.
#include "study_options.hpp"

#include <array>

#include "number_range.hpp"
#include <CLI/CLI.hpp>

#include "passo/emulator/emulated_follower.hpp"

namespace passo {
namespace {

constexpr const char* motor_examples =
    R"(Give the motor's data and its supply, or points of the torque curve in its data sheet.

Examples:
  A small motor (1.7 A, 0.45 N·m) on 24 V, whose load has the rotor's inertia and 0.1 N·m of friction:
    passo motor --holding-torque 0.45 --current 1.7 --resistance 1.5 --inductance 2.8 --rotor-inertia 68 \
      --supply 24 --load-inertia 68 --friction 0.1 --picture motor.svg
  The same motor on 12 V with series resistors; its start-stop and running rates:
    passo motor --holding-torque 0.45 --current 1.7 --resistance 1.5 --inductance 2.8 --rotor-inertia 68 \
      --supply 12 --regulation resistive --friction 0.1 --json
  A table from points of a data sheet:
    passo motor --curve 0:0.40,1000:0.36,2000:0.25,4000:0.10,6000:0.04 --rotor-inertia 68

The model and its limits: docs/ramps/torque.md.)";

void add_follower_options(CLI::App& command, FollowerArguments& arguments) {
  const std::vector<std::string> names = emulated_followers();
  command
      .add_option("FOLLOWER", arguments.follower,
                  "follower: first_board, first_board_copied or first_board_as_listed, or board and drive mode: pic_, "
                  "uno_ or mega_ with two_on, wave or half_step")
      ->required()
      ->check(CLI::IsMember(names));
  CLI::Option* const clock =
      command
          .add_option("--clock", arguments.clock, "frequency of the pulses on the clock lines, Hz (default: no pulses)")
          ->check(number_range(0.0, 1e6));
  command.add_option("--axes", arguments.axes, "axes whose clock lines get pulses, e.g. XZ")->capture_default_str();
  command.add_option("--down", arguments.down, "axes whose direction line is high from the start");
  command
      .add_option("-i,--input", arguments.input,
                  "recorded signals to play: FILE.vcd or FILE.csv, e.g. of passo run --trace, GTKWave or sigrok")
      ->excludes(clock);
  command.add_option("--signal", arguments.signals,
                     "LINE=NAME: the recording's name of a line, e.g. clock.x=D0 (usual names are known)");
  command.add_option("--pulse", arguments.pulse, "lengthen the recording's pulses to this time, us")
      ->check(number_range(0.0, 1e6));
  command.add_option("--from", arguments.from, "time of the first pulse, or of the start of the recording, s")
      ->check(number_range(0.0, 600.0))
      ->capture_default_str();
  command
      .add_option("--time", arguments.time,
                  "duration of the run, s (default: 1, with --input to the end of the recording)")
      ->check(number_range(0.001, 600.0));
  command.add_option("-k,--key", arguments.keys,
                     "KEY@FROM[:TO]: hold a key (default: for 0.1 s), e.g. 6@0.5:0.9 or #@0.1");
  command.add_option("--line", arguments.lines,
                     "LINE@FROM[:TO]: set an input line high, e.g. relay@0.3:0.6 or direction.x@0.5");
  command.add_option("--image", arguments.image, "firmware file (.elf, .cod or .hex) instead of the built one");
  command.add_option("-t,--trace", arguments.traces,
                     "file for lines and outputs, instead of the table (FILE.vcd or FILE.csv)");
  command.add_option("-p,--picture", arguments.picture,
                     "picture of lines and outputs, instead of the table (FILE.svg or FILE.png)");
  command.footer(
      R"(Prints a row at each change: the windings of each motor, the relay, the LEDs, and the active keys and lines.
Times count from the end of the reset. The lines are clock.x and direction.x (also y and z), relay, button and reset,
the emergency button. The first board waits for a key: without --key, * is pressed at 0.05 s.

--input plays what another program or a logic analyser recorded, and then compares the pulses with the steps. Signals
such as X_step and X_dir, clock_x and direction_x, relay or spindle are known by their names. A run plays at most
2,000,000 changes of the lines in 600 s; --time ends it earlier. The pulses of passo run --trace are as long as the
machine file says: --pulse lengthens them for a slow follower.

Examples:
  passo follower sim first_board --clock 20                         as first built: 20 Hz, with the windings on LEDs
  passo follower sim first_board --clock 20 --line reset@0.5        an emergency stop: the pulses continue, the motor stops
  passo follower sim first_board --key '#@0.1' --key 6@0.3:0.7      manual control by keys
  passo follower sim uno_half_step --clock 200 --axes XY --down Y --time 0.3 --picture xy.svg
  passo follower sim pic_wave --clock 1000 --trace wave.vcd         for GTKWave
  passo follower sim first_board --input part.vcd --pulse 50 --trace windings.csv
  passo follower sim first_board --input captured.vcd --signal clock.x=D0 --signal direction.x=D3)");
}

}  // namespace

void add_interpolate_options(CLI::App& command, InterpolateArguments& arguments) {
  command.add_option("--method", arguments.method,
                     "interpolation method: master-slave, lean, dda, slope-recalculated, slope-blocks, "
                     "point-comparison or midpoint; bresenham is lean for lines and midpoint for arcs (default: "
                     "bresenham); or a faulty listing: listing:rounding, listing:shared-variable, "
                     "listing:slope-blocks or listing:projection");
  command.add_option(
      "--to", arguments.to,
      "end of the move in steps, X,Y[,Z...], or several points \"X,Y X,Y ...\" (default: a dialogue asks for "
      "the steps of each motor)");
  command.add_option("--from", arguments.from, "start of the move (default: 0)");
  command.add_option("--center", arguments.center,
                     "X,Y: centre of an arc; if start and end are the same, a full circle");
  command.add_flag("--cw", arguments.clockwise, "clockwise arc (default: counterclockwise)");
  command.add_flag("--half-loaded", arguments.half_loaded, "dda: start with half-full accumulators");
  command
      .add_option("--register-bits", arguments.register_bits,
                  "dda: register length in bits, longer than the move needs")
      ->check(CLI::Range(1, 31));
  command.add_option("--end", arguments.end, "point-comparison: end test")
      ->check(CLI::IsMember({"coordinates", "projection", "total"}));
  command.add_flag("--beats", arguments.beats,
                   "print the four beats of each pulse: judge, feed, new deviation, end counter");
  command.add_option("--time", arguments.time, "time of the whole move, s; prints the duration of each pulse");
  command.add_option("--feed", arguments.feed, "feed rate, mm/min, instead of --time");
  command
      .add_option(
          "--rule", arguments.rule,
          "rule for the durations: roots (\u221An for a pulse of n axes), exact, or beats (all equal; default: roots)")
      ->check(CLI::IsMember({"roots", "exact", "beats"}));
  command.add_flag(
      "--step-times", arguments.step_times,
      "with --time or --feed: a line for each point with its time TPS, its pulses of one axis N1 and of two "
      "axes N2, and the time of a step, t = TPS/(N1 + N2 \u221A2)");
  command.add_flag("--compare", arguments.compare, "compare all methods that support the move");
  command.add_option("-p,--picture", arguments.picture, "picture of the pulses on the grid (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "file for the pulses");
  command.add_flag("--json", arguments.json, "print the results of the comparison, or of one method, as JSON");
  command.add_option("--steps-per-mm", arguments.steps_per_mm, "scale, for deviations in \u00B5m and for --feed")
      ->capture_default_str();
  command.footer(
      R"(Prints a line for each pulse: its number, the position of each axis after it, and the method's decision variables.
Without --to it asks for the steps of motor 1, 2, ... until an empty line, and prints the positions after each pulse.
A faulty listing is a published program that is wrong on some moves; its wrong pulses are red in the picture.

Examples:
  passo interpolate --to 10,4                                           major and minor axis, as in an interrupt
  echo 10 4 | passo interpolate                                         the same by the dialogue: only the positions
  passo interpolate --method listing:shared-variable --to 10,4 -p l.svg  a listing that ends a step too far
  passo interpolate --method dda --half-loaded --to 10,4,7              three axes, half-full integrators
  passo interpolate --method midpoint --from 10,0 --to 0,10 --center 0,0
  passo interpolate --method master-slave --beats --to 7,3              the fractions and midlines of the cells
  passo interpolate --method point-comparison --beats --to 10,4         judge, feed, deviation, end counter
  passo interpolate --method bresenham --to 10,4 --time 1               pulse durations for a constant speed
  passo interpolate --to "27,3 27,30 0,0" --feed 60 --step-times        point after point: TPS, N1, N2, t
  passo interpolate --compare --to 27,10 --picture lines.svg            all methods for lines, as a table and a picture
  passo interpolate --compare --from 20,0 --to 20,0 --center 0,0 --cw   a full circle with all methods for arcs)");
}

void add_chords_options(CLI::App& command, ChordsArguments& arguments) {
  command.add_option("--curve", arguments.curve, "curve: line, arc, helix, ellipse, parabola, bezier or nurbs")
      ->required();
  command.add_option("--from", arguments.from, "start of the curve in mm, X,Y or X,Y,Z");
  command.add_option("--to", arguments.to, "end of the curve in mm (default for Z: the Z of the start)");
  command.add_option("--center", arguments.center, "arc, helix, ellipse: centre X,Y");
  command.add_flag("--cw", arguments.clockwise, "arc, helix: clockwise (default: counterclockwise)");
  command.add_option("--turns", arguments.turns, "arc, helix: number of turns; the last one ends at --to")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command.add_option("--radii", arguments.radii, "ellipse: semi-axes A,B");
  command.add_option("--rotate", arguments.rotate, "ellipse: angle from X to A, degrees");
  command.add_option("--angles", arguments.angles,
                     "ellipse: FROM,TO in degrees from A towards B (default: the whole ellipse)");
  command.add_option("--vertex", arguments.vertex, "parabola: vertex X,Y");
  command.add_option("--focus", arguments.focus, "parabola: focus X,Y");
  command.add_option("--control", arguments.control,
                     "bezier: the one or two control points between the ends; nurbs: all control points");
  command.add_option("--degree", arguments.degree, "nurbs: degree, 1 to 9")->capture_default_str();
  command.add_option("--weights", arguments.weights, "nurbs: weights, one per control point (default: 1)");
  command.add_option("--knots", arguments.knots,
                     "nurbs: knots, as many as points + degree + 1 (default: clamped, evenly spaced)");
  CLI::Option* const tolerance =
      command.add_option("-t,--tolerance", arguments.tolerance, "largest distance between chord and curve, mm")
          ->capture_default_str();
  CLI::Option* const feed = command.add_option("--feed", arguments.feed, "feed rate, mm/min; needs --period");
  CLI::Option* const period = command
                                  .add_option("--period", arguments.period,
                                              "interpolation period, s: equal chords of length feed \u00B7 period")
                                  ->needs(feed)
                                  ->excludes(tolerance);
  feed->needs(period);
  command.add_option("--steps-per-mm", arguments.steps_per_mm, "scale, N or X,Y,Z: prints the chord ends in steps too");
  command.add_option("--fine", arguments.fine,
                     "method for lines (lean, dda, ...) that steps along the chords: prints a line for each pulse "
                     "instead of each chord");
  command.add_option("-p,--picture", arguments.picture,
                     "picture of curve, chords and tolerance, and with --fine the pulses (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "file for the chords");
  command.footer(
      R"(Prints a line for each chord: its number, its end, and its largest distance from the curve. Line 0 is the start.

Examples:
  passo chords --curve arc --from 10,0 --to 0,10 --center 0,0 --tolerance 0.1
  passo chords --curve arc --from 10,0 --to 10,0 --center 0,0 --picture circle.svg         picture of a full circle
  passo chords --curve helix --from 8,0,0 --to 8,0,12 --center 0,0 --turns 4 --cw          a thread
  passo chords --curve ellipse --center 0,0 --radii 40,15 --rotate 30 --angles 0,-180      half an ellipse, clockwise
  passo chords --curve parabola --vertex 0,0 --focus 0,10 --from -20,10 --to 30,22.5       a dish of 10 mm focal length
  passo chords --curve bezier --from 0,0 --control 0,20 --control 30,20 --to 30,0 --steps-per-mm 100
  passo chords --curve nurbs --degree 2 --control 10,0 10,10 0,10 --weights 1 0.70710678 1   a quarter circle
  passo chords --curve arc --from 10,0 --to 0,10 --center 0,0 --feed 600 --period 0.1      equal chords of 1 mm
  passo chords --curve ellipse --center 0,0 --radii 8,4 --tolerance 0.1 --steps-per-mm 5 --fine lean --picture e.svg)");
}

void add_ramp_options(CLI::App& command, RampArguments& arguments) {
  command
      .add_option("--method", arguments.method, "method: exact, table, recursive, or midpoint (the exact recursion)")
      ->check(CLI::IsMember({"exact", "recursive", "table", "midpoint"}));
  command.add_option("--clock", arguments.clock, "timer frequency, Hz");
  command.add_option("--steps-per-rev", arguments.steps_per_turn, "steps per revolution of the motor");
  command.add_option("--accel", arguments.acceleration, "acceleration, rad/s\u00B2");
  command.add_option("--max-rate", arguments.max_rate,
                     "target step rate, steps/s (default: the highest that is reached)");
  command.add_option("--start-rate", arguments.start_rate, "start-stop rate, steps/s");
  command.add_option("--steps", arguments.steps, "number of intervals of the acceleration ramp to print");
  command.add_option("--move", arguments.move, "whole move of N steps, from standstill to standstill");
  command.add_option("--stop-after", arguments.stop_after, "stop the --move after N steps");
  command.add_option("--reverse-after", arguments.reverse_after,
                     "reverse the --move after N steps, back to its start; the CSV then includes the position");
  command.add_option("--jerk", arguments.jerk, "jerk limit of a --move, rad/s\u00B3");
  command.add_option("--table-size", arguments.table_size, "number of table entries (default: as many as needed)");
  command.add_flag("--whole-ticks", arguments.whole_ticks,
                   "exact, recursive: round to whole timer ticks, as the chip does");
  command.add_flag("--limit", arguments.limit,
                   "limits of a table: the acceleration that --max-rate needs, or the rate that --accel reaches; "
                   "--picture draws them for all motors, -o writes them as a table");
  command.add_option(
      "--print-table", arguments.print_table,
      "print a table of N entries (256, 512, ...) for a chip, with K_b and limits if the motor is given");
  command.add_option("--format", arguments.format, "format of --print-table: c, asm (GNU as) or csv (default: c)")
      ->check(CLI::IsMember({"c", "asm", "csv"}));
  command.add_option("-p,--picture", arguments.picture, "picture of all methods (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "file for the intervals");
  command.add_flag("--json", arguments.json, "print the result of --limit as JSON");
  command.footer(
      R"(Prints a line for each step: its number, the timer counts to the next step, and the counts since the start.

Examples:
  passo ramp --method exact --clock 1000000 --steps-per-rev 200 --accel 10 --steps 20
  passo ramp --method table --clock 250000 --steps-per-rev 400 --accel 50 --max-rate 1500 --move 1000
  passo ramp --method exact --clock 1e6 --steps-per-rev 200 --accel 50 --max-rate 1500 --move 1000 --jerk 500
  passo ramp --method table --clock 250000 --steps-per-rev 400 --accel 50 --move 1000 --stop-after 40
  passo ramp --method table --clock 250000 --steps-per-rev 400 --accel 50 --move 1000 --reverse-after 40
  passo ramp --clock 250000 --steps-per-rev 400 --accel 50 --steps 24 --picture ramp.svg
  passo ramp --print-table 256 --format c --clock 250000 --steps-per-rev 400 --accel 50 -o ramp_table.h
  passo ramp --limit --table-size 256 --steps-per-rev 100 --max-rate 280      the acceleration that this rate needs
  passo ramp --limit --table-size 256 --steps-per-rev 100 --accel 20          the rate that this acceleration reaches
  passo ramp --limit --max-rate 280 --picture limits.svg                      picture of both limits, for all motors)");
}

void add_motor_options(CLI::App& command, MotorArguments& arguments) {
  command.footer(motor_examples);
  const auto option = [&](const char* name, auto& value, const char* unit, const char* what) {
    return command.add_option(name, value, what)->type_name(unit);
  };

  option("--steps-per-rev", arguments.steps_per_revolution, "N", "full steps per revolution, a multiple of 4")
      ->capture_default_str()
      ->group("Motor");
  option("--rotor-inertia", arguments.rotor_inertia, "G_CM2", "inertia of the rotor, g·cm²")
      ->required()
      ->group("Motor");
  option("--holding-torque", arguments.holding_torque, "NM",
         "holding torque with both phases at the rated current, N·m")
      ->group("Motor");
  option("--current", arguments.current, "A", "rated current of a phase, A")->group("Motor");
  option("--resistance", arguments.resistance, "OHM", "resistance of a phase, ohm")->group("Motor");
  option("--inductance", arguments.inductance, "MH", "inductance of a phase, mH")->group("Motor");
  option("--data", arguments.data, "KIND",
         "connection of these four values: bipolar (whole coils) or unipolar (half coils, from the centre tap; "
         "default: as --drive)")
      ->check(CLI::IsMember({"bipolar", "unipolar"}))
      ->group("Motor");

  option("--supply", arguments.supply, "V", "supply voltage, V")->group("Drive");
  option("--drive", arguments.drive, "KIND", "type of driver: bipolar or unipolar")
      ->check(CLI::IsMember({"bipolar", "unipolar"}))
      ->capture_default_str()
      ->group("Drive");
  option("--regulation", arguments.regulation, "KIND",
         "current regulation: chopper (keeps the rated current) or resistive (a series resistor limits the current)")
      ->check(CLI::IsMember({"chopper", "resistive"}))
      ->capture_default_str()
      ->group("Drive");

  option("--curve", arguments.pull_out, "HZ:NM,...",
         "measured pull-out torque, instead of motor and drive data: rate:torque,rate:torque,...")
      ->delimiter(',')
      ->group("Measured curves");
  option("--pull-in", arguments.pull_in, "HZ:NM,...",
         "measured pull-in torque of the rotor without load (default: computed)")
      ->delimiter(',')
      ->group("Measured curves");

  option("--load-inertia", arguments.load_inertia, "G_CM2", "inertia of the load at the motor's shaft, g·cm²")
      ->group("Load");
  option("--friction", arguments.friction, "NM", "friction at any speed, N·m")->group("Load");
  option("--viscous-friction", arguments.friction_per_speed, "NMS",
         "additional friction proportional to the speed, N·m·s/rad")
      ->group("Load");
  option("--margin", arguments.margin, "0...1", "fraction of the excess torque that may be used to accelerate")
      ->capture_default_str()
      ->group("Load");

  option("--trial", arguments.trial, "KIND",
         "simulate the motor: torque (pull-out and pull-in over the rate), step (step response), stop (steps at a "
         "constant rate, without a ramp), resonance (lag over the rate)")
      ->check(CLI::IsMember({"torque", "step", "stop", "resonance"}))
      ->group("Trials");
  option("--excitation", arguments.excitation, "KIND", "drive mode: two-on, wave, half-step or microsteps:N")
      ->capture_default_str()
      ->group("Trials");
  option("--detent", arguments.detent, "NM", "detent torque (without current), N·m")->group("Trials");
  option("--damping", arguments.damping, "0...1", "damping ratio of the rotor; 1 is critical")
      ->capture_default_str()
      ->group("Trials");
  option("--rate", arguments.trial_rate, "HZ", "step rate of the trials step and stop, full steps/s")
      ->capture_default_str()
      ->group("Trials");
  option("--steps", arguments.trial_steps, "N", "number of steps of the trial stop")
      ->capture_default_str()
      ->group("Trials");
  option("--after", arguments.trial_after, "S", "time that step and stop simulate after the last step, s")
      ->capture_default_str()
      ->group("Trials");

  option("--max-rate", arguments.max_rate, "HZ", "highest rate of table and picture, full steps/s")->group("Output");
  option("--rows", arguments.rows, "N", "number of table rows")->capture_default_str()->group("Output");
  option("-p,--picture", arguments.pictures, "FILE",
         "picture of the curves, instead of the table (FILE.svg or FILE.png)")
      ->group("Output");
  command.add_flag("--json", arguments.json, "print a summary as JSON, instead of the table")->group("Output");
}

void add_loop_options(CLI::App& command, LoopArguments& arguments) {
  command
      .add_option("--of", arguments.of, "controlled quantity: speed, or position (an outer loop around the speed loop)")
      ->check(CLI::IsMember({"speed", "position"}))
      ->capture_default_str();
  command
      .add_option("--to", arguments.to,
                  "size of the step: rad/s for speed (default: 30), degrees for position (default: 90)")
      ->check(number_range(-1e5, 1e5));
  command
      .add_option("--rule", arguments.rule,
                  "Ziegler-Nichols rule: p, pi or pid, from the gain at which the loop oscillates")
      ->check(CLI::IsMember({"p", "pi", "pid"}))
      ->capture_default_str();
  command.add_option("--gains", arguments.gains, "KP,KI,KD: gains, instead of those of the rule")
      ->delimiter(',')
      ->expected(3)
      ->check(number_range(0.0, 1e9));
  command
      .add_option("--speed-gains", arguments.speed_gains,
                  "KP,KI,KD of the inner loop (default: PI by the Ziegler-Nichols rule)")
      ->delimiter(',')
      ->expected(3)
      ->check(number_range(0.0, 1e9));
  command.add_flag("--compare", arguments.compare,
                   "compare P, PI and PID by the Ziegler-Nichols rule, and the --gains");
  command.add_option("--load", arguments.load, "NM@S: load torque from a time on");
  command.add_option("--time", arguments.time, "simulated time, s")
      ->check(number_range(0.001, 100.0))
      ->capture_default_str();
  command.add_option("--period", arguments.period_us, "control period, \u00B5s")
      ->check(number_range(10.0, 1e5))
      ->capture_default_str();
  command.add_option("--smoothing", arguments.smoothing_us, "time constant of the speed filter, \u00B5s")
      ->check(number_range(0.0, 1e6))
      ->capture_default_str();
  command.add_option("--counts", arguments.counts, "encoder counts per revolution")
      ->check(CLI::Range(4, 10'000'000))
      ->capture_default_str();
  command.add_option("-m,--machine", arguments.machine,
                     "machine file with the motor, together with --axis (default: a small motor)");
  command.add_option("--axis", arguments.axis, "letter of the motor's axis");
  command.add_option("-p,--picture", arguments.picture, "picture of the response (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "file for the table");
  command.add_flag("--json", arguments.json, "print gains and results as JSON, instead of the table");
  command.footer(
      R"(Prints a line for each period as CSV: the time, the setpoint, the measured and the true value, and the torques
requested and delivered. The small motor: 0.45 N·m, 1.7 A, 24 V, and a load with the rotor's inertia.

Examples:
  passo loop --rule p --json                                          P alone leaves an error
  passo loop --rule pi --load 0.1@0.05 --picture speed.svg            the integral restores the speed
  passo loop --compare --picture rules.svg                            P, PI and PID by the rule
  passo loop --of position --gains 60,0,0 --picture place.svg         nested loops, manual gains
  passo loop --of position --period 1000 --counts 400 --rule p -o place.csv

The chapter: docs/ramps/loop.md.)");
}

void add_windings_options(CLI::App& command, WindingsArguments& arguments) {
  command.add_option("--drive", arguments.drive, "drive mode: two-on, wave, half-step or microsteps:N (2 to 256)")
      ->required();
  command.add_option("--full-steps", arguments.full_steps, "full steps per revolution of the motors")
      ->check(CLI::Range(4, 100'000))
      ->capture_default_str();
  InterpolateArguments& line = arguments.line;
  line.method = "bresenham";
  command.add_option("--to", line.to, "end of a line or an arc in driver steps, X,Y[,Z...]")->group("Line, arc");
  command.add_option("--from", line.from, "start of the move (default: 0)")->group("Line, arc");
  command.add_option("--center", line.center, "X,Y: centre of an arc")->group("Line, arc");
  command.add_flag("--cw", line.clockwise, "clockwise arc (default: counterclockwise)")->group("Line, arc");
  command.add_option("--method", line.method, "interpolation method, see passo interpolate")
      ->capture_default_str()
      ->group("Line, arc");
  command.add_option("--time", line.time, "time of the whole move at constant speed, s")->group("Line, arc");
  command.add_option("--feed", line.feed, "feed rate, mm/min, instead of --time")->group("Line, arc");
  command.add_option("--steps-per-mm", line.steps_per_mm, "scale for --feed")
      ->capture_default_str()
      ->group("Line, arc");
  RampArguments& ramp = arguments.ramp;
  ramp.method = "exact";
  command.add_option("--move", ramp.move, "move of one motor, N driver steps")->group("One motor");
  command.add_option("--clock", ramp.clock, "timer frequency, Hz")->group("One motor");
  command.add_option("--accel", ramp.acceleration, "rad/s\u00B2")->group("One motor");
  command.add_option("--max-rate", ramp.max_rate, "target step rate, steps/s")->group("One motor");
  command.add_option("--start-rate", ramp.start_rate, "start-stop rate, steps/s")->group("One motor");
  command.add_option("--reverse-after", ramp.reverse_after, "reverse after N steps")->group("One motor");
  constexpr const char* stage = "Currents that rise";
  command.add_option("--current", arguments.current, "rated current of a winding, A")->group(stage);
  command.add_option("--resistance", arguments.resistance, "resistance of a winding, ohm")->group(stage);
  command.add_option("--inductance", arguments.inductance, "inductance of a winding, mH")->group(stage);
  command.add_option("--supply", arguments.supply, "supply voltage, V")->group(stage);
  command.add_option("--series", arguments.series, "resistor in series with the winding, ohm (default: none)")
      ->group(stage);
  command.add_option("--drop", arguments.drop, "voltage drop at the transistor, V (default: 0)")->group(stage);
  command.add_flag("--chopper", arguments.chopper, "hold the rated current by a chopper")->group(stage);
  command.add_option("-m,--machine", arguments.machine, "machine file with the motor, together with --axis")
      ->group(stage);
  command.add_option("--axis", arguments.axis, "letter of the motor's axis")->group(stage);
  command.add_option("-t,--trace", arguments.traces,
                     "file for windings, currents and rotor angles (FILE.vcd or FILE.csv)");
  command.add_option("-p,--picture", arguments.picture,
                     "picture of windings, currents and rotor angles (FILE.svg or FILE.png)");
  command.footer(
      R"(Prints a line for each pulse as CSV: the time, then for each motor its position, F1 to F4, the currents of phases A and B
as fractions of the rated current, and the angle of an unloaded rotor in degrees. Line 1 is the start. With a motor and its
supply the currents rise by U/R (1 - exp(-t R/L)), and there are further lines between the pulses while they do.

Examples:
  passo windings --drive two-on --to 10,4 --time 0.1
  passo windings --drive half-step --to 10,4,7 --time 0.1 --trace windings.vcd     for GTKWave
  passo windings --drive microsteps:16 --from 40,0 --to 0,40 --center 0,0 --time 0.5 --picture windings.svg
  passo windings --drive wave --move 40 --clock 250000 --accel 50 --reverse-after 12 --picture turn.svg
  passo windings --drive two-on --to 10,4 --time 0.02 --current 1 --resistance 12.8 --inductance 10 --supply 13.8 --drop 1
  passo windings --drive two-on --to 10,4 --time 0.02 --current 1 --resistance 12.8 --inductance 10 --supply 36 --chopper)");
}

std::span<const Command> follower_commands() {
  static constexpr std::array<Command, 1> commands{
      {{"sim", "run a follower's firmware on an emulated chip",
        options_of<FollowerArguments, add_follower_options, follower_sim>}}};
  return commands;
}

}  // namespace passo
