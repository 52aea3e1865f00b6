// passo board serve: the virtual machine as a board in the network, in real time. It is for people without a board.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include "commands.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {
namespace {

// How long a board waits for bytes of the host before its time goes on: while it plays, and while it is idle.
constexpr Seconds look{0.001};
constexpr Seconds idle_look{0.05};

// Listens for this computer only, because whoever can connect can turn the motors. `found` is set to the port.
int listen_on_loopback(unsigned port, unsigned& found) {
  const int listening = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(listening, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  auto* const plain = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (bind(listening, plain, size) != 0 || listen(listening, 1) != 0 || getsockname(listening, plain, &size) != 0) {
    close(listening);
    return -1;
  }
  found = ntohs(address.sin_port);
  return listening;
}

// Lets the machine's time follow the clock, with a host or without.
class RealTime {
 public:
  explicit RealTime(VirtualMachine& machine) : machine_(machine) {}

  // Runs the machine up to now. What the machine says meanwhile goes to the host, if there is one.
  void catch_up(StreamPort* host) {
    const Seconds before = machine_.elapsed();
    for (Seconds now = elapsed(); machine_.elapsed() < now;) {
      const bool said = machine_.run(now - machine_.elapsed());
      if (const auto bytes = machine_.replies(); host != nullptr && !bytes.empty()) host->receive(bytes);
      if (!said) break;
    }
    plays_ = machine_.elapsed() > before;
  }
  // How long to wait for the host until the next look.
  Seconds patience() const { return plays_ ? look : idle_look; }

 private:
  Seconds elapsed() const {
    return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  }

  VirtualMachine& machine_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool plays_ = false;
};

// A board hears one host. Another that calls meanwhile is sent away at once.
void serve(StreamPort& host, int listening, VirtualMachine& machine, RealTime& time) {
  while (!host.broken()) {
    if (host.run(time.patience())) machine.receive(host.replies());
    time.catch_up(&host);
    pollfd another{.fd = listening, .events = POLLIN, .revents = 0};
    if (poll(&another, 1, 0) <= 0) continue;
    // Has the host gone? Then the other one is its successor.
    if (host.run(Seconds(0))) machine.receive(host.replies());
    if (!host.broken()) close(accept4(listening, nullptr, nullptr, SOCK_CLOEXEC));
  }
}

// Waits for the next host and returns its descriptor; less than 0 if waiting fails.
int wait_for_host(int listening, RealTime& time) {
  for (;;) {
    pollfd one{.fd = listening, .events = POLLIN, .revents = 0};
    const int ready = poll(&one, 1, static_cast<int>(time.patience().value() * 1e3));
    if (ready > 0) return accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
    if (ready < 0) return -1;
    time.catch_up(nullptr);
  }
}

}  // namespace

int board_serve(const BoardServeArguments& arguments) {
  IdealPlant plant;
  PinSetup wiring;
  if (!arguments.machine.empty()) {
    Diagnostics diagnostics;
    const std::optional<MachineDescription> description = load_machine_file(arguments.machine, diagnostics);
    show(diagnostics);
    if (!description) return exit_bad_machine;
    plant = plant_of(*description);
    wiring = pin_setup(*description);
  }
  unsigned port = 0;
  const int listening = listen_on_loopback(arguments.port, port);
  if (listening < 0) return fail(exit_failed, fmt::format("127.0.0.1:{} is in use by another program", arguments.port));
  fmt::print("A virtual board of {} motors: tcp:127.0.0.1:{}\n", arguments.motors, port);
  std::fflush(stdout);
  VirtualMachine machine(static_cast<std::uint8_t>(arguments.motors), Hertz(arguments.clock));
  machine.connect(plant);
  machine.wire(wiring);
  RealTime time(machine);
  outlive_readers();
  do {
    const int descriptor = wait_for_host(listening, time);
    if (descriptor < 0) break;
    StreamPort host(descriptor);
    serve(host, listening, machine, time);
  } while (!arguments.once);
  close(listening);
  return exit_done;
}

}  // namespace passo
