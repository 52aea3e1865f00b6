// passo board serve: the virtual machine as a board in the network, in real time. It is for people without a board.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>

#include "commands.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/base/counted.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/transport/board_server.hpp"

namespace passo {
namespace {

// How long the board waits for bytes before its time goes on: while it plays, and while it is idle.
constexpr Seconds look_every{0.001};
constexpr Seconds idle_look{0.05};

// Without a machine file and without options.
constexpr unsigned usual_motors = 4;
constexpr double usual_clock = 16e6;

// Lets the machine's time follow the clock, with a host or without.
class RealTime {
 public:
  explicit RealTime(VirtualMachine& machine) : machine_(machine) {}

  // Runs the machine up to now. What the machine says meanwhile goes to the host, if there is one.
  void catch_up(BoardServer& server) {
    const Seconds before = machine_.elapsed();
    for (Seconds now = elapsed(); machine_.elapsed() < now;) {
      const bool said = machine_.run(now - machine_.elapsed());
      server.send_to_host(machine_.replies());
      if (!said) break;
    }
    plays_ = machine_.elapsed() > before;
  }
  // How long to wait for the host until the next look.
  Seconds patience() const { return plays_ ? look_every : idle_look; }

 private:
  Seconds elapsed() const {
    return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  }

  VirtualMachine& machine_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool plays_ = false;
};

volatile std::sig_atomic_t reset_pressed = 0;

extern "C" void press_reset(int /*signal*/) {
  reset_pressed = 1;
}

// Until Ctrl-C; with `once`, until the last program has left.
void serve(BoardServer& server, VirtualMachine& machine, bool once) {
  RealTime time(machine);
  while (interrupted_by() == 0 && !(once && server.all_have_left())) {
    server.wait(time.patience());
    time.catch_up(server);
    server.attend(machine);
    if (reset_pressed == 0) continue;
    reset_pressed = 0;
    machine.reset_board();
  }
}

}  // namespace

int board_serve(const BoardServeArguments& arguments) {
  IdealPlant plant;
  unsigned motors = usual_motors;
  BoardDescription board{.clock = Hertz(usual_clock), .highest_event_rate = Hertz(0)};
  PinSetup wiring;
  bool has_wheel = false;
  if (!arguments.machine.empty()) {
    Diagnostics diagnostics;
    const std::optional<MachineDescription> description = load_machine_file(arguments.machine, diagnostics);
    show(diagnostics);
    if (!description) return exit_bad_machine;
    plant = plant_of(*description);
    motors = std::max(motors, static_cast<unsigned>(description->motor_count()));
    board = description->board;
    wiring = pin_setup(*description);
    has_wheel = description->handwheel.has_value();
  }
  motors = arguments.motors.value_or(motors);
  const Hertz clock{arguments.clock.value_or(board.clock.value())};
  const auto server = BoardServer::listen(arguments.port);
  if (!server) return fail(exit_failed, server.error());
  VirtualMachine machine(static_cast<std::uint8_t>(motors), clock, board.highest_event_rate,
                         static_cast<std::size_t>(board.held_items));
  machine.connect(plant);
  machine.wire(wiring);
  if (has_wheel) machine.fit_handwheel();
  catch_signals();
  std::signal(SIGUSR1, press_reset);
  fmt::print("Simulated board with {}, {:.0f} ticks/s, at tcp:127.0.0.1:{}\n", counted(motors, "motor"), clock.value(),
             (*server)->port());
  std::fflush(stdout);
  serve(**server, machine, arguments.once);
  return interrupted_by() != 0 ? 128 + interrupted_by() : exit_done;
}

}  // namespace passo
