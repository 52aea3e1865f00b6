// BackgroundProcess: runs this program in a separate process at the lowest priority, so that the machine keeps running
// whatever the input contains.
//
// It is limited to `most_time` of a processor and `most_memory`. It inherits none of the server's files and
// connections. Its standard output and standard error are written to files in its folder. It reports its progress
// through a pipe, as the typed messages of percent_line.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "passo/base/percent_line.hpp"
#include "passo/confinement/temporary_folder.hpp"

namespace passo {

class BackgroundProcess {
 public:
  static constexpr unsigned most_time = 120;                            // maximum processor time, s
  static constexpr std::uint64_t most_memory = std::uint64_t{3} << 30;  // bytes
  static constexpr std::uint64_t longest_file = std::uint64_t{512} << 20;
  static constexpr std::size_t longest_words = 8000;  // maximum length of its messages
  // In its folder.
  static constexpr const char* said_file = ".said";        // standard error
  static constexpr const char* printed_file = ".printed";  // standard output
  // A process with this environment variable writes its progress to this descriptor.
  static constexpr const char* wants_progress = "PASSO_WANTS_PROGRESS";
  static constexpr int progress_pipe = 3;

  BackgroundProcess() = default;
  BackgroundProcess(const BackgroundProcess&) = delete;
  BackgroundProcess& operator=(const BackgroundProcess&) = delete;
  ~BackgroundProcess() {
    end();
    close_pipe();
  }

  // Starts the process. `words`: the command line, beginning with the program's name. Returns false if one is already
  // running, or if it cannot be started. `input`: its standard input, for what the list of processes must not show.
  bool begin(const std::string& folder, const std::vector<std::string>& words, std::string_view input = {});
  bool runs() const { return process_ != 0; }
  // Returns the exit status, as reported by waitpid(), once. Empty: it is running, or there is none.
  std::optional<int> poll();
  void end();
  // Returns how much of its work is done, in per cent. Never decreases while the process runs.
  int percent();

 private:
  void close_pipe();

  pid_t process_ = 0;
  int pipe_ = -1;  // the end to read from
  PercentReceiver progress_;
};

// Explains an exit status for which the process gave no message itself.
std::string words_of_end(int status);

std::string content_of(const std::string& file);
// Returns false if the file cannot be written completely.
bool write_content(const std::string& file, std::string_view bytes);

}  // namespace passo
