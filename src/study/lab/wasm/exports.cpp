// The lab as a WebAssembly module: the functions that a browser calls. Numbers go in; each function writes one answer
// (passo/lab/answers.hpp), keeps it until the next call, and returns its length in bytes. lab_answer() tells where in
// the linear memory the answer begins.
//
// Methods, drives and kinds are numbers: the order of their lists in the enums beside the functions.
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>

#include "passo/lab/answers.hpp"
#include "passo/lab/board_play.hpp"
#include "passo/motor/running_motor.hpp"

#define PASSO_EXPORT(name) __attribute__((export_name(#name))) name

namespace {

using namespace passo;

std::string& answer() {
  static std::string text;
  return text;
}

std::size_t answered(std::string text) {
  answer() = std::move(text);
  return answer().size();
}

// An arc wants a centre; `sense`: 0 a line, 1 an arc counterclockwise, 2 clockwise.
StepMove move_of(int from_x, int from_y, int to_x, int to_y, int sense, int centre_x, int centre_y) {
  StepMove move{.from = {from_x, from_y}, .to = {to_x, to_y}, .arc = {}};
  if (sense != 0) move.arc = StepMove::Arc{.centre = {centre_x, centre_y}, .clockwise = sense == 2};
  return move;
}

constexpr int last_method = static_cast<int>(MethodName::listing_projection);

// A line of `axes` axes, 2 to 8, from zero.
StepMove line_to(int axes, std::initializer_list<int> ends) {
  StepMove move;
  for (const int end : ends) {
    if (static_cast<int>(move.to.size()) < axes) move.to.push_back(end);
  }
  move.from = Place(move.to.size(), 0);
  return move;
}

// 0 two on, 1 wave, 2 half step; N from 2 microsteps on is 1 + N.
Result<Excitation, std::string> excitation_of(int drive) {
  constexpr const char* names[] = {"two-on", "wave", "half-step"};
  if (drive >= 0 && drive < 3) return Excitation::named(names[drive]);
  return Excitation::named("microsteps:" + std::to_string(drive - 1));
}

// The motor of the questions about torque and loops; each of them is asked after lab_motor().
struct AskedMotor {
  MotorData data;
  MotorDrive drive;
  Load load;
};
AskedMotor& asked_motor() {
  static AskedMotor motor;
  return motor;
}

BoardPlay& board(bool anew = false) {
  static std::optional<BoardPlay> board;
  if (anew || !board) board.emplace();
  return *board;
}

LoopSetup loop_of(int controlled, double to, double period) {
  const AskedMotor& motor = asked_motor();
  LoopSetup setup{.motor = {.motor = motor.data,
                            .drive = motor.drive,
                            .excitation = *Excitation::named("microsteps:64"),
                            .load = motor.load}};
  setup.motor.damping = damping_of(motor.data);
  setup.controlled = controlled == 1 ? Controlled::position : Controlled::speed;
  setup.to = to;
  setup.period = Seconds(period);
  return setup;
}

}  // namespace

extern "C" {

const char* PASSO_EXPORT(lab_answer)() {
  return answer().data();
}

// `method`: MethodName.
std::size_t PASSO_EXPORT(lab_interpolation)(int method, int half_loaded, int from_x, int from_y, int to_x, int to_y,
                                            int sense, int centre_x, int centre_y) {
  if (method < 0 || method > last_method) return answered(error_answer("no such method"));
  const Method chosen{.name = static_cast<MethodName>(method), .half_loaded = half_loaded != 0};
  return answered(interpolation_answer(chosen, move_of(from_x, from_y, to_x, to_y, sense, centre_x, centre_y)));
}

// The same for a line of several axes from zero.
std::size_t PASSO_EXPORT(lab_line)(int method, int half_loaded, int axes, int x, int y, int z, int a, int b, int c,
                                   int u, int v) {
  if (method < 0 || method > last_method) return answered(error_answer("no such method"));
  const Method chosen{.name = static_cast<MethodName>(method), .half_loaded = half_loaded != 0};
  return answered(interpolation_answer(chosen, line_to(axes, {x, y, z, a, b, c, u, v})));
}

std::size_t PASSO_EXPORT(lab_line_comparison)(int axes, int x, int y, int z, int a, int b, int c, int u, int v) {
  return answered(comparison_answer(line_to(axes, {x, y, z, a, b, c, u, v})));
}

std::size_t PASSO_EXPORT(lab_comparison)(int from_x, int from_y, int to_x, int to_y, int sense, int centre_x,
                                         int centre_y) {
  return answered(comparison_answer(move_of(from_x, from_y, to_x, to_y, sense, centre_x, centre_y)));
}

std::size_t PASSO_EXPORT(lab_windings)(int drive, int full_steps_per_turn, int first, int last) {
  const auto excitation = excitation_of(drive);
  if (!excitation) return answered(error_answer(excitation.error()));
  return answered(windings_answer(*excitation, full_steps_per_turn, first, last));
}

// `method`: RampMethod. Rates in steps a second, the acceleration in rad/s², the jerk in rad/s³; 0: no limit.
std::size_t PASSO_EXPORT(lab_ramp)(int method, double clock, int steps_per_turn, double acceleration, int steps,
                                   int whole_move, int whole_ticks, double rate, double start, double jerk,
                                   int table_size) {
  if (method < 0 || method > static_cast<int>(RampMethod::midpoint)) return answered(error_answer("no such method"));
  RampRequest request;
  request.setup = {.clock = Hertz(clock), .steps_per_turn = steps_per_turn, .acceleration = {acceleration}};
  request.method = static_cast<RampMethod>(method);
  request.steps = steps;
  request.whole_move = whole_move != 0;
  request.whole_ticks = whole_ticks != 0;
  request.rate = Hertz(rate);
  request.start = Hertz(start);
  request.jerk = {jerk};
  request.table_size = table_size;
  return answered(ramp_answer(request));
}

// The motor, its drive and its load, in SI units. `regulation`: Regulation.
void PASSO_EXPORT(lab_motor)(int steps_per_turn, double rotor_inertia, double holding_torque, double current,
                             double resistance, double inductance, double supply, int regulation, double load_inertia,
                             double friction) {
  asked_motor() = {
      .data = {.rotor = {.steps_per_revolution = steps_per_turn, .inertia = {rotor_inertia}},
               .holding_torque = {holding_torque},
               .rated_current = {current},
               .resistance = {resistance},
               .inductance = {inductance}},
      .drive = {.supply = {supply}, .regulation = regulation == 1 ? Regulation::resistive : Regulation::chopper},
      .load = {.inertia = {load_inertia}, .friction = {friction}}};
}

std::size_t PASSO_EXPORT(lab_torque)(double margin, double acceleration, int rows) {
  const AskedMotor& motor = asked_motor();
  return answered(torque_answer({.motor = motor.data,
                                 .drive = motor.drive,
                                 .load = motor.load,
                                 .margin = margin,
                                 .acceleration = {acceleration},
                                 .rows = rows}));
}

// The motor of lab_motor(), whose supply is the unraised one.
std::size_t PASSO_EXPORT(lab_driver)(double drop, double raised, double series, double ripple, double rate, double gain,
                                     double base_emitter, double logic, double reserve, double base) {
  const AskedMotor& motor = asked_motor();
  return answered(driver_answer({.motor = motor.data,
                                 .supply = motor.drive.supply,
                                 .raised = {raised},
                                 .series = {series},
                                 .ripple = ripple,
                                 .rate = Hertz(rate),
                                 .transistor = {.gain = gain, .base_emitter = {base_emitter}, .saturation = {drop}},
                                 .logic = {logic},
                                 .reserve = reserve,
                                 .base = {base}}));
}

// The first board. All that is pressed and driven is given each time.
std::size_t PASSO_EXPORT(lab_board)(int lines, int keys, int button, double microseconds) {
  board().set_lines(static_cast<std::uint8_t>(lines));
  board().set_keys(static_cast<std::uint16_t>(keys));
  board().set_button(button != 0);
  board().run(static_cast<std::int64_t>(microseconds));
  return answered(board().answer());
}
// Another board: rotors at 0, and nothing driven.
void PASSO_EXPORT(lab_board_restart)() {
  board(true);
}
// `pressed` 1: the emergency button is pressed; 0: it is released, and the board starts.
void PASSO_EXPORT(lab_board_reset)(int pressed) {
  board().reset(pressed != 0);
}
// `pulses` -1: without an end. `axes` 0: the clock stops. `wired`: the clock lines that have a pin.
void PASSO_EXPORT(lab_board_clock)(int axes, double half_us, double pulses, int idle, int wired) {
  board().set_clock(static_cast<std::uint8_t>(axes), static_cast<std::int64_t>(half_us),
                    static_cast<std::int64_t>(pulses), static_cast<std::uint8_t>(idle),
                    static_cast<std::uint8_t>(wired));
}

// `controlled`: Controlled. The inner gains are those of the speed loop inside a position loop.
std::size_t PASSO_EXPORT(lab_loop)(int controlled, double to, double period, double kp, double ki, double kd,
                                   double inner_kp, double inner_ki, double load, double load_at, double whole) {
  LoopSetup setup = loop_of(controlled, to, period);
  setup.gains = {.kp = kp, .ki = ki, .kd = kd};
  setup.speed_gains = {.kp = inner_kp, .ki = inner_ki};
  setup.load = {load};
  setup.load_at = Seconds(load_at);
  return answered(loop_answer(setup, Seconds(whole)));
}

std::size_t PASSO_EXPORT(lab_ultimate)(int controlled, double to, double period, double inner_kp, double inner_ki) {
  LoopSetup setup = loop_of(controlled, to, period);
  setup.speed_gains = {.kp = inner_kp, .ki = inner_ki};
  return answered(ultimate_answer(setup));
}

}  // extern "C"
