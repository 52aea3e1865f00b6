#include "gpsim_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>

#include <poll.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace passo {
namespace {

constexpr int longest_wait_ms = 120'000;
constexpr std::size_t kept_output = 4096;

// A .cod file names its processor, a .hex does not.
[[noreturn]] void become_gpsim(const std::filesystem::path& work, const std::string& image, int in, int out) {
  // Ctrl-C in the terminal is for Passo, which brakes and then plays the rest. But gpsim must not outlive Passo.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  if (::chdir(work.c_str()) != 0) ::_exit(126);
  const char* const kind = image.ends_with(".hex") ? "-ppic16f877a" : "-s";
  ::execlp("gpsim", "gpsim", "-i", kind, image.c_str(), static_cast<char*>(nullptr));
  ::_exit(127);
}

}  // namespace

GpsimProcess::GpsimProcess(const std::filesystem::path& work, const std::string& image)
    : child_([&](int in, int out) { become_gpsim(work, image, in, out); }) {}

// It waits for commands, or hangs: there is nothing that it would have to finish.
GpsimProcess::~GpsimProcess() {
  child_.kill();
}

bool GpsimProcess::execute(const std::string& commands) {
  if (!child_.is_running()) return false;
  const std::string name = "done-" + std::to_string(++executed_);
  if (!child_.send(commands + "echo " + name + "\n")) return false;
  // gpsim also repeats the command, after its prompt on the same line.
  return wait_for("\n" + name + "\n");
}

bool GpsimProcess::wait_for(const std::string& mark) {
  while (said_.find(mark) == std::string::npos) {
    pollfd ready{.fd = child_.output(), .events = POLLIN, .revents = 0};
    const int came = ::poll(&ready, 1, longest_wait_ms);
    if (came < 0 && errno == EINTR) continue;
    if (came <= 0) return false;
    std::array<char, 4096> piece;
    const ssize_t got = ::read(child_.output(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    said_.append(piece.data(), static_cast<std::size_t>(got));
    if (said_.size() > 2 * kept_output) said_.erase(0, said_.size() - kept_output);
  }
  return true;
}

std::string GpsimProcess::last_line() const {
  const std::size_t end = said_.find_last_not_of('\n');
  if (end == std::string::npos) return "nothing";
  const std::size_t before = said_.find_last_of('\n', end);
  return said_.substr(before == std::string::npos ? 0 : before + 1, end - (before == std::string::npos ? 0 : before));
}

}  // namespace passo
