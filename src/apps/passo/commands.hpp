// The commands of `passo`, one function each. command_line.cpp fills in the arguments; each command returns an exit
// code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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
  std::string program;                   // "-": standard input
  bool block_delete = false;             // skip lines that start with '/'
  bool inches = false;                   // until the program says G20 or G21
  bool user_codes = false;               // M100 to M199 are allowed
  std::uint64_t loop_limit = 1'000'000;  // passes of a loop without an operation
  std::string tools;                     // tool table; empty: none
  std::string parameters;                // parameter file; empty: none
  std::string settings;                  // ini file; empty: none
  std::vector<std::string> sub_folders;
  std::string machine_units;  // "mm" or "inch"; empty: as the settings say, else `default_units`
  const char* default_units = "mm";
  // True: the settings may name the tool table and the parameter file too. rs274, whose form `canon` prints, ignores
  // them.
  bool files_of_settings = true;
  bool parameters_may_lack = false;  // the file need not exist: the run writes it at the end
  std::string dialect = "linuxcnc";  // or grbl
};

struct RunArguments {
  ProgramArguments program;
  std::string machine;
  std::vector<std::string> pictures;   // .svg or .png
  std::vector<std::string> traces;     // .vcd or .csv
  std::string report;                  // .json or text
  std::uint64_t passes = 1;            // of a main program that ends with M99
  std::vector<std::string> holds;      // SECONDS or SECONDS:SECONDS
  std::vector<std::string> overrides;  // PERCENT@SECONDS
  std::vector<std::string> touches;    // LOW:HIGH of axes, as X10:60,Z:-2
  std::string cable_cut;               // SECONDS:SECONDS; empty: none
  std::string board = "virtual";       // as parse_board_address() has it
  std::string journal;                 // empty: usual_journal()
  bool resume = false;                 // goes on where another run was interrupted
  bool home = false;                   // homes the machine first; the program begins where homing ends
  bool yes = false;                    // goes on at M0, M1 and M6 without asking
  bool json = false;                   // the summary on standard output as JSON
  bool quiet = false;
};
int run(const RunArguments& arguments);

struct JogArguments {
  std::string machine;
  std::string board = "virtual";   // as parse_board_address() has it
  std::vector<std::string> moves;  // "X+10", or "X+" to the end of the travel; empty: by keys
  double feed = 600;               // mm a minute along the way
  double lease = 0.2;              // s
  std::optional<double> held;      // s for which the lease is renewed; empty: to the end
  bool json = false;
};
int jog(const JogArguments& arguments);

struct HomeArguments {
  std::string machine;
  std::string board = "virtual";  // as parse_board_address() has it
  bool json = false;
  bool quiet = false;
};
int home(const HomeArguments& arguments);

struct CheckArguments {
  ProgramArguments program;
  std::string machine;
  bool motion = false;  // plan it too, and measure the motion
  bool json = false;
};
int check(const CheckArguments& arguments);

struct CanonArguments {
  ProgramArguments program;
  std::string output;  // empty: standard output
};
int canon(const CanonArguments& arguments);

struct ExplainArguments {
  ProgramArguments program;  // its `program`: FILE, FILE:LINE or FILE:FROM-TO
  bool json = false;
};
int explain(const ExplainArguments& arguments);

struct MachineArguments {
  std::string machine;
};
int machine(const MachineArguments& arguments);

struct BoardListArguments {
  std::vector<std::string> devices;  // empty: all serial lines of this computer
  double wait = 2.5;                 // seconds for each
  bool json = false;
};
int board_list(const BoardListArguments& arguments);

struct BoardInfoArguments {
  std::string board;  // as parse_board_address() has it
  double wait = 5;
  bool json = false;
};
int board_info(const BoardInfoArguments& arguments);

struct BoardMonitorArguments {
  std::string board;
  double every = 0.2;       // seconds
  std::uint64_t count = 0;  // 0: until Ctrl-C
  bool json = false;        // an object a line
};
int board_monitor(const BoardMonitorArguments& arguments);

struct BoardFlashArguments {
  std::string board;  // uno or mega
  std::string device;
  std::string image;   // empty: the one that was built with this program
  std::string backup;  // file for the old contents; empty: passo-backup-BOARD.hex
  std::string programmer;
  unsigned baud = 115'200;
  bool dry_run = false;
};
int board_flash(const BoardFlashArguments& arguments);

struct BoardServeArguments {
  std::string name = "virtual";
  unsigned motors = 4;
  double clock = 16e6;
  unsigned port = 7070;
  std::string machine;  // a machine file, whose switches exist, at machine zero; empty: none
  bool once = false;    // one host, then end
};
int board_serve(const BoardServeArguments& arguments);

struct InterpolateArguments {
  std::string method;  // a name of method_names(); empty with `compare`
  std::string to;      // "10,4", in steps
  std::string from;    // empty: zero
  std::string center;  // an arc about it
  bool clockwise = false;
  bool half_loaded = false;  // DDA
  int register_bits = 0;     // DDA; 0: as few as hold the move
  std::string end;           // point comparison: coordinates, projection or total
  bool compare = false;
  std::string picture;  // .svg or .png
  std::string output;   // empty: standard output
  bool json = false;
  double steps_per_mm = 100;
};
int interpolate(const InterpolateArguments& arguments);

// Values are in the units of data sheets, as in the options.
struct MotorArguments {
  std::vector<std::string> pull_out;  // "rate:torque" each
  std::vector<std::string> pull_in;
  int steps_per_revolution = 200;
  double rotor_inertia = 0;              // g·cm²
  std::optional<double> holding_torque;  // N·m
  std::optional<double> current;         // A
  std::optional<double> resistance;      // ohm
  std::optional<double> inductance;      // mH
  std::optional<double> supply;          // V
  std::string drive = "bipolar";         // or unipolar
  std::string data;                      // which of the two the values are for; empty: as the drive
  std::string regulation = "chopper";    // or resistive
  double load_inertia = 0;               // g·cm²
  double friction = 0;                   // N·m
  double friction_per_speed = 0;         // N·m·s/rad
  double margin = 1;
  std::optional<double> max_rate;  // full steps/s at which tables and pictures end
  int rows = 101;
  std::vector<std::string> pictures;  // .svg or .png
  bool json = false;
};
int motor(const MotorArguments& arguments);
struct RampArguments {
  std::string method;                  // exact, recursive, table
  std::optional<double> clock;         // Hz
  std::optional<double> acceleration;  // rad/s²
  std::optional<double> max_rate;      // steps/s, as the next
  std::optional<double> start_rate;
  std::optional<double> jerk;  // rad/s³
  std::optional<std::int32_t> steps_per_turn;
  std::optional<std::int32_t> table_size;
  std::optional<std::int64_t> steps;
  std::optional<std::int64_t> move;
  std::optional<std::int64_t> stop_after;
  bool whole_ticks = false;
  bool limit = false;
  bool json = false;
  std::string picture;
  std::string output;  // empty: standard output
};
int ramp(const RampArguments& arguments);

struct ChordsArguments {
  std::string curve;   // line, arc, helix, ellipse, parabola, bezier or nurbs
  std::string from;    // "X,Y" or "X,Y,Z" in mm, as all places
  std::string to;      // Z as that of `from` unless it says otherwise
  std::string center;  // arc, helix, ellipse
  bool clockwise = false;
  int turns = 1;       // arc, helix: the last turn may be partial
  std::string radii;   // ellipse: "A,B" in mm
  double rotate = 0;   // ellipse: degrees
  std::string angles;  // ellipse: "FROM,TO" in degrees; empty: all of it
  std::string vertex;  // parabola
  std::string focus;
  std::vector<std::string> control;  // bezier: between the ends; nurbs: all
  int degree = 3;                    // nurbs
  std::vector<double> weights;
  std::vector<double> knots;
  double tolerance = 0.01;   // mm
  std::string steps_per_mm;  // "N" or "X,Y,Z"; empty: no steps
  std::string picture;       // .svg or .png
  std::string output;        // empty: standard output
};
int chords(const ChordsArguments& arguments);

}  // namespace passo
