// passo board serve: the virtual machine as a board in the network, in real time, for those who have no board at hand.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "commands.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "passo/machine/virtual_machine.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {
namespace {

// How often a board that plays looks whether the host has sent something.
constexpr Seconds look{0.001};
constexpr Seconds idle_look{0.05};

// Only for this computer: whoever can connect can turn the motors.
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

// The host's side of the port is where the machine's bytes come from. The machine's time follows the clock.
void serve(StreamPort& host, VirtualMachine& machine) {
  const Seconds ahead = machine.elapsed() - host.elapsed();
  bool plays = true;
  while (!host.broken()) {
    if (host.run(plays ? look : idle_look)) machine.receive(host.replies());
    const Seconds before = machine.elapsed();
    for (Seconds now = host.elapsed() + ahead; machine.elapsed() < now;) {
      if (!machine.run(now - machine.elapsed())) break;
      host.receive(machine.replies());
    }
    if (const auto said = machine.replies(); !said.empty()) host.receive(said);
    plays = machine.elapsed() > before;
  }
}

}  // namespace

int board_serve(const BoardServeArguments& arguments) {
  unsigned port = 0;
  const int listening = listen_on_loopback(arguments.port, port);
  if (listening < 0) return fail(exit_failed, fmt::format("127.0.0.1:{} is in use by another program", arguments.port));
  fmt::print("A virtual board of {} motors: tcp:127.0.0.1:{}\n", arguments.motors, port);
  std::fflush(stdout);
  VirtualMachine machine(static_cast<std::uint8_t>(arguments.motors), Hertz(arguments.clock));
  do {
    const int descriptor = accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
    if (descriptor < 0) break;
    StreamPort host(descriptor);
    serve(host, machine);
  } while (!arguments.once);
  close(listening);
  return exit_done;
}

}  // namespace passo
