// The commands of `passo`, one function each. The options of the command line fill in the arguments. Each command
// returns an exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stock_options.hpp"
#include "tool_life.hpp"

namespace passo {

// The exit codes. Scripts may rely on them.
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,       // another failure: a file that cannot be written, an interruption by a fault
  exit_bad_program = 2,  // the user's program or command line is invalid
  exit_bad_machine = 3,  // the machine file is invalid
  exit_not_resumed = 4,  // an interrupted job cannot be resumed
  exit_interrupted = 130,
};

struct ProgramArguments {
  std::string program;                    // "-": standard input
  bool block_delete = false;              // skips lines that start with '/'
  bool inches = false;                    // lengths are inches until the program says G20 or G21
  bool user_codes = false;                // M100 to M199 are allowed
  std::uint64_t loop_limit = 1'000'000;   // maximum number of passes of a loop, and of calls, in which the machine does
                                          // nothing
  std::uint64_t step_limit = 20'000'000;  // maximum number of passes, calls and operations of an outermost loop or call
  std::string tools;                      // tool table; empty: none
  std::string parameters;                 // parameter file; empty: none
  std::string settings;                   // ini file; empty: none
  std::vector<std::string> sub_folders;
  std::string machine_units;  // "mm" or "inch"; empty: from the settings, otherwise `default_units`
  const char* default_units = "mm";
  // Whether the settings may name the tool table and the parameter file, too. `canon` prints what rs274 prints, and
  // rs274 ignores these two settings.
  bool files_of_settings = true;
  bool parameters_may_lack = false;  // the parameter file may be missing, because the run writes it at the end
  std::string dialect = "linuxcnc";  // or "grbl"
  ToolLifeArguments tool_life;       // of `run` and `check`
};

struct SimulatedMotors {
  bool physics = false;                   // simulates the physics of the motors
  std::vector<std::string> disturbances;  // AXIS:NM@FROM:SECONDS; only with physics
  std::string true_path;                  // sim:first_board: output file of the rotors' way; empty: none
  bool anyway = false;                    // sim:first_board: runs even if its loop is too slow for the pulses
};

// Changes while the program runs.
struct ChangeArguments {
  std::vector<std::string> holds;      // SECONDS, or SECONDS:SECONDS with a duration
  std::vector<std::string> overrides;  // PERCENT@SECONDS
  std::string adaptive_feed;           // file of factors for M52; empty: the factor is 1
};

struct StartLine {
  std::uint32_t line = 0;  // 0: the first one
  std::uint32_t pass = 0;  // which pass through that line; 0: it is reached only once
  double after = 0;        // mm along the path from that line
};

struct RunArguments {
  ProgramArguments program;
  std::string machine;
  std::vector<std::string> pictures;  // .svg or .png
  std::string colour_by = "speed";    // colouring of feed moves in pictures: speed, depth or tool
  std::string view = "auto";          // the flat view of pictures: auto, top, front, side or lathe
  bool no_rapids = false;             // omits the rapids in pictures
  std::vector<std::string> traces;    // .vcd or .csv
  std::string log;                    // output file of (LOG,…); empty: none
  std::string report;                 // a name that ends in .json; with any other name, a text report
  std::uint64_t passes = 1;           // number of runs of a main program that ends with M99
  ChangeArguments changes;
  std::vector<std::string> touches;  // ranges LOW:HIGH of axes: "X10:60,Z:-2"
  std::string cable_cut;             // SECONDS:SECONDS; empty: none
  SimulatedMotors motors;            // of a virtual or emulated machine
  std::string board = "virtual";     // an address for parse_board_address(), or sim:first_board
  std::string journal;               // empty: usual_journal()
  bool resume = false;               // resumes an interrupted run
  StartLine start;                   // where the program is to start
  std::optional<double> ahead;       // motion that may lie in a Grbl board, s
  bool home = false;                 // homes the machine first; the program then starts from the position after
                                     // homing
  bool from_here = false;            // treats the current position as machine zero, whatever was known before
  bool yes = false;                  // continues at M0, M1 and M6 without asking
  bool json = false;                 // prints the summary as JSON
  bool quiet = false;
};
int run(const RunArguments& arguments);

struct JogArguments {
  std::string machine;
  std::string board = "virtual";   // an address for parse_board_address()
  std::vector<std::string> moves;  // "X+10", or "X+" up to the end of the travel; empty: jogs by keys
  double feed = 600;               // mm/min along the path
  double lease = 0.2;              // keep-alive timeout, s
  std::optional<double> held;      // s for which the keep-alive is renewed; empty: until the jog ends
  bool json = false;
};
int jog(const JogArguments& arguments);

struct HomeArguments {
  std::string axis;  // its letter; empty: all axes
  std::string machine;
  std::string board = "virtual";  // an address for parse_board_address()
  int repeat = 1;                 // number of repetitions; from 2 on, reports the repeatability of the positions
  bool json = false;
  bool quiet = false;
};
int home(const HomeArguments& arguments);

struct CheckArguments {
  ProgramArguments program;
  std::string machine;
  std::string board;      // "grbl", or an address of a Grbl board, which plans the motion by itself; empty: our planner
  bool motion = false;    // plans the path, too, and measures the motion
  std::string picture;    // picture of the motion; empty: none
  std::string colour_by;  // "margin": the picture shows the path, coloured by the torque margin; empty: the motion
  std::string report;     // .html; empty: none
  std::string loads;      // .csv: torque utilisation of each line; empty: none
  StockArguments stock;   // stock, tools and clamps
  std::optional<double> cutting_force;  // N/mm², specific cutting force of the material; empty: no stock is cut
  std::optional<double> spindle_speed;  // rpm of a spindle that the program does not command
  bool json = false;
};
int check(const CheckArguments& arguments);

struct TuneArguments;  // passo/operations/study_arguments.hpp
int tune(const TuneArguments& arguments);

struct CanonArguments {
  ProgramArguments program;
  std::string output;  // empty: standard output
};
int canon(const CanonArguments& arguments);

struct ExplainArguments {
  ProgramArguments program;  // its member `program` is FILE, FILE:LINE or FILE:FROM-TO
  std::string machine;       // machine file; empty: none
  bool json = false;
};
int explain(const ExplainArguments& arguments);

struct MachineArguments {
  std::string machine;  // empty: with `from`
  std::string from;     // the configuration file of another controller, or the address of a Grbl board; empty: none
  std::string format;   // of that file; empty: from its content
  std::string output;   // the new machine file; empty: standard output
  bool json = false;
};
int machine(const MachineArguments& arguments);

struct BoardListArguments {
  std::vector<std::string> devices;  // these are opened and asked; empty: all serial ports of this computer
  bool ask = false;                  // opens all ports that are not in use, too
  double wait = 2.5;                 // seconds to wait for an answer on each port
  bool json = false;
  std::string system;  // a folder with system files in place of this computer's; empty: this computer's
};
int board_list(const BoardListArguments& arguments);

struct BoardInfoArguments {
  std::string board;  // an address for parse_board_address()
  double wait = 5;
  bool json = false;
};
int board_info(const BoardInfoArguments& arguments);

struct BoardMonitorArguments {
  std::string board;
  double every = 0.2;       // seconds between two output lines
  std::uint64_t count = 0;  // number of output lines; 0: until Ctrl-C
  bool json = false;        // prints each line as a JSON object
};
int board_monitor(const BoardMonitorArguments& arguments);

struct BoardSettingsArguments {
  std::string board;               // an address "grbl:…"
  std::vector<std::string> names;  // only these settings, with their meaning; empty: all
  std::vector<std::string> set;    // NAME=VALUE
  std::string save;                // a file for all settings
  std::string compare;             // a file of settings
  std::string restore;             // a file of settings, of which those that differ are written
  bool config = false;             // shows FluidNC's YAML
  std::string write_config;        // a file with FluidNC's YAML, which replaces the board's
  bool json = false;
};
int board_settings(const BoardSettingsArguments& arguments);

struct BoardFilesArguments {
  std::string board;   // an address "grbl:…"
  std::string run;     // the path of a file on the board
  std::string upload;  // a file of this computer
  std::string as;      // the path on the board; empty: the same name on its card
  std::string remove;  // the path of a file on the board
  bool json = false;
};
int board_files(const BoardFilesArguments& arguments);

struct BoardFlashArguments {
  std::string board;   // uno, mega, or one of their variants with windings; pico
  std::string device;  // the serial port; a Pico's drive, or empty: found automatically
  std::string image;   // empty: the image built with this program
  std::string backup;  // backup file of the old contents; empty: passo-backup-BOARD.hex
  std::string programmer;
  unsigned baud = 115'200;
  bool dry_run = false;
};
int board_flash(const BoardFlashArguments& arguments);

struct BoardServeArguments {
  std::optional<unsigned> motors;  // empty: the number of axes, but at least four
  std::optional<double> clock;     // ticks/s; empty: from the machine file, or 16 MHz
  unsigned port = 7070;
  std::string machine;  // a machine file: the board is that machine's, at machine zero; empty: no switches
  bool once = false;    // whether it ends when all clients have disconnected
};
int board_serve(const BoardServeArguments& arguments);

struct ServeArguments {
  std::string machine;  // empty: the example machine
  std::string board = "virtual";
  std::string grbl_tcp;                 // HOST:PORT; if no interface is given: 127.0.0.1:7071
  std::string grbl_pty;                 // path of the symbolic link to the pseudo-terminal
  std::string grbl_serial;              // a serial port for senders: DEVICE or DEVICE@BAUD
  bool anybody_may_drive = false;       // allows access from other computers
  std::string http;                     // HOST:PORT for programs and browsers; empty: none
  std::string http_token;               // file with the access token
  std::vector<std::string> http_names;  // other names of this server, in addition to HOST
  std::string page;                     // folder with the web interface
  struct Mqtt {
    std::string broker;           // HOST or HOST:PORT, to which the status is published; empty: none
    std::string topic = "passo";  // prefix of all topics
    std::string login;            // file with USER:PASSWORD for the broker; empty: no login
  };
  Mqtt mqtt;
  bool check = false;                // only checks whether these options can be served
  std::string data;                  // folder for jobs and history; empty: nothing is kept
  std::string tool_library;          // TOML; empty: the tools have no limits
  std::string macros;                // folder with macros and subroutines; empty: none
  std::string pendant;               // auto, hidraw:DEVICE or a table; empty: none
  std::vector<std::string> touches;  // objects that the virtual machine's probe can touch, as for `run`
  std::string system;                // a folder with system files, as for `board list`
  std::optional<double> ahead;       // motion that may lie in a Grbl board, s
  double virtual_speed = 1;          // time of the simulated machine, as a multiple of real time
};
int serve(const ServeArguments& arguments);

struct InterpolateArguments {
  std::string method;  // a name of method_names(); empty: lean, for an arc midpoint; empty with `compare`
  std::string to;      // "10,4", in steps, or several points "10,4 27,10"; empty: the dialogue asks for it
  std::string from;    // empty: zero
  std::string center;  // the centre of an arc; empty: a line
  bool clockwise = false;
  bool half_loaded = false;  // half-full accumulators, for DDA
  int register_bits = 0;     // for DDA; 0: the minimum number of bits for the move
  std::string end;           // for point comparison: coordinates, projection or total
  bool compare = false;
  bool beats = false;          // prints the four phases of each pulse as columns
  std::optional<double> time;  // seconds for the whole move; prints each pulse with its duration
  std::optional<double> feed;  // mm/min, instead of the time
  std::string rule;            // how durations are computed: roots, exact or beats; empty: roots
  bool step_times = false;     // prints a line for each point: its time, N1, N2 and the time of a step
  std::string picture;         // .svg or .png
  std::string output;          // empty: standard output
  bool json = false;
  double steps_per_mm = 100;
};
int interpolate(const InterpolateArguments& arguments);

// Values are in the units of data sheets, like the command's options.
struct MotorArguments {
  std::vector<std::string> pull_out;  // each "rate:torque"
  std::vector<std::string> pull_in;
  int steps_per_revolution = 200;
  double rotor_inertia = 0;              // g·cm²
  std::optional<double> holding_torque;  // N·m
  std::optional<double> current;         // A
  std::optional<double> resistance;      // ohm
  std::optional<double> inductance;      // mH
  std::optional<double> supply;          // V
  std::string drive = "bipolar";         // or unipolar
  std::string data;                      // bipolar or unipolar: the connection to which the values apply; empty: the
                                         // same as `drive`
  std::string regulation = "chopper";    // or resistive
  double load_inertia = 0;               // g·cm²
  double friction = 0;                   // N·m
  double friction_per_speed = 0;         // N·m·s/rad
  double margin = 1;
  std::string trial;                        // torque, step, stop or resonance; empty: no trial
  std::string excitation = "microsteps:8";  // in the format of Excitation::named()
  double detent = 0;                        // N·m
  double damping = 0.002;                   // damping as a fraction of the rotor's critical damping
  double trial_rate = 500;                  // full steps/s
  int trial_steps = 200;                    // driver steps before a stop without a ramp
  double trial_after = 0.1;                 // duration of the trial after the last step, s
  std::optional<double> max_rate;           // full steps/s, end of tables and pictures
  int rows = 101;
  std::vector<std::string> pictures;  // .svg or .png
  bool json = false;
};
int motor(const MotorArguments& arguments);

struct LoopArguments {
  std::string of = "speed";         // or position
  std::string machine;              // empty: a built-in small motor
  std::string axis;                 // an axis of the machine
  std::optional<double> to;         // rad/s, or degrees
  std::string rule = "pi";          // p, pi or pid, by Ziegler and Nichols
  std::vector<double> gains;        // kp, ki, kd, instead of the rule
  std::vector<double> speed_gains;  // gains of the inner speed loop of position control; empty: PI by the rule
  bool compare = false;             // compares all rules
  double time = 0.1;                // s
  double period_us = 100;
  double smoothing_us = 500;  // smoothing of the speed computed from the encoder
  int counts = 4000;          // encoder counts per revolution
  std::string load;           // load step, NM@S; empty: none
  std::string picture;        // .svg or .png
  std::string output;         // CSV; empty: standard output
  bool json = false;
};
int loop(const LoopArguments& arguments);

struct RampArguments {
  std::string method;                  // exact, recursive, table, midpoint
  std::optional<double> clock;         // Hz
  std::optional<double> acceleration;  // rad/s²
  std::optional<double> max_rate;      // steps/s
  std::optional<double> start_rate;    // steps/s
  std::optional<double> jerk;          // rad/s³
  std::optional<std::int32_t> steps_per_turn;
  std::optional<std::int32_t> table_size;
  std::optional<std::int64_t> steps;
  std::optional<std::int64_t> move;
  std::optional<std::int64_t> stop_after;
  std::optional<std::int64_t> reverse_after;
  std::optional<std::int32_t> print_table;  // number of entries
  std::string format;                       // format of the table: c, asm or csv; empty: c
  bool whole_ticks = false;
  bool limit = false;
  bool json = false;
  std::string picture;
  std::string output;  // empty: standard output
};
int ramp(const RampArguments& arguments);

struct WindingsArguments {
  std::string drive;                 // a name of Excitation::named()
  int full_steps = 200;              // full steps per revolution of the motors
  InterpolateArguments line;         // a line or an arc at constant speed; empty `to`: a ramp
  RampArguments ramp;                // arguments of a move of one motor
  std::string machine;               // a machine file with the motor; empty: the values below, or none
  std::string axis;                  // an axis of the machine
  std::optional<double> current;     // A
  std::optional<double> resistance;  // ohm
  std::optional<double> inductance;  // mH
  std::optional<double> supply;      // V
  std::optional<double> series;      // ohm
  std::optional<double> drop;        // V
  bool chopper = false;
  std::vector<std::string> traces;  // .vcd or .csv
  std::string picture;              // .svg or .png
};
int windings(const WindingsArguments& arguments);

struct FollowerArguments {
  std::string follower;  // a name of emulated_followers()
  std::string image;     // a file; empty: the image from the build
  double clock = 0;      // pulses/s; 0: none
  std::string axes = "X";
  std::string down;                  // axes whose direction signal is high
  std::string input;                 // a recording of the lines, .vcd or .csv; empty: none
  std::vector<std::string> signals;  // LINE=NAME: names in the recording
  double pulse = 0;                  // µs: the recording's pulses are at least this long
  double from = 0.2;                 // s: time of the first pulse, or of the start of the recording
  std::optional<double> time;        // s; empty: 1, or to the end of the recording
  std::vector<std::string> keys;     // KEY@FROM[:TO]
  std::vector<std::string> lines;    // LINE@FROM[:TO]
  std::vector<std::string> traces;   // .vcd or .csv
  std::string picture;               // .svg or .png
};
int follower_sim(const FollowerArguments& arguments);

struct ChordsArguments {
  std::string curve;   // line, arc, helix, ellipse, parabola, bezier or nurbs
  std::string from;    // "X,Y" or "X,Y,Z" in mm, like all positions
  std::string to;      // without Z, it has the Z of `from`
  std::string center;  // arc, helix, ellipse
  bool clockwise = false;
  int turns = 1;       // arc, helix: number of turns; the last turn may be partial
  std::string radii;   // ellipse: "A,B" in mm
  double rotate = 0;   // ellipse: degrees
  std::string angles;  // ellipse: "FROM,TO" in degrees; empty: the whole ellipse
  std::string vertex;  // parabola
  std::string focus;
  std::vector<std::string> control;  // bezier: the control points between the ends; nurbs: all control points
  int degree = 3;                    // nurbs
  std::vector<double> weights;
  std::vector<double> knots;
  double tolerance = 0.01;       // mm
  std::optional<double> period;  // s: chords of the length feed · period instead of a tolerance
  std::optional<double> feed;    // mm/min, with the period
  std::string steps_per_mm;      // "N" or "X,Y,Z"; empty: no steps
  std::string fine;              // the line method that generates the steps along the chords; empty: none
  std::string picture;           // .svg or .png
  std::string output;            // empty: standard output
};
int chords(const ChordsArguments& arguments);

}  // namespace passo
