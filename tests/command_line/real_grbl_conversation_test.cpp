// The table of tests/kit/grbl_conversations.inc, asked of the real ones.
#include "kit/command_line.hpp"
#include "kit/real_grbl.hpp"

namespace {

class RealGrblConversation : public passo::test::CommandLine {
 protected:
  void SetUp() override {
    if (!passo::test::has_grbl_peers()) GTEST_SKIP() << "no ../shared/peers/grbl beside the checkout";
  }
};

TEST_F(RealGrblConversation, goes_with_grbl_as_written) {
  const std::string uno = passo::test::built_uno(path(""));
  if (uno.empty()) GTEST_SKIP() << "grbl_on_uno does not build here: libsimavr is missing";
  const std::string link = path("tty");
  const passo::test::ChildProcess process(
      {uno, passo::test::grbl_peers + "/grbl-1.1h-uno.elf", link, "--speed", "0", "--probe-at", "Z:-1000"}, path(""));
  passo::test::RealTalker machine(passo::test::open_when_there(link));
  machine.listen(40, std::chrono::seconds(10));  // its settings, which a new EEPROM lacks, and its greeting
  machine.ask("$RST=*\n", 4);
  for (const auto& one : passo::test::grbl_conversations()) passo::test::hold_conversation(machine, one, false);
}

TEST_F(RealGrblConversation, goes_with_grblhal_as_written) {
  const int port = 20000 + static_cast<int>(getpid() % 10000);
  const passo::test::ChildProcess process({passo::test::grbl_peers + "/grblHAL_sim", "-n", "-p", std::to_string(port),
                                           "-t", "1", "-e", "eeprom", "-s", "steps", "-b", "blocks", "-r", "1"},
                                          path(""));
  const int line = passo::test::connect_when_there(port);
  ASSERT_GE(line, 0);
  passo::test::RealTalker machine(line);
  for (const auto& one : passo::test::grbl_conversations()) {
    if (one.on_grblhal) passo::test::hold_conversation(machine, one, true);
  }
}

}  // namespace
