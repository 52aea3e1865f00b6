// What a stranger's program may try; the first argument says what. Prints "done" where it has succeeded, and the reason
// where it was refused.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

int tell(bool done) {
  if (done) {
    std::puts("done");
  } else {
    std::printf("refused: %s\n", std::strerror(errno));
  }
  return 0;
}

volatile unsigned spun = 0;
[[noreturn]] void spin() {
  while (true) spun = spun + 1;
}

int start_another() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  return tell(child > 0);
}

int connect_out() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  if (socket < 0) return tell(false);
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(80);
  inet_pton(AF_INET, "127.0.0.1", &there.sin_addr);
  connect(socket, reinterpret_cast<const sockaddr*>(&there), sizeof there);
  return tell(true);
}

int read_from(const std::string& file) {
  const int in = open(file.c_str(), O_RDONLY);
  char letter = 0;
  return tell(in >= 0 && read(in, &letter, 1) == 1);
}

int write_to(const std::string& file) {
  const int out = open(file.c_str(), O_WRONLY | O_CREAT, 0600);
  return tell(out >= 0 && write(out, "x", 1) == 1);
}

int eat_memory() {
  std::vector<char*> eaten;
  for (std::size_t i = 0; i < 1024; ++i) {
    char* const piece =
        static_cast<char*>(mmap(nullptr, 1U << 20, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    if (piece == MAP_FAILED) std::abort();
    std::memset(piece, 1, 1U << 20);
    eaten.push_back(piece);
  }
  return tell(true);
}

int fill_folder() {
  const std::string half(600'000, 'x');
  for (int i = 0; i < 100; ++i) {
    std::FILE* const file = std::fopen(("file" + std::to_string(i)).c_str(), "w");
    if (file == nullptr) return tell(false);
    std::fwrite(half.data(), 1, half.size(), file);
    std::fclose(file);
    usleep(20'000);
  }
  return tell(true);
}

int start_threads() {
  int sum = 0;
  std::thread first([&] { sum += 1; });
  first.join();
  std::thread second([&] { sum += 2; });
  second.join();
  return tell(sum == 3);
}

int set_owner(const std::string& process) {
  int ends[2];
  return tell(pipe(ends) == 0 && fcntl(ends[0], F_SETOWN, std::atoi(process.c_str())) == 0);
}

int set_times(const std::string& file) {
  const timeval times[2] = {};
  return tell(utimes(file.c_str(), times) == 0);
}

int limit_other(const std::string& process) {
  const rlimit limit{100, 100};
  return tell(prlimit(std::atoi(process.c_str()), RLIMIT_NOFILE, &limit, nullptr) == 0);
}

int copy_input() {
  for (int letter = 0; (letter = std::getchar()) != EOF;) std::putchar(letter);
  return 0;
}

int with_argument(const std::string& what, const std::string& argument) {
  if (what == "read") return read_from(argument);
  if (what == "write") return write_to(argument);
  if (what == "remove") return tell(unlink(argument.c_str()) == 0);
  if (what == "truncate") return tell(truncate(argument.c_str(), 0) == 0);
  if (what == "chmod") return tell(chmod(argument.c_str(), 0) == 0);
  if (what == "times") return set_times(argument);
  if (what == "kill") return tell(kill(std::atoi(argument.c_str()), 0) == 0);
  if (what == "owner") return set_owner(argument);
  if (what == "limit") return limit_other(argument);
  if (what == "trace") return tell(ptrace(PTRACE_ATTACH, std::atoi(argument.c_str()), nullptr, nullptr) == 0);
  if (what == "exit") return std::atoi(argument.c_str());
  return 99;
}

}  // namespace

int main(int count, char** words) {
  const std::string what = count > 1 ? words[1] : "";
  if (count > 2) return with_argument(what, words[2]);
  if (what == "fork") return start_another();
  if (what == "socket") return connect_out();
  if (what == "streams")
    return tell(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, std::vector<int>(2).data()) == 0);
  if (what == "pair") return tell(socketpair(AF_UNIX, SOCK_DGRAM, 0, std::vector<int>(2).data()) == 0);
  if (what == "memory") return eat_memory();
  if (what == "folder") return fill_folder();
  if (what == "threads") return start_threads();
  if (what == "copy") return copy_input();
  if (what == "crash") std::raise(SIGSEGV);
  if (what == "sleep") pause();
  if (what == "deaf") {
    for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_IGN);
    while (true) pause();
  }
  if (what == "spin") spin();
  if (what == "deaf-spin") {
    std::signal(SIGXCPU, SIG_IGN);
    spin();
  }
  while (what == "endless" && std::puts("1\t1") >= 0) {
  }
  while (what == "complain" && std::fputs("no\n", stderr) >= 0) {
  }
  // A forked sleeper that outlives its parent.
  if (what == "leave" && fork() == 0) {
    while (true) pause();
  }
  return 0;
}
