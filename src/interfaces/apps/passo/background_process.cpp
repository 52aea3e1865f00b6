#include "background_process.hpp"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "passo/confinement/confinement.hpp"

namespace passo {
namespace {

// In the new process.
[[noreturn]] void become(const std::string& folder, const std::vector<std::string>& words, int input, int progress) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the server, which ends this process
  std::signal(SIGTERM, SIG_DFL);
  if (chdir(folder.c_str()) != 0) _exit(127);
  const int said = open(BackgroundProcess::said_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int printed = open(BackgroundProcess::printed_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(input, 0);
  dup2(printed, 1);
  dup2(said, 2);
  if (progress != BackgroundProcess::progress_pipe) {
    dup2(progress, BackgroundProcess::progress_pipe);
  } else {
    fcntl(progress, F_SETFD, 0);
  }
  close_range(BackgroundProcess::progress_pipe + 1, ~0U, 0);
  setenv(BackgroundProcess::wants_progress, "1", 1);
  limit_resources({.processor_seconds = BackgroundProcess::most_time,
                   .memory = BackgroundProcess::most_memory,
                   .file_size = BackgroundProcess::longest_file});
  // A tenth of what others get on a busy computer. At 19 it would be a hundredth: an answer of a second took two
  // minutes.
  setpriority(PRIO_PROCESS, 0, 10);
  execv("/proc/self/exe", pointers.data());
  _exit(127);
}

// A file without a name that holds the bytes; nothing if there is no memory for it.
std::optional<int> input_of(std::string_view bytes) {
  const int file = memfd_create("input", MFD_CLOEXEC);
  if (file < 0) return {};
  const bool is_whole = write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  if (is_whole && lseek(file, 0, SEEK_SET) == 0) return file;
  close(file);
  return {};
}

}  // namespace

bool BackgroundProcess::begin(const std::string& folder, const std::vector<std::string>& words,
                              std::string_view input) {
  if (process_ != 0) return false;
  const std::optional<int> given = input_of(input);
  if (!given) return false;
  int ends[2];
  if (pipe2(ends, O_NONBLOCK | O_CLOEXEC) != 0) {
    close(*given);
    return false;
  }
  const pid_t process = fork();
  if (process == 0) become(folder, words, *given, ends[1]);
  close(*given);
  close(ends[1]);
  close_pipe();
  pipe_ = ends[0];
  progress_ = {};
  if (process > 0) process_ = process;
  return process > 0;
}

int BackgroundProcess::percent() {
  std::uint8_t messages[256];
  const ssize_t count = pipe_ < 0 ? 0 : read(pipe_, messages, sizeof messages);
  if (count > 0) progress_.take({messages, static_cast<std::size_t>(count)});
  return progress_.percent();
}

void BackgroundProcess::close_pipe() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
}

std::optional<int> BackgroundProcess::poll() {
  int status = 0;
  if (process_ == 0 || waitpid(process_, &status, WNOHANG) != process_) return {};
  process_ = 0;
  return status;
}

void BackgroundProcess::end() {
  if (process_ == 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = 0;
}

std::string words_of_end(int status) {
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    return "it exceeded its time limit and was stopped";
  }
  return "it failed";
}

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string content;
  std::vector<char> piece(65536);
  do {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    content.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  } while (in);
  return content;
}

bool write_content(const std::string& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<bool>(out.flush());
}

}  // namespace passo
