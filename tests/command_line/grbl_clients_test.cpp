// passo serve, driven by a real bCNC where one is installed.
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "kit/command_line.hpp"
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

class GrblServe : public passo::test::CommandLine {};

// Ports of this computer that nobody listens on: another build's test may run at the same time.
std::array<int, 2> free_ports() {
  std::array<int, 2> ports{};
  std::array<int, 2> sockets{};
  for (std::size_t i = 0; i < ports.size(); ++i) {
    sockets[i] = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(bind(sockets[i], any, length), 0);
    EXPECT_EQ(getsockname(sockets[i], any, &length), 0);
    ports[i] = ntohs(address.sin_port);
  }
  for (const int one : sockets) close(one);
  return ports;
}

// Port 0 is chosen by the system; the first lines of the output tell it. bCNC draws on a screen of its own, whose
// number is as free as the port of bCNC's own server.
TEST_F(GrblServe, bcnc_passes_its_checks) {
  const std::string script = PASSO_SOURCE_DIR "/../shared/clients/run-bcnc.sh";
  if (!std::filesystem::exists(script)) GTEST_SKIP() << "no ../shared/clients beside the checkout";
  const char* const looks_for = "command -v xdotool Xvfb import >/dev/null && test -d /usr/share/bcnc";
  if (std::system(looks_for) != 0) GTEST_SKIP() << "needs the packages bcnc, xvfb, xdotool and imagemagick";
  const auto [port, own_port] = free_ports();
  const std::string said = path("said");
  const std::string serve = std::string(PASSO_PROGRAM) + " serve --grbl-tcp 127.0.0.1:0 >" + said;
  const std::string address = "$(sed -n 's/^ *\\(tcp:.*\\)/\\1/p' " + said + ")";
  const std::string where =
      fmt::format("PORT={} PEND={} DISP=:{} WORK_DIR={}", port, own_port, own_port, path("bcnc-home"));
  const std::string command = serve + " & daemon=$!; while ! grep -q Ctrl-C " + said +
                              "; do kill -0 $daemon || exit 1; sleep 0.1; done; " + where + " bash " + script + " " +
                              address + " >" + path("bcnc") + " 2>&1; code=$?; kill $daemon; wait $daemon; exit $code";
  EXPECT_EQ(std::system(command.c_str()), 0) << passo::test::read(path("bcnc"));
}

}  // namespace
