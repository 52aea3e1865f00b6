#include "passo/confinement/confined_run.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "passo/confinement/confinement.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t longest_input = 60'000;  // fits into a pipe that nobody reads
constexpr std::size_t most_files = 1000;
constexpr std::uint64_t most_open_files = 64;
constexpr std::uint64_t most_threads = 64;
constexpr auto look_every = std::chrono::milliseconds(20);

class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) ends_ = {-1, -1};
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  bool is_open() const { return ends_[0] >= 0; }
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_end(std::size_t which) {
    if (ends_[which] >= 0) close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  std::array<int, 2> ends_ = {-1, -1};
};

struct Pipes {
  Pipe input, output, messages;
  Pipe start;  // why the program did not start
  bool are_open() const { return input.is_open() && output.is_open() && messages.is_open() && start.is_open(); }
};

// Threads count as processes of this user. The kernel counts all of the user's, so others get room, too.
std::uint64_t thread_limit() {
  std::ifstream load("/proc/loadavg");
  std::string words;
  std::getline(load, words, '/');
  std::uint64_t all = 0;
  return load >> all ? all + most_threads : 10'000;
}

void set_environment(const std::string& folder) {
  clearenv();
  setenv("PATH", "/usr/local/bin:/usr/bin:/bin", 1);
  setenv("HOME", folder.c_str(), 1);
  setenv("TMPDIR", folder.c_str(), 1);
  setenv("LANG", "C.UTF-8", 1);
}

[[noreturn]] void tell(int pipe, const std::string& why) {
  [[maybe_unused]] const ssize_t told = write(pipe, why.data(), why.size());
  _exit(127);
}

// In the new process. A failure of execve() is told as its number, one of this computer as a sentence.
[[noreturn]] void become(const ConfinedProgram& program, const Pipes& pipes) {
  std::vector<char*> words;
  for (const std::string& word : program.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive a command that Ctrl-C has ended
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (chdir(program.folder.c_str()) != 0) tell(pipes.start.write_end(), program.folder + ": " + std::strerror(errno));
  dup2(pipes.input.read_end(), 0);
  dup2(pipes.output.write_end(), 1);
  dup2(pipes.messages.write_end(), 2);
  constexpr int start = 3;
  if (pipes.start.write_end() != start) dup3(pipes.start.write_end(), start, O_CLOEXEC);
  close_range(start + 1, ~0U, 0);
  set_environment(program.folder);
  const std::uint64_t threads = thread_limit();
  if (!program.unconfined) {
    const Status<std::string> confined = confine({.folder = program.folder, .readable = program.readable});
    if (!confined) tell(start, confined.error());
  }
  limit_resources({.processor_seconds = program.limits.processor_seconds,
                   .memory = program.limits.memory,
                   .file_size = program.limits.output});
  const rlimit files{most_open_files, most_open_files};
  setrlimit(RLIMIT_NOFILE, &files);
  const rlimit tasks{threads, threads};
  setrlimit(RLIMIT_NPROC, &tasks);
  execvp(words[0], words.data());
  tell(start, std::to_string(errno));
}

// What /proc says of a process.
struct Activity {
  bool is_running = false;
  std::uint64_t ticks = 0;  // of processor time
};
Activity activity_of(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(in, text);
  // The name in parentheses may contain anything.
  std::istringstream words(text.substr(std::min(text.rfind(')') + 1, text.size())));
  std::string state;
  std::string skipped;
  words >> state;
  for (int i = 0; i < 10; ++i) words >> skipped;
  std::uint64_t user = 0;
  std::uint64_t system = 0;
  words >> user >> system;
  return {state == "R", user + system};
}

struct FolderSize {
  std::uint64_t bytes = 0;
  std::size_t files = 0;
};
FolderSize size_of(const std::string& folder) {
  FolderSize size;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code none;
    const std::uint64_t bytes = entry->is_regular_file(none) && !entry->is_symlink(none) ? entry->file_size(none) : 0;
    if (!none) size.bytes += bytes;
    if (++size.files > 2 * most_files) break;
  }
  return size;
}

// The parent's side of a running program.
class Supervisor {
 public:
  Supervisor(const ConfinedProgram& program, pid_t process, Pipes& pipes)
      : program_(program), process_(process), pipes_(pipes), before_(size_of(program.folder)) {
    handle_ = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
    for (const int end : {pipes_.output.read_end(), pipes_.messages.read_end()}) {
      fcntl(end, F_SETFL, fcntl(end, F_GETFL) | O_NONBLOCK);
    }
  }
  ~Supervisor() {
    if (handle_ >= 0) close(handle_);
  }
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  ConfinedRun run() {
    while (!has_ended()) {
      wait_a_little();
      read_pipes();
      if (!stopped_) look();
      if (stopped_) kill(-process_, SIGKILL);
    }
    // What an unconfined program has left. The process is not reaped yet, so no other has its number.
    kill(-process_, SIGKILL);
    int status = 0;
    rusage used{};
    wait4(process_, &status, 0, &used);
    read_pipes();
    run_.processor_seconds = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                             1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    run_.peak_memory = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
    judge(status);
    return std::move(run_);
  }

 private:
  bool has_ended() const {
    siginfo_t ended{};
    return waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid != 0;
  }

  void wait_a_little() {
    std::array<pollfd, 3> watched = {pollfd{pipes_.output.read_end(), POLLIN, 0},
                                     pollfd{pipes_.messages.read_end(), POLLIN, 0}, pollfd{handle_, POLLIN, 0}};
    poll(watched.data(), watched.size(), static_cast<int>(look_every.count()));
  }

  void read_pipes() {
    read_pipe(pipes_.output, run_.output);
    read_pipe(pipes_.messages, run_.messages);
  }
  void read_pipe(Pipe& pipe, std::string& text) {
    std::array<char, 65536> piece;
    while (pipe.read_end() >= 0) {
      const ssize_t count = read(pipe.read_end(), piece.data(), piece.size());
      if (count < 0) return;
      if (count == 0) {
        pipe.close_end(0);
        return;
      }
      const std::uint64_t room = program_.limits.output - run_.output.size() - run_.messages.size();
      text.append(piece.data(), std::min<std::uint64_t>(static_cast<std::uint64_t>(count), room));
      if (static_cast<std::uint64_t>(count) > room) {
        stop(ConfinedRun::End::too_much_output);
        return;
      }
    }
  }

  // Whether it waits, or fills its folder.
  void look() {
    const auto now = Clock::now();
    if (now < next_look_) return;
    next_look_ = now + look_every;
    const Activity activity = activity_of(process_);
    if (activity.is_running || activity.ticks != ticks_) worked_ = now;
    ticks_ = activity.ticks;
    if (now - worked_ > std::chrono::seconds(program_.limits.waiting_seconds) ||
        now - start_ > std::chrono::seconds(program_.limits.total_seconds)) {
      stop(ConfinedRun::End::waits);
    }
    if (program_.is_cancelled && program_.is_cancelled()) stop(ConfinedRun::End::waits);
    if (fills_its_folder()) stop(ConfinedRun::End::too_much_output);
  }
  bool fills_its_folder() const {
    const FolderSize now = size_of(program_.folder);
    return now.bytes > before_.bytes + program_.limits.output || now.files > before_.files + most_files;
  }
  void stop(ConfinedRun::End why) {
    if (!stopped_) stopped_ = why;
  }

  void judge(int status) {
    if (!stopped_ && fills_its_folder()) stop(ConfinedRun::End::too_much_output);
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (stopped_) {
      run_.end = *stopped_;
    } else if (signal == SIGXCPU ||
               (signal == SIGKILL && run_.processor_seconds >= program_.limits.processor_seconds)) {
      run_.end = ConfinedRun::End::processor_time;
    } else if (signal == SIGXFSZ) {
      run_.end = ConfinedRun::End::too_much_output;
    } else {
      run_.end = signal != 0 ? ConfinedRun::End::crashed : ConfinedRun::End::exited;
      run_.code = signal != 0 ? signal : WEXITSTATUS(status);
    }
  }

  const ConfinedProgram& program_;
  pid_t process_;
  Pipes& pipes_;
  FolderSize before_;
  int handle_ = -1;
  ConfinedRun run_;
  std::optional<ConfinedRun::End> stopped_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point worked_ = start_;
  Clock::time_point next_look_ = start_;
  std::uint64_t ticks_ = 0;
};

// Empty: it has started.
std::string read_start(int pipe) {
  std::string told;
  std::array<char, 512> piece;
  for (ssize_t count = 0; (count = read(pipe, piece.data(), piece.size())) != 0;) {
    if (count > 0) told.append(piece.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) break;
  }
  return told;
}

}  // namespace

Result<ConfinedRun, std::string> run_confined(const ConfinedProgram& program) {
  if (program.input.size() > longest_input) return Failure{std::string("the input is longer than a pipe")};
  Pipes pipes;
  if (!pipes.are_open()) return Failure{std::string("no pipe: ") + std::strerror(errno)};
  [[maybe_unused]] const ssize_t put = write(pipes.input.write_end(), program.input.data(), program.input.size());
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process < 0) return Failure{std::string("no process: ") + std::strerror(errno)};
  if (process == 0) become(program, pipes);
  pipes.input.close_end(0);
  pipes.input.close_end(1);
  pipes.output.close_end(1);
  pipes.messages.close_end(1);
  pipes.start.close_end(1);
  const std::string told = read_start(pipes.start.read_end());
  if (told.empty()) return Supervisor(program, process, pipes).run();
  while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (told.find_first_not_of("0123456789") != std::string::npos) return Failure{told};
  return ConfinedRun{.end = ConfinedRun::End::not_started, .code = std::stoi(told)};
}

std::string describe_end(const ConfinedRun& run, const ProgramLimits& limits) {
  const auto mib = [](std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MB"; };
  switch (run.end) {
    case ConfinedRun::End::exited: return run.code == 0 ? "" : "ended with exit code " + std::to_string(run.code);
    case ConfinedRun::End::crashed: {
      std::string words = std::string("crashed: ") + strsignal(run.code);
      if (run.peak_memory > limits.memory / 4 * 3) {
        words += " after it had used " + mib(run.peak_memory) + " of memory; " + mib(limits.memory) + " are allowed";
      }
      return words;
    }
    case ConfinedRun::End::processor_time:
      return "used more than " + std::to_string(limits.processor_seconds) + " s of processor time";
    case ConfinedRun::End::waits: return "waited without an end";
    case ConfinedRun::End::too_much_output: return "wrote more than " + mib(limits.output);
    case ConfinedRun::End::not_started: return std::string("cannot be started: ") + std::strerror(run.code);
  }
  return "";
}

}  // namespace passo
