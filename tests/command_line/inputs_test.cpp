// The board's inputs as a user meets them: normally closed switches, an emergency stop that is pressed when a command
// begins, drivers that were switched off. Every example machine makes a plain run on every board that it can have.
#include <filesystem>

#include "kit/served_board.hpp"
#include <gmock/gmock.h>

namespace {

namespace fs = std::filesystem;

using passo::test::lacks_an_emulator;
using passo::test::Outcome;
using testing::HasSubstr;
using testing::Not;

const fs::path source = PASSO_SOURCE_DIR;

class Inputs : public passo::test::ServedBoard {
 protected:
  std::string program() const { return write("p.ngc", "G21 G90 G94\nG0 X1\nM2\n"); }
  Outcome run(const std::string& machine, const std::string& board = "", const std::string& more = "") const {
    return passo("run -q --yes " + program() + " -m " + machine + (board.empty() ? "" : " --board " + board) + more);
  }
  // uno.toml with other lines behind it, and with a rate that every board can make.
  std::string uno(const std::string& lines) const {
    std::string text = passo::test::read(source / "examples/machines/uno.toml");
    const std::size_t rate = text.find("max_event_rate_hz");
    text.replace(rate, text.find('\n', rate) - rate, "max_event_rate_hz = 90e3");
    return write("m.toml", text + lines);
  }
};

struct ExampleBoards {
  const char* machine;
  std::vector<const char*> boards;  // emulated ones that it can have
  bool has_drive = false;           // of its spindle, on a bus, which is not here
};

TEST_F(Inputs, of_every_example_machine_let_a_plain_run_begin_on_every_board_that_it_can_have) {
  const std::vector<ExampleBoards> examples = {{"bench", {}},
                                               {"foam", {"mega"}},
                                               {"first-machine", {"first_board"}},
                                               {"forty-eight", {}},
                                               {"gantry", {"mega"}},
                                               {"pantograph", {}},
                                               {"pico", {"pico"}},
                                               {"router", {}},
                                               {"router-vfd", {}, true},
                                               {"strong-router", {}},
                                               {"tool-changer", {}},
                                               {"tool-rack", {}},
                                               {"tool-setter", {}},
                                               {"touch-plate", {}},
                                               {"uno", {"uno"}},
                                               {"windings", {"uno_half_step"}}};
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(source / "examples/machines")) {
    count += entry.path().extension() == ".toml" ? 1 : 0;
  }
  EXPECT_EQ(count, examples.size()) << "each machine is in this list";
  for (const ExampleBoards& example : examples) {
    const std::string machine = (source / "examples/machines" / (std::string(example.machine) + ".toml")).string();
    const Outcome alone = run(machine);
    EXPECT_EQ(alone.code, 0) << example.machine << ": " << alone.err;
    const std::string address = serve("", machine);
    const Outcome served = run(machine, address, from_here);
    EXPECT_EQ(served.code, example.has_drive ? 1 : 0) << example.machine << ", served: " << served.err;
    EXPECT_EQ(served.err.find("[spindle.open]") != std::string::npos, example.has_drive) << served.err;
    for (const char* const board : example.boards) {
      const Outcome emulated = run(machine, std::string("sim:") + board);
      if (lacks_an_emulator(emulated)) continue;
      EXPECT_EQ(emulated.code, 0) << example.machine << ": " << emulated.err;
    }
  }
}

const char* const normally_closed = "\n[inputs]\nlimits = ['high', 'high', 'high']\nemergency_stop = 'high'\n";

TEST_F(Inputs, that_are_normally_closed_let_a_plain_run_begin) {
  const std::string machine = uno(normally_closed);
  EXPECT_EQ(run(machine).code, 0) << run(machine).err;
  for (const char* const board : {"sim:uno", "sim:mega", "sim:pico"}) {
    const Outcome emulated = run(machine, board);
    if (lacks_an_emulator(emulated)) continue;
    EXPECT_EQ(emulated.code, 0) << board << ": " << emulated.err;
  }
  const std::string address = serve("", machine);
  const Outcome served = run(machine, address, from_here);
  EXPECT_EQ(served.code, 0) << served.err;
  EXPECT_EQ(run(machine, address).code, 0) << "nor does the second one take them for closed";
}

// A switch is closed in truth: X stands at 0, where its switch is.
TEST_F(Inputs, that_are_closed_in_truth_are_found_so_at_either_level) {
  for (const std::string level : {"high", "low"}) {
    std::string text = passo::test::read(source / "examples/machines/uno.toml");
    const std::string place = "switch_at_mm = -401";
    text.replace(text.find(place), place.size(), "switch_at_mm = 0.5");
    const std::string machine = write("m.toml", text + "\n[inputs]\nlimits = ['" + level + "', 'high', 'high']\n");
    for (const char* const board : {"", "sim:uno"}) {
      const Outcome outcome = run(machine, board);
      if (lacks_an_emulator(outcome)) continue;
      EXPECT_EQ(outcome.code, 1) << level << board;
      EXPECT_THAT(outcome.err, HasSubstr("the limit switch of X is closed")) << board;
      EXPECT_THAT(outcome.err, HasSubstr("[machine.limit-closed]")) << board;
    }
  }
}

TEST_F(Inputs, of_the_case_in_the_shared_folder_let_it_run) {
  const fs::path cases = source / "../shared/cases/boards";
  if (!fs::exists(cases)) GTEST_SKIP() << "there is no ../shared/cases";
  const std::string machine = (cases / "nc_limits.toml").string();
  const std::string command = "run -q --yes " + (cases / "nc_limits.ngc").string() + " -m " + machine;
  EXPECT_EQ(passo(command).code, 0);
  for (const std::string board : {"sim:uno", "sim:mega", "sim:pico"}) {
    const Outcome outcome = passo(command + " --board " + board);
    if (lacks_an_emulator(outcome)) continue;
    // The case asks for a higher rate than some boards state.
    if (outcome.err.find("[board.event-rate]") != std::string::npos) continue;
    EXPECT_EQ(outcome.code, 0) << board << ": " << outcome.err;
  }
  const Outcome served = passo(command + " --board " + serve("", machine) + from_here);
  EXPECT_EQ(served.code, 0) << served.err;
}

// A normally closed emergency stop is pressed, as far as a board can tell, where its plant has a switch to ground and
// the file says otherwise: a served board of one file, driven by another.
TEST_F(Inputs, name_an_emergency_stop_that_is_pressed_at_the_start) {
  const std::string plain = (source / "examples/machines/uno.toml").string();
  const std::string address = serve("", plain);
  const Outcome pressed = run(uno("\n[inputs]\nemergency_stop = 'high'\n"), address, from_here);
  EXPECT_EQ(pressed.code, 1);
  EXPECT_THAT(pressed.err, HasSubstr("the emergency stop is pressed: release it first"));
  EXPECT_THAT(pressed.err, Not(HasSubstr("stopped its motors")));
}

TEST_F(Inputs, are_not_blamed_for_drivers_that_were_switched_off_by_time) {
  const std::string machine = uno("\n[outputs]\ndrivers_off_after_s = 0.5\n");
  const std::string address = serve("", machine);
  ASSERT_EQ(run(machine, address, from_here).code, 0);
  usleep(900'000);
  const Outcome later = run(machine, address);
  EXPECT_EQ(later.code, 1);
  EXPECT_THAT(later.err, HasSubstr("disabled the drivers after a time without a host (drivers_off_after_s)"));
  EXPECT_THAT(later.err, Not(HasSubstr("stopped instantly")));
}

}  // namespace
