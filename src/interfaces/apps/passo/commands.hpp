// The commands of `passo`, one function each. The options of the command line fill in the arguments.
// Each command returns an exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stock_options.hpp"

namespace passo {

// The exit codes. Scripts may rely on them.
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,       // another failure: a file that cannot be written, an interruption by a fault
  exit_bad_program = 2,  // the user's program or command line is wrong
  exit_bad_machine = 3,  // the machine's file is wrong
  exit_not_resumed = 4,  // a job that was broken off cannot go on
  exit_interrupted = 130,
};

struct ProgramArguments {
  std::string program;                    // "-": standard input
  bool block_delete = false;              // skip lines that start with '/'
  bool inches = false;                    // lengths are inches until the program says G20 or G21
  bool user_codes = false;                // M100 to M199 are allowed
  std::uint64_t loop_limit = 1'000'000;   // most passes of a loop, and most calls, in which the machine does nothing
  std::uint64_t step_limit = 20'000'000;  // most passes, calls and operations of an outermost loop or call
  std::string tools;                      // tool table; empty: none
  std::string parameters;                 // parameter file; empty: none
  std::string settings;                   // ini file; empty: none
  std::vector<std::string> sub_folders;
  std::string machine_units;  // "mm" or "inch"; empty: as the settings say, else `default_units`
  const char* default_units = "mm";
  // True: the settings may name the tool table and the parameter file too. `canon` prints what rs274 prints, and rs274
  // ignores these two names.
  bool files_of_settings = true;
  bool parameters_may_lack = false;  // the parameter file need not exist, because the run writes it at the end
  std::string dialect = "linuxcnc";  // or "grbl"
};

struct RunArguments {
  ProgramArguments program;
  std::string machine;
  std::vector<std::string> pictures;      // .svg or .png
  std::string colour_by = "speed";        // of the feeds in pictures: speed, depth or tool
  std::string view = "auto";              // the flat view of pictures: auto, top, front, side or lathe
  bool no_rapids = false;                 // in pictures
  std::vector<std::string> traces;        // .vcd or .csv
  std::string log;                        // what (LOG,…) writes; empty: none
  std::string report;                     // a name that ends in .json, or any other name for text
  std::uint64_t passes = 1;               // how often a main program that ends with M99 is run
  std::vector<std::string> holds;         // SECONDS or SECONDS:SECONDS
  std::vector<std::string> overrides;     // PERCENT@SECONDS
  std::vector<std::string> touches;       // ranges LOW:HIGH of axes: "X10:60,Z:-2"
  std::string cable_cut;                  // SECONDS:SECONDS; empty: none
  std::vector<std::string> disturbances;  // AXIS:NM@FROM:SECONDS; only with physics
  bool physics = false;                   // the motors of a virtual or emulated machine obey physics
  std::string board = "virtual";          // an address for parse_board_address()
  std::string journal;                    // empty: usual_journal()
  bool resume = false;                    // goes on where another run was interrupted
  std::uint32_t from_line = 0;            // the line where the program is to begin; 0: its first
  std::uint32_t pass = 0;                 // which time that the path comes to that line; 0: it comes once
  double after = 0;                       // mm along the path from there
  bool home = false;                      // homes the machine first; the program then begins where homing ends
  bool from_here = false;                 // the machine stands at machine zero, whatever was known
  bool yes = false;                       // goes on at M0, M1 and M6 without asking
  bool json = false;                      // prints the summary as JSON
  bool quiet = false;
};
int run(const RunArguments& arguments);

struct JogArguments {
  std::string machine;
  std::string board = "virtual";   // an address for parse_board_address()
  std::vector<std::string> moves;  // "X+10", or "X+" to the end of the travel; empty: keys jog
  double feed = 600;               // mm a minute along the way
  double lease = 0.2;              // s
  std::optional<double> held;      // s for which the lease is renewed; empty: until the jog ends
  bool json = false;
};
int jog(const JogArguments& arguments);

struct HomeArguments {
  std::string machine;
  std::string board = "virtual";  // an address for parse_board_address()
  int repeat = 1;                 // how many times; from 2 on, how well the places agree is reported
  bool json = false;
  bool quiet = false;
};
int home(const HomeArguments& arguments);

struct CheckArguments {
  ProgramArguments program;
  std::string machine;
  bool motion = false;    // plans the path too, and measures the motion
  std::string picture;    // of the motion; empty: none
  std::string colour_by;  // "margin": the picture shows the path, coloured by the motors' margin; empty: the motion
  std::string report;     // .html; empty: none
  std::string loads;      // .csv: what each line needs of the motors; empty: none
  StockArguments stock;   // what is cut, with what
  std::optional<double> cutting_force;  // N/mm², of the material; empty: no stock is cut
  std::optional<double> spindle_speed;  // revolutions a minute, of a spindle that the program does not command
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
  bool json = false;
};
int explain(const ExplainArguments& arguments);

struct MachineArguments {
  std::string machine;
};
int machine(const MachineArguments& arguments);

struct BoardListArguments {
  std::vector<std::string> devices;  // empty: all serial lines of this computer
  double wait = 2.5;                 // seconds to wait for an answer on each line
  bool json = false;
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
  double every = 0.2;       // seconds between two lines
  std::uint64_t count = 0;  // number of lines; 0: until Ctrl-C
  bool json = false;        // each line is a JSON object
};
int board_monitor(const BoardMonitorArguments& arguments);

struct BoardFlashArguments {
  std::string board;   // uno, mega, or one of their ways with windings; pico
  std::string device;  // the serial line; a Pico's drive, or empty: it is found
  std::string image;   // empty: the image that was built with this program
  std::string backup;  // file for the old contents; empty: passo-backup-BOARD.hex
  std::string programmer;
  unsigned baud = 115'200;
  bool dry_run = false;
};
int board_flash(const BoardFlashArguments& arguments);

struct BoardServeArguments {
  std::optional<unsigned> motors;  // empty: as many as the machine has axes, and four at least
  std::optional<double> clock;     // ticks a second; empty: that of the machine file, or 16 MHz
  unsigned port = 7070;
  std::string machine;  // a machine file: the board is that machine's, and stands at machine zero; empty: no switches
  bool once = false;    // ends when everybody has left
};
int board_serve(const BoardServeArguments& arguments);

struct ServeArguments {
  std::string machine;  // empty: the example machine
  std::string board = "virtual";
  std::string grbl_tcp;                 // HOST:PORT; with no line at all: 127.0.0.1:7071
  std::string grbl_pty;                 // where the link to the pseudo-terminal is to be
  std::string grbl_serial;              // a serial port for senders: DEVICE or DEVICE@BAUD
  bool anybody_may_drive = false;       // the port may be reached from other computers
  std::string http;                     // HOST:PORT for programs and browsers; empty: none
  std::string http_token;               // file with the token that they need
  std::vector<std::string> http_names;  // by which others know this server, beside HOST
  std::string page;                     // folder with a page for browsers
  std::string mqtt;                     // HOST or HOST:PORT of a broker that is told the status; empty: none
  std::string mqtt_topic = "passo";     // all topics begin with it
  std::string mqtt_login;               // file with USER:PASSWORD for the broker; empty: nobody logs in
  bool check = false;                   // only say whether this can be served
  std::string data;                     // folder for jobs and history; empty: nothing is kept
  std::vector<std::string> touches;     // what the virtual machine's probe can touch, as of `run`
};
int serve(const ServeArguments& arguments);

struct InterpolateArguments {
  std::string method;  // a name of method_names(); empty with `compare`
  std::string to;      // "10,4", in steps
  std::string from;    // empty: zero
  std::string center;  // the centre of an arc; empty: a line
  bool clockwise = false;
  bool half_loaded = false;  // for DDA
  int register_bits = 0;     // for DDA; 0: as few bits as can hold the move
  std::string end;           // for point comparison: coordinates, projection or total
  bool compare = false;
  bool beats = false;          // the four beats of each pulse as columns
  std::optional<double> time;  // seconds for the whole move: each pulse with its duration
  std::optional<double> feed;  // mm a minute, instead of the time
  std::string rule;            // of durations: roots, exact or beats; empty: roots
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
  std::string data;                      // bipolar or unipolar: which the values are for; empty: the same as `drive`
  std::string regulation = "chopper";    // or resistive
  double load_inertia = 0;               // g·cm²
  double friction = 0;                   // N·m
  double friction_per_speed = 0;         // N·m·s/rad
  double margin = 1;
  std::string trial;                        // torque, step, stop or resonance; empty: no trial
  std::string excitation = "microsteps:8";  // as Excitation::named() has it
  double detent = 0;                        // N·m
  double damping = 0.002;                   // share of the rotor's critical damping
  double trial_rate = 500;                  // full steps/s
  int trial_steps = 200;                    // of the driver, before a stop without a ramp
  double trial_after = 0.1;                 // s after the last step
  std::optional<double> max_rate;           // full steps/s at which tables and pictures end
  int rows = 101;
  std::vector<std::string> pictures;  // .svg or .png
  bool json = false;
};
int motor(const MotorArguments& arguments);

struct LoopArguments {
  std::string of = "speed";         // or position
  std::string machine;              // empty: a small motor
  std::string axis;                 // of the machine
  std::optional<double> to;         // rad/s, or degrees
  std::string rule = "pi";          // p, pi or pid, by Ziegler and Nichols
  std::vector<double> gains;        // kp, ki, kd by hand, instead of the rule
  std::vector<double> speed_gains;  // of the inner loop of a position; empty: PI by the rule
  bool compare = false;             // all rules, side by side
  double time = 0.1;                // s
  double period_us = 100;
  double smoothing_us = 500;  // of the counted speed
  int counts = 4000;          // of the encoder, a turn
  std::string load;           // NM@S; empty: none
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
  std::optional<std::int32_t> print_table;  // entries
  std::string format;                       // of the table: c, asm or csv; empty: c
  bool whole_ticks = false;
  bool limit = false;
  bool json = false;
  std::string picture;
  std::string output;  // empty: standard output
};
int ramp(const RampArguments& arguments);

struct WindingsArguments {
  std::string drive;                // a name of Excitation::named()
  int full_steps = 200;             // of the motors, a revolution
  InterpolateArguments line;        // a line or an arc at an even speed; `to` is empty: a ramp
  RampArguments ramp;               // a move of one motor
  std::vector<std::string> traces;  // .vcd or .csv
  std::string picture;              // .svg or .png
};
int windings(const WindingsArguments& arguments);

struct FollowerArguments {
  std::string follower;  // a name of emulated_followers()
  std::string image;     // a file; empty: the one that the build made
  double clock = 0;      // pulses a second; 0: none
  std::string axes = "X";
  std::string down;                 // axes whose direction line is high
  double from = 0.2;                // s: the first pulse
  double time = 1;                  // s
  std::vector<std::string> keys;    // KEY@FROM[:TO]
  std::vector<std::string> lines;   // LINE@FROM[:TO]
  std::vector<std::string> traces;  // .vcd or .csv
  std::string picture;              // .svg or .png
};
int follower_sim(const FollowerArguments& arguments);

struct ChordsArguments {
  std::string curve;   // line, arc, helix, ellipse, parabola, bezier or nurbs
  std::string from;    // "X,Y" or "X,Y,Z" in mm, like all places
  std::string to;      // without a Z, its Z is that of `from`
  std::string center;  // arc, helix, ellipse
  bool clockwise = false;
  int turns = 1;       // arc, helix: number of turns; the last turn may be partial
  std::string radii;   // ellipse: "A,B" in mm
  double rotate = 0;   // ellipse: degrees
  std::string angles;  // ellipse: "FROM,TO" in degrees; empty: all of it
  std::string vertex;  // parabola
  std::string focus;
  std::vector<std::string> control;  // bezier: the control points between the ends; nurbs: all control points
  int degree = 3;                    // nurbs
  std::vector<double> weights;
  std::vector<double> knots;
  double tolerance = 0.01;       // mm
  std::optional<double> period;  // s: chords of the length feed · period instead of a tolerance
  std::optional<double> feed;    // mm a minute, with the period
  std::string steps_per_mm;      // "N" or "X,Y,Z"; empty: no steps
  std::string fine;              // the line method that steps along the chords; empty: none
  std::string picture;           // .svg or .png
  std::string output;            // empty: standard output
};
int chords(const ChordsArguments& arguments);

}  // namespace passo
