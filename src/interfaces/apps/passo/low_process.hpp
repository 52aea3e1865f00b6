// LowProcess: this program once more, as a process of its own at the lowest priority: whatever its input contains, the
// machine goes on.
//
// It may take `most_time` of a processor and `most_memory`. It inherits none of the server's files and lines. What it
// writes to standard output and standard error lies in files of its folder. Its progress comes by a pipe, as the typed
// messages of percent_line.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "passo/base/percent_line.hpp"

namespace passo {

class LowProcess {
 public:
  static constexpr unsigned most_time = 120;                            // s of a processor
  static constexpr std::uint64_t most_memory = std::uint64_t{3} << 30;  // bytes
  static constexpr std::uint64_t longest_file = std::uint64_t{512} << 20;
  static constexpr std::size_t longest_words = 8000;  // of what is told of it
  // In its folder.
  static constexpr const char* said_file = ".said";        // standard error
  static constexpr const char* printed_file = ".printed";  // standard output
  // A process with this environment variable writes its progress to this descriptor.
  static constexpr const char* wants_progress = "PASSO_WANTS_PROGRESS";
  static constexpr int progress_pipe = 3;

  LowProcess() = default;
  LowProcess(const LowProcess&) = delete;
  LowProcess& operator=(const LowProcess&) = delete;
  ~LowProcess() {
    end();
    close_pipe();
  }

  // `words`: the command line, the first is the program's name. False: one runs already, or none can begin.
  bool begin(const std::string& folder, const std::vector<std::string>& words);
  bool runs() const { return process_ != 0; }
  // How it has ended, as waitpid() tells; once. Empty: it runs, or there is none.
  std::optional<int> poll();
  void end();
  // How much of its work is done, in per cent; it only grows while the process runs.
  int percent();

 private:
  void close_pipe();

  pid_t process_ = 0;
  int pipe_ = -1;  // the end to read from
  PercentReceiver progress_;
};

// Why a process with this end has done nothing, where it said nothing itself.
std::string words_of_end(int status);

// A folder for files of others, removed with all that lies in it. Its name is empty until it is made.
class PassingFolder {
 public:
  PassingFolder() = default;
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  ~PassingFolder() { remove(); }

  // False: it cannot be made.
  bool make();
  void remove();
  const std::string& name() const { return name_; }
  std::string path(const std::string& file) const { return name_ + "/" + file; }

 private:
  std::string name_;
};

std::string content_of(const std::string& file);
// False: it is not written whole.
bool write_content(const std::string& file, std::string_view bytes);

}  // namespace passo
