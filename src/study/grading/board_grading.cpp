#include "passo/grading/board_grading.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "passo/base/counted.hpp"
#include "passo/base/ensure.hpp"
#include "passo/confinement/confinement.hpp"
#include "passo/confinement/temporary_folder.hpp"
#include "passo/emulator/emulated_follower.hpp"
#include "passo/emulator/hex_file.hpp"
#include "passo/grading/board_case.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr Nanoseconds longest_case = 5'000'000'000;  // of the chip's time
constexpr ResourceLimits emulator_limits{
    .processor_seconds = 60, .memory = std::uint64_t{1} << 30, .file_size = std::uint64_t{256} << 20};

// The student does not know the name of the copy.
std::string about_program(std::string words, const fs::path& image) {
  const std::size_t at = words.find(image.string());
  return at == std::string::npos ? words : words.replace(at, image.string().size(), "it");
}

// In the child process: plays the case and leaves a line for each change, or "! " and the reason why there are none.
[[noreturn]] void play_in_child(const BoardCase& one, const std::string& board, const fs::path& image,
                                const fs::path& work) {
  std::string told;
  // Without Landlock: the program is still in the emulated chip.
  Status<std::string> confined = Unit{};
  if (check_confinement()) confined = confine({.folder = work, .readable = {}, .may_start_processes = true});
  limit_resources(emulator_limits);
  std::signal(SIGXFSZ, SIG_DFL);  // a log that is cut off would look like an output that does not change
  const PicFollower chip = board.starts_with("first_board") ? PicFollower::first_board : PicFollower::at_20_mhz;
  if (!confined) {
    told = "! " + confined.error();
  } else if (const auto run = run_pic_follower(chip, image, one.lines, one.end, work); !run) {
    told = "! " + about_program(run.error(), image);
  } else {
    for (const OutputChange& change : run->changes) {
      told += fmt::format("{} {} {}\n", change.at, change.output, change.value);
    }
  }
  std::ofstream out(work / "changes");
  out << told;
  out.close();
  ::_exit(out ? 0 : 1);
}

// Each takes half a minute: two are enough to know.
constexpr int most_stopped_cases = 2;

struct Played {
  std::vector<OutputChange> changes = {};
  bool was_stopped = false;
  std::string trouble = {};  // with the program; a sentence without a full stop
};

Played read_changes(const fs::path& file) {
  std::ifstream in(file);
  Played played;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("! ")) {
      played.trouble = line.substr(2);
      return played;
    }
    std::istringstream words(line);
    OutputChange change;
    words >> change.at >> change.output >> change.value;
    played.changes.push_back(change);
  }
  return played;
}

Result<Played, std::string> play(const BoardCase& one, const std::string& board, const fs::path& hex) {
  TemporaryFolder work;
  std::error_code error;
  if (!work.make()) return Failure{std::string("cannot create a temporary folder")};
  const fs::path image = work.path("program.hex");
  fs::copy_file(hex, image, error);
  if (error) return Failure{image.string() + ": " + error.message()};
  const pid_t child = ::fork();
  if (child < 0) return Failure{std::string("no process: ") + std::strerror(errno)};
  if (child == 0) play_in_child(one, board, image, work.name());
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::uintmax_t log = fs::file_size(work.path("pins.log"), error);
  if (!error && log >= emulator_limits.file_size) {
    return Played{.was_stopped = true,
                  .trouble = fmt::format("it writes to its ports more often than can be recorded: {} MB in {:g} s",
                                         log >> 20, static_cast<double>(one.end) * 1e-9)};
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return Played{.was_stopped = true, .trouble = "the emulator did not end"};
  return read_changes(work.path("changes"));
}

CaseGrade judge(const BoardCase& one, const Played& played) {
  CaseGrade grade{.name = one.name};
  if (!played.trouble.empty()) {
    grade.fault = fmt::format("{}: {}", one.name, played.trouble);
    return grade;
  }
  const OutputFault fault = find_output_fault(one, played.changes);
  grade.is_right = fault.output.empty();
  if (grade.is_right) return grade;
  grade.fault = fmt::format("{}: {}", one.name, fault.words);
  grade.pulse = static_cast<std::int64_t>(fault.number);
  grade.output = fault.output;
  grade.at = static_cast<double>(fault.at) * 1e-9;
  grade.expected = fault.expected;
  grade.found = fault.found;
  return grade;
}

// A file that is no program at all would make gpsim fail in each case.
std::string refuse_hex(const fs::path& hex) {
  const std::string fault = find_hex_fault(hex);
  return fault.empty() ? "" : hex.filename().string() + " is not an Intel HEX file: " + fault;
}

}  // namespace

Result<Grade, std::string> grade_board(const Submission& submission, const std::string& board,
                                       const GradingWatch& watch) {
  if (!gpsim_is_here()) {
    return Failure{std::string("gpsim, which emulates the PIC, is not installed: run scripts/install.sh")};
  }
  const std::vector<BoardCase> cases = board_cases(board);
  Grade grade{.student = submission.student, .cases = cases.size()};
  TemporaryFolder copy;
  if (!copy.make()) return Failure{std::string("cannot create a temporary folder")};
  const Status<std::string> copied = copy_submission(submission, copy.name());
  const auto hex =
      copied ? only_file_with(copy.name(), ".hex") : Result<fs::path, std::string>(Failure{copied.error()});
  grade.trouble = hex ? refuse_hex(*hex) : hex.error();
  if (grade.trouble.empty()) grade.program = hex->filename().string();
  int stopped = 0;
  for (const BoardCase& one : cases) {
    if (!grade.trouble.empty()) break;
    if (stopped == most_stopped_cases) {
      grade.remark = fmt::format("it was stopped {} times; {} played", stopped,
                                 counted(cases.size() - grade.played.size(), "case was not", "cases were not"));
      break;
    }
    if (watch && !watch(static_cast<double>(grade.played.size()) / static_cast<double>(cases.size()))) break;
    ensure(one.end <= longest_case, "no case takes longer than a program gets");
    const Result<Played, std::string> played = play(one, board, *hex);
    if (!played) return Failure{played.error()};
    grade.played.push_back(judge(one, *played));
    if (played->was_stopped) ++stopped;
  }
  return grade;
}

}  // namespace passo
