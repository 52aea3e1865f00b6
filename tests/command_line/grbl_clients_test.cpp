// passo serve, driven by a real bCNC where one is installed.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "kit/command_line.hpp"

namespace {

class GrblServe : public passo::test::CommandLine {};

// Port 0 is chosen by the system; the first lines of the output tell it.
TEST_F(GrblServe, bcnc_passes_its_checks) {
  const std::string script = PASSO_SOURCE_DIR "/../shared/clients/run-bcnc.sh";
  if (!std::filesystem::exists(script)) GTEST_SKIP() << "no ../shared/clients beside the checkout";
  if (std::system("command -v xdotool Xvfb >/dev/null && test -d /usr/share/bcnc") != 0) {
    GTEST_SKIP() << "needs the packages bcnc, xvfb, xdotool and imagemagick";
  }
  const std::string said = path("said");
  const std::string serve = std::string(PASSO_PROGRAM) + " serve --grbl-tcp 127.0.0.1:0 >" + said;
  const std::string address = "$(sed -n 's/^ *\\(tcp:.*\\)/\\1/p' " + said + ")";
  const std::string command = serve + " & daemon=$!; while ! grep -q Ctrl-C " + said + "; do sleep 0.1; done; bash " +
                              script + " " + address + " >" + path("bcnc") +
                              " 2>&1; code=$?; kill $daemon; wait $daemon; exit $code";
  EXPECT_EQ(std::system(command.c_str()), 0) << passo::test::read(path("bcnc"));
}

}  // namespace
