// LowProcess: this program once more, as a process of its own at the lowest priority: whatever its input contains, the
// machine goes on.
//
// It may take `most_time` of a processor and `most_memory`. It inherits none of the server's files and lines. What it
// writes to standard output and standard error lies in files of its folder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

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

  LowProcess() = default;
  LowProcess(const LowProcess&) = delete;
  LowProcess& operator=(const LowProcess&) = delete;
  ~LowProcess() { end(); }

  // `words`: the command line, the first is the program's name. False: one runs already, or none can begin.
  bool begin(const std::string& folder, const std::vector<std::string>& words);
  bool runs() const { return process_ != 0; }
  // How it has ended, as waitpid() tells; once. Empty: it runs, or there is none.
  std::optional<int> poll();
  void end();

 private:
  pid_t process_ = 0;
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
