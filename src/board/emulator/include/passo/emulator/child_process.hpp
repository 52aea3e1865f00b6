// ChildProcess: a program in a process of its own, with a line to its standard input and one from its output.
#pragma once

#include <functional>
#include <string_view>

#include <sys/types.h>

namespace passo {

class ChildProcess {
 public:
  // Calls become(in, out) in the new process, where `in` and `out` are its ends of the lines. It must not return. If no
  // process can be made, is_running() is false.
  explicit ChildProcess(const std::function<void(int in, int out)>& become);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  // Closes the lines and waits until the process has ended.
  ~ChildProcess();

  bool is_running() const { return process_ > 0; }
  // Returns false if the process has ended.
  [[nodiscard]] bool send(std::string_view bytes);
  // The descriptor to read its output from.
  int output() const { return from_; }
  // Ends it at once.
  void kill();

 private:
  pid_t process_ = -1;
  int to_ = -1;
  int from_ = -1;
};

}  // namespace passo
