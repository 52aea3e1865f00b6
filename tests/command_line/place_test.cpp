// Where a machine stands, from one command to the next: kept as long as the board counts, and never guessed.
#include <filesystem>

#include "kit/served_board.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;
using testing::Not;

class PlaceOfAMachine : public passo::test::ServedBoard {
 protected:
  PlaceOfAMachine() { begin("-5.2"); }

  // A machine whose switches are near. `x`: where the switch of X closes.
  void begin(const std::string& x) {
    const std::string axis =
        "steps_per_mm = 640\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 800\ntravel_mm = [-5, 5]\n";
    const std::string speeds = "seek_mm_s = 20\nlatch_mm_s = 2\npull_off_mm = 0.5\n";
    std::string text = "name = 'near'\n[board]\nclock_hz = 16e6\nmax_event_rate_hz = 100e3\n";
    const auto add = [&](const std::string& letter, const std::string& home) {
      text += "[axis." + letter + "]\n" + axis + "[axis." + letter + ".home]\n" + speeds + home;
    };
    add("X", "direction = 'low'\nswitch_at_mm = " + x + "\n");
    add("Y", "direction = 'low'\nswitch_at_mm = -5.2\n");
    add("Z", "direction = 'high'\nswitch_at_mm = 5.1\n");
    machine_ = write("near.toml", text);
    board_ = serve("16000000", machine_);
  }
  std::string on_board() const { return " -m " + machine_ + " --board " + board_ + " "; }
  Outcome run(const std::string& program, const std::string& more = "") const {
    return passo("run -q " + write("p.ngc", program + "\nM2\n") + on_board() + more);
  }
  // The board has counted from machine zero, where it stood when it was started.
  double x() const {
    const auto info = nlohmann::json::parse(passo("board info --json " + board_).out, nullptr, false);
    return info["status"]["positions"][0].get<double>() / 640;
  }
  std::string place_file() const {
    std::string name = board_;
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
    return path("state/passo/" + name + ".place");
  }

  std::string machine_;
  std::string board_;
};

TEST_F(PlaceOfAMachine, is_asked_for_where_nobody_knows_it) {
  const Outcome unknown = run("G21 G90 G0 X3");
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("the machine position is unknown: it was never homed"));
  EXPECT_THAT(unknown.err, HasSubstr("--home"));
  EXPECT_THAT(unknown.err, HasSubstr("--from-here"));
  EXPECT_THAT(unknown.err, HasSubstr("--resume"));
  EXPECT_THAT(unknown.err, HasSubstr("[run.place-unknown]"));
  EXPECT_EQ(x(), 0);
  EXPECT_EQ(run("G21 G90 G0 X3", "--from-here --resume").code, 2);
}

TEST_F(PlaceOfAMachine, that_somebody_has_told_is_kept) {
  EXPECT_EQ(run("G21 G90 G0 X3", "--from-here").code, 0);
  EXPECT_EQ(x(), 3);
  const Outcome again = run("G21 G90 G0 X3");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(x(), 3) << "it stands there already";
  // What leaves the travel from there is refused before anything moves.
  EXPECT_EQ(run("G21 G91 G0 X3").code, 2);
  EXPECT_EQ(run("G21 G91 G0 X3", "--from-here").code, 0) << "here is zero";
  EXPECT_EQ(x(), 6);
}

TEST_F(PlaceOfAMachine, that_was_homed_is_kept_through_runs_jogs_and_kills) {
  ASSERT_EQ(passo("home" + on_board()).code, 0);
  EXPECT_EQ(x(), -4.7);
  EXPECT_EQ(run("G21 G90 G0 X2").code, 0);
  EXPECT_EQ(x(), 2);
  EXPECT_EQ(passo("jog X-1 -F 3000" + on_board()).code, 0);
  EXPECT_EQ(run("G21 G90 G0 X2").code, 0);
  EXPECT_EQ(x(), 2);
  // Killed in mid-run, the board brakes by itself, and counts.
  const std::string program = write("q.ngc", "G21 G90 G1 F300\nX4\nX-4\nX4\nX-4\nM2\n");
  const std::string begun = place_file().substr(0, place_file().rfind('.')) + ".journal";
  const std::string killer = "(while [ ! -e " + begun + " ]; do sleep 0.05; done; sleep 0.5; kill -9 $$) & ";
  const std::string line = killer + "exec " PASSO_PROGRAM " run -q " + program + on_board();
  EXPECT_NE(std::system(("sh -c '" + line + "' >/dev/null 2>&1").c_str()), 0);
  // It jogs to the end of the travel and no further, wherever it was.
  Outcome after = passo("jog X+ -F 3000" + on_board());
  for (int i = 0; after.code != 0 && i < 50; ++i) {
    usleep(100'000);  // it still braked
    after = passo("jog X+ -F 3000" + on_board());
  }
  EXPECT_EQ(after.code, 0) << after.err;
  EXPECT_EQ(x(), 5);
  EXPECT_EQ(run("G21 G90 G0 X1").code, 0);
  EXPECT_EQ(x(), 1);
}

TEST_F(PlaceOfAMachine, of_a_board_that_was_reset_is_not_known) {
  ASSERT_EQ(run("G21 G90 G0 X3", "--from-here").code, 0);
  const std::string before = place_file();
  ASSERT_TRUE(std::filesystem::exists(before));
  begin("-5.2");
  std::filesystem::copy(before, place_file(), std::filesystem::copy_options::overwrite_existing);
  const Outcome unknown = run("G21 G90 G0 X3");
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("its board was reset or switched off"));
  EXPECT_EQ(x(), 0);
}

TEST_F(PlaceOfAMachine, on_which_another_computer_has_worked_is_not_known) {
  ASSERT_EQ(run("G21 G90 G0 X3", "--from-here").code, 0);
  const std::string elsewhere = "XDG_STATE_HOME=" + path("elsewhere");
  ASSERT_EQ(passo("jog X+1 -F 3000" + on_board(), elsewhere).code, 0);
  const Outcome unknown = run("G21 G90 G0 X3");
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("another program was run on its board"));
}

// X's switch is closed within its travel.
TEST_F(PlaceOfAMachine, at_a_closed_limit_switch_is_no_start) {
  begin("-3");
  const Outcome stopped = run("G21 G90 G1 F3000 X-4.9", "--from-here");
  EXPECT_EQ(stopped.code, 1);
  EXPECT_THAT(stopped.err, HasSubstr("closed now: limit 1"));
  EXPECT_THAT(stopped.err, HasSubstr("the board: the limit switch of X closed in line 1 of " + path("p.ngc")));
  EXPECT_THAT(stopped.err, HasSubstr("near X-3.000 Y0.000 Z0.000"));
  EXPECT_THAT(stopped.err, HasSubstr("jog off it (passo jog X+2), home the machine (passo home)"));
  EXPECT_THAT(stopped.err, HasSubstr("[board.stopped]"));
  EXPECT_THAT(stopped.err, Not(HasSubstr("--resume")));
  const double closed_at = x();
  EXPECT_EQ(closed_at, -3);
  const Outcome unknown = run("G21 G90 G0 X1");
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("its motors were stopped instantly"));
  EXPECT_THAT(unknown.err, Not(HasSubstr("was left unfinished")));
  for (int i = 0; i < 2; ++i) {
    const Outcome again = run("G21 G90 G0 X-1", "--from-here");
    EXPECT_EQ(again.code, 1);
    EXPECT_THAT(again.err, HasSubstr("the limit switch of X is closed: jog off it, or home the machine, first "
                                     "[machine.limit-closed]"));
    EXPECT_THAT(again.err, Not(HasSubstr("was left unfinished")));
    const Outcome toward = passo("jog X-1 -F 3000" + on_board());
    EXPECT_EQ(toward.code, 1);
    EXPECT_THAT(toward.err, HasSubstr("the limit switch of X is closed at that end"));
    EXPECT_EQ(x(), closed_at);
  }
  EXPECT_EQ(passo("jog X+1 -F 3000" + on_board()).code, 0);
  EXPECT_EQ(x(), -2);
  const Outcome moved = run("G21 G90 G0 X1", "--from-here");
  EXPECT_EQ(moved.code, 0) << moved.err;
  EXPECT_THAT(moved.err, Not(HasSubstr("was left unfinished")));
}

// Each way off it that the words name, on one board, which is never started anew.
TEST_F(PlaceOfAMachine, at_a_closed_limit_switch_is_not_the_end) {
  begin("-3");
  const auto run_onto_it = [&](const std::string& more) {
    const Outcome stopped = run("G21 G90 F3000\nG1 Y1\nX1 Y0\nX-4.9\nX0", more);
    EXPECT_EQ(stopped.code, 1);
    EXPECT_THAT(stopped.err, HasSubstr("the limit switch of X closed in line 4 of "));
    EXPECT_EQ(x(), -3);
  };
  run_onto_it("--from-here");
  EXPECT_EQ(passo("home" + on_board()).code, 0);
  EXPECT_EQ(x(), -2.5);
  EXPECT_EQ(run("G21 G90 G0 X1").code, 0);
  run_onto_it("");
  EXPECT_EQ(run("G21 G90 G0 X1", "--home").code, 0);
  EXPECT_EQ(x(), 1);
  run_onto_it("");
  EXPECT_EQ(passo("jog X+1 -F 3000" + on_board()).code, 0);
  const Outcome jogged = passo("jog X-2 -F 3000" + on_board());
  EXPECT_EQ(jogged.code, 1);
  EXPECT_THAT(jogged.err, HasSubstr("the limit switch of X closed: the motors stopped instantly near X"));
  EXPECT_THAT(jogged.err, HasSubstr("jog off it (passo jog X+2), home the machine (passo home) [board.stopped]"));
  EXPECT_EQ(passo("home" + on_board()).code, 0);
  EXPECT_EQ(run("G21 G90 G0 X1").code, 0);
  EXPECT_EQ(x(), 1);
}

// A program that is homed first is stopped by the same switch.
TEST_F(PlaceOfAMachine, behind_a_limit_switch_is_out_of_reach_also_after_homing) {
  begin("-3");
  for (int i = 0; i < 2; ++i) {
    const Outcome stopped = run("G21 G90 G1 F3000 X-4.9", "--home");
    EXPECT_EQ(stopped.code, 1);
    EXPECT_THAT(stopped.err, HasSubstr("closed now: limit 1"));
    EXPECT_EQ(x(), -3);
  }
}

// The machine that is simulated in the command's own process has switches too.
TEST_F(PlaceOfAMachine, at_a_closed_limit_switch_is_no_start_of_a_virtual_machine) {
  begin("3");
  const Outcome closed = passo("run -q " + write("p.ngc", "G21 G90 G0 X1\nM2\n") + " -m " + machine_);
  EXPECT_EQ(closed.code, 1);
  EXPECT_THAT(closed.err, HasSubstr("the limit switch of X is closed"));
}

}  // namespace
