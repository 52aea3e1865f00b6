// passo run over a line, killed or stopped in mid-run, and passo run --resume: the board's counts end where they would
// have ended; and what is not certain is refused, with a code.
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>

#include "kit/served_board.hpp"
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace {

using passo::test::Outcome;
using passo::test::read;

// About one and a half seconds.
const std::string text =
    "G21 G90 G64 P.02 F3000 M3 S1000\nG4 P.1\nG2 X6 Y0 I3 J0\nG3 X9 I1.5\nG1 X4 Y3\nM8\nX12 Z-1\nX2 Y2\nG0 X5 Y1 "
    "Z2\nM5 M9\nM2\n";

class Resumed : public passo::test::ServedBoard {
 protected:
  Resumed() {
    board_ = serve("18000000");
    program_ = write("p.ngc", text);
  }

  std::string command(const std::string& more = "") const {
    const bool resumes = more.find("--resume") != std::string::npos;
    return "run " + program_ + " --json -m " + machine_ + " --board " + board_ + " --journal " + journal() + " " +
           (resumes ? "" : from_here) + more;
  }
  std::string journal() const { return path("j"); }
  bool journal_is_there() const { return std::filesystem::exists(journal()); }

  // Starts it, waits until it has noted so many refills, and sends the signal. Its exit code, or the signal below 0.
  int run_until(int notes, int signal, const std::function<void()>& meanwhile = {}) {
    const pid_t run = fork();
    if (run == 0) {
      const std::string line =
          std::string("exec ") + PASSO_PROGRAM + " " + command() + " >" + path("run.out") + " 2>" + path("run.err");
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(1);
    }
    wait_for_notes(notes);
    if (meanwhile) meanwhile();
    if (signal != 0) kill(run, signal);
    int status = 0;
    waitpid(run, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  // The board itself cannot be asked: it serves one host at a time.
  void wait_for_notes(int notes) const {
    for (int i = 0; i < 2000; ++i, usleep(5'000)) {
      if (journal_is_there() && lines_noted() >= notes) return;
    }
    ADD_FAILURE() << "nothing happens";
  }
  int lines_noted() const {
    std::istringstream lines(read(journal()));
    int noted = 0;
    bool head = true;
    for (std::string line; std::getline(lines, line);) {
      if (head) {
        head = !line.starts_with("check");
      } else if (line.find_first_not_of(' ') != std::string::npos) {
        ++noted;
      }
    }
    return noted;
  }
  nlohmann::json positions() const {
    return nlohmann::json::parse(passo("board info --json " + board_).out)["status"]["positions"];
  }
  void expect_counts_of_the_whole_program() const {
    const auto alone = nlohmann::json::parse(passo("run " + program_ + " --json -m " + machine_).out)["steps"];
    const auto counted = positions();
    EXPECT_EQ(counted[0], alone["X"]["net"]);
    EXPECT_EQ(counted[1], alone["Y"]["net"]);
    EXPECT_EQ(counted[2], alone["Z"]["net"]);
  }
  // A job that was not finished, by a hold for good.
  void leave_unfinished() {
    const Outcome held = passo(command("--hold-at 0.4"));
    ASSERT_EQ(held.code, 0) << held.err;
    ASSERT_NE(held.err.find("--resume continues"), std::string::npos) << held.err;
  }
  void expect_refused(const std::string& code, const std::string& words, const std::string& more = "--resume") const {
    const Outcome refused = passo(command(more));
    EXPECT_EQ(refused.code, 4) << refused.err;
    EXPECT_NE(refused.err.find("[" + code + "]"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
  }

  std::string machine_ = (std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / "router.toml").string();
  std::string board_;
  std::string program_;
};

TEST_F(Resumed, after_it_was_killed_twice_it_ends_where_it_would_have_ended) {
  EXPECT_EQ(run_until(8, SIGKILL), -SIGKILL);
  // While the board still brakes: the other waits for its rest.
  const Outcome stopped = passo(command("--resume --hold-at 0.5"));
  EXPECT_EQ(stopped.code, 0) << stopped.err;
  EXPECT_NE(stopped.err.find("continues at line"), std::string::npos) << stopped.err;
  const Outcome resumed = passo(command("--resume"));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  expect_counts_of_the_whole_program();
  const auto summary = nlohmann::json::parse(resumed.out);
  EXPECT_EQ(summary["steps"]["X"]["net"], positions()[0]) << "counted from where the job began";
  EXPECT_FALSE(journal_is_there());
}

TEST_F(Resumed, after_ctrl_c_which_brakes_on_the_path_and_says_where) {
  EXPECT_EQ(run_until(8, SIGINT), 130);
  EXPECT_EQ(read(path("run.out")), "") << "a script reads no summary of a run that has not ended";
  const std::string said = read(path("run.err"));
  EXPECT_NE(said.find("stopping on the path"), std::string::npos) << said;
  EXPECT_NE(said.find("interrupted; the machine is stopped at X"), std::string::npos) << said;
  EXPECT_NE(said.find("--resume continues"), std::string::npos) << said;
  const Outcome resumed = passo(command("--resume"));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  expect_counts_of_the_whole_program();
}

TEST_F(Resumed, after_the_terminal_was_closed_which_is_as_ctrl_c) {
  EXPECT_EQ(run_until(8, SIGHUP), 129);
  const std::string said = read(path("run.err"));
  EXPECT_NE(said.find("interrupted; the machine is stopped at X"), std::string::npos) << said;
  const Outcome resumed = passo(command("--resume"));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  expect_counts_of_the_whole_program();
}

// What the probe has found is in the journal; here it meets nothing.
TEST_F(Resumed, with_probe_moves_before_and_behind) {
  write("p.ngc",
        "G21 G90 G38.3 X1 F600\nG0 X[#5061-1]\n" + text.substr(0, text.size() - 3) + "G38.3 Z1 F600\nG0 Y0\nM2\n");
  EXPECT_EQ(run_until(12, SIGKILL), -SIGKILL);
  const Outcome resumed = passo(command("--resume"));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  expect_counts_of_the_whole_program();
}

// Nobody told the board to: a killed host tells nothing. Who only looks is no host.
TEST_F(Resumed, after_a_kill_that_left_the_spindle_to_the_board_which_has_switched_it_off) {
  EXPECT_EQ(run_until(8, SIGKILL), -SIGKILL);
  nlohmann::json status;
  for (int i = 0; i < 200 && status["outputs_timed_out"] != true; ++i, usleep(50'000)) {
    status = nlohmann::json::parse(passo("board info --json " + board_).out)["status"];
  }
  EXPECT_EQ(status["outputs_timed_out"], true);
  EXPECT_EQ(status["moves"], false);
  const Outcome info = passo("board info " + board_);
  EXPECT_NE(info.out.find("its outputs are off because its host was silent"), std::string::npos) << info.out;
  const Outcome resumed = passo(command("--resume"));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  expect_counts_of_the_whole_program();
}

// The board's computer stands still, as if the cable were out, and goes on.
TEST_F(Resumed, is_not_needed_while_a_silent_board_is_waited_for_which_is_said_at_once) {
  const auto silent = [&] {
    signal_server(SIGSTOP);
    for (int i = 0; i < 2000 && read(path("run.err")).find("silent") == std::string::npos; ++i) usleep(10'000);
    signal_server(SIGCONT);
  };
  EXPECT_EQ(run_until(8, 0, silent), 0);
  const std::string said = read(path("run.err"));
  EXPECT_NE(said.find("passo: the board does not answer; check its cable. The machine stops on the path. The program "
                      "continues when the board answers, or ends in 60 s\n"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("passo: the board answers again; the program continues\n"), std::string::npos) << said;
  expect_counts_of_the_whole_program();
}

TEST_F(Resumed, twice_is_once_too_often) {
  leave_unfinished();
  EXPECT_EQ(passo(command("--resume")).code, 0);
  expect_refused("resume.no-journal", "there is no unfinished job on this board");
}

TEST_F(Resumed, not_when_what_it_is_of_was_changed) {
  leave_unfinished();
  const std::string machine = machine_;
  machine_ = write("m.toml", read(machine) + "\n");
  expect_refused("resume.machine-changed", "the unfinished job uses " + machine);
  machine_ = machine;
  write("p.ngc", text + "(more)\n");
  expect_refused("resume.program-changed", "p.ngc was changed since the job started");
  write("p.ngc", text);
  expect_refused("resume.path-changed", "the options", "--resume --inches");
  EXPECT_EQ(passo(command("--resume")).code, 0);
}

TEST_F(Resumed, not_when_the_board_was_used_or_started_anew) {
  leave_unfinished();
  const std::string other = write("q.ngc", "G21 G1 X1 F600\nM2\n");
  const Outcome between =
      passo("run " + other + " -q -m " + machine_ + " --board " + board_ + from_here + " --journal " + path("j2"));
  ASSERT_EQ(between.code, 0) << between.err;
  expect_refused("resume.other-session", "another program");
  board_ = serve("18000000");
  expect_refused("resume.board-reset", "the machine position is no longer certain");
}

TEST_F(Resumed, not_by_a_journal_that_was_torn) {
  leave_unfinished();
  const std::string whole = read(journal());
  write("j", whole.substr(0, 100));
  expect_refused("resume.torn-journal", "is incomplete");
  std::string without_rests = whole;
  for (std::size_t i = whole.find("check ") + 24; i < whole.size(); ++i) {
    if (whole[i] != '\n' && whole[i] != ' ') without_rests[i] = '0';
  }
  write("j", without_rests);
  expect_refused("resume.torn-journal", "it does not contain the point at which the board stopped");
  write("j", whole + std::string(2 << 20, '\n'));
  expect_refused("resume.torn-journal", "is incomplete");
  write("j", whole);
  EXPECT_EQ(passo(command("--resume")).code, 0);
}

// A pipe is read only once; what comes out of it is known again by its path.
TEST_F(Resumed, with_the_program_from_a_pipe) {
  program_ = path("pipe");
  ASSERT_EQ(mkfifo(program_.c_str(), S_IRUSR | S_IWUSR), 0);
  const auto through_the_pipe = [&](const std::string& more, const std::string& program) {
    std::thread writer([&] { std::ofstream(program_) << program; });
    const Outcome outcome = passo(command(more));
    writer.join();
    return outcome;
  };
  const Outcome held = through_the_pipe("--hold-at 0.4", text);
  EXPECT_NE(held.err.find("--resume continues"), std::string::npos) << held.err;
  const Outcome other = through_the_pipe("--resume", "G21 G1 F3000 Z1\n" + text);
  EXPECT_NE(other.err.find("[resume.path-changed]"), std::string::npos) << other.err;
  const Outcome resumed = through_the_pipe("--resume", text);
  EXPECT_EQ(resumed.code, 0) << resumed.err;
}

TEST_F(Resumed, is_not_what_a_run_does_unasked_but_it_mentions_it) {
  leave_unfinished();
  const Outcome anew = passo(command("--hold-at 0.01"));
  EXPECT_NE(anew.err.find("p.ngc was left unfinished on this board; --resume would have continued"), std::string::npos)
      << anew.err;
}

// While a run goes on, another one must not touch its journal.
TEST_F(Resumed, not_while_the_job_still_runs) {
  write("p.ngc", "G21 G1 X1 F600\nG4 P600\nM2\n");
  Outcome again;
  Outcome asked;
  const int code = run_until(1, SIGINT, [&] {
    again = passo(command("--resume"));
    asked = passo("board info --wait 1 " + board_);
  });
  EXPECT_EQ(code, 130) << read(path("run.err"));
  EXPECT_EQ(again.code, 1);
  EXPECT_NE(again.err.find("in use by another passo [journal.in-use]"), std::string::npos) << again.err;
  EXPECT_EQ(again.err.find("was left unfinished"), std::string::npos) << again.err;
  EXPECT_EQ(asked.code, 0) << "whoever only looks disturbs nobody: " << asked.err;
}

// Another journal makes no difference: the board is taken.
TEST_F(Resumed, not_on_a_board_that_another_program_drives) {
  write("p.ngc", "G21 G1 X1 F600\nG4 P600\nM2\n");
  Outcome other;
  const std::string jog = "jog X+1 -m " + machine_ + " --board " + board_;
  EXPECT_EQ(run_until(1, SIGINT, [&] { other = passo(jog); }), 130);
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.err.find("in use by another passo, process"), std::string::npos) << other.err;
  EXPECT_EQ(passo(jog).code, 0);
}

TEST_F(Resumed, not_with_a_file_that_is_no_journal) {
  for (const std::string& list : {std::string("bread, milk"), std::string(2 << 20, 'x')}) {
    const Outcome outcome = passo("run " + program_ + " -m " + machine_ + " --board " + board_ + from_here +
                                  " --journal " + write("list.txt", list));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(read(path("list.txt")), list);
  }
}

TEST_F(Resumed, from_the_usual_place_of_journals_a_board) {
  const std::string usual = "run " + program_ + " -q -m " + machine_ + " --board " + board_;
  const std::string home = "XDG_STATE_HOME=" + path("state");
  ASSERT_EQ(passo(usual + from_here + " --hold-at 0.4", home).code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("state/passo")));
  EXPECT_EQ(passo(usual + " --resume", home).code, 0);
  expect_counts_of_the_whole_program();
  const Outcome nowhere = passo(usual + " --resume", "env -u XDG_STATE_HOME -u HOME");
  EXPECT_EQ(nowhere.code, 4);
}

TEST_F(Resumed, or_from_a_line_whose_steps_are_shown_first) {
  const auto alone = nlohmann::json::parse(passo("run " + program_ + " --json -m " + machine_).out)["steps"];
  const std::string from_line = "run " + program_ + " --json -m " + machine_ + " --from-line ";
  const Outcome outcome = passo(from_line + "5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  // The corner before the line is rounded, and the line begins amid the corner.
  for (const char* step :
       {"1. up to Z", "2. spindle on, clockwise at 1000", "3. over to X8.98", "continues at line 5"}) {
    EXPECT_NE(outcome.err.find(step), std::string::npos) << step << outcome.err;
  }
  for (const char* axis : {"X", "Y", "Z"}) {
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["steps"][axis]["net"], alone[axis]["net"]) << axis;
  }
  const Outcome nowhere = passo(from_line + "77");
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_NE(nowhere.err.find("[reentry.no-motion]"), std::string::npos) << nowhere.err;
  const std::string loop = write("loop.ngc", "G21 G90 F900\no1 repeat [2]\nG1 X5\nX1 Y1\no1 endrepeat\nG1 X0 Y0\nM2\n");
  const std::string from_loop = "run " + loop + " --json -m " + machine_ + " --from-line 4";
  EXPECT_NE(passo(from_loop).err.find("as --pass 2 [reentry.done-often]"), std::string::npos) << passo(from_loop).err;
  const Outcome second = passo(from_loop + " --pass 2 --after 1.5");
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_EQ(nlohmann::json::parse(second.out)["steps"]["X"]["net"], 0);
  EXPECT_EQ(passo("run " + loop + " -m " + machine_ + " --pass 2").code, 2) << "without a line";
  const Outcome unasked = passo(command("--from-line 5"));
  EXPECT_EQ(unasked.code, 2);
  EXPECT_NE(unasked.err.find("[run.from-line-unasked]"), std::string::npos) << unasked.err;
  EXPECT_EQ(passo(command("--from-line 5 --yes")).code, 0);
  expect_counts_of_the_whole_program();
}

TEST_F(Resumed, only_over_a_line) {
  const Outcome alone = passo("run " + program_ + " -m " + machine_ + " --resume");
  EXPECT_EQ(alone.code, 2);
  EXPECT_NE(alone.err.find("--resume and --journal are only for boards that keep running"), std::string::npos);
  const Outcome unwritable =
      passo("run " + program_ + " -m " + machine_ + " --board " + board_ + from_here + " --journal /dev/null/j");
  EXPECT_EQ(unwritable.code, 1);
  EXPECT_NE(unwritable.err.find("cannot be written: Not a directory"), std::string::npos) << unwritable.err;
}

TEST_F(Resumed, or_told_what_is_truly_wrong_with_the_journal) {
  const std::string run = "run " + program_ + " -m " + machine_ + " --board " + board_ + from_here;
  std::filesystem::create_directory(path("folder"));
  const Outcome folder = passo(run + " --journal " + path("folder"));
  EXPECT_EQ(folder.code, 1);
  EXPECT_NE(folder.err.find("this journal cannot be opened: Is a directory [journal.unreadable]"), std::string::npos)
      << folder.err;
  write("j", "bread, milk");
  expect_refused("resume.no-journal", "is not a journal of Passo");
  EXPECT_EQ(read(journal()), "bread, milk");
}

}  // namespace
