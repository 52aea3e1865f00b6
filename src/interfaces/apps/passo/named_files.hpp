// NamedFiles: the files named on a command line. An output must be neither a file that the command reads, nor another
// output.
#pragma once

#include <string>
#include <vector>

namespace passo {

class NamedFiles {
 public:
  // `what`: the option, or a description of the argument. Empty paths are ignored. "-" is standard input or output.
  void reads(const std::string& what, const std::string& path) { add(what, path, true, false); }
  void writes(const std::string& what, const std::string& path) { add(what, path, false, true); }
  // The command reads the file first, and writes it at its end.
  void updates(const std::string& what, const std::string& path) { add(what, path, true, true); }

  // Any program (.ngc) in this folder may be called as a subroutine.
  void reads_subs(const std::string& folder) { sub_folders_.push_back(folder.empty() ? "." : folder); }

  // Must be called before anything else is done. Returns false, with a message, if two of the names refer to the same
  // file, also through links or different spellings.
  [[nodiscard]] bool are_apart() const;

 private:
  struct Named {
    std::string what;
    std::string path;
    bool is_read = false;
    bool is_written = false;
  };
  void add(const std::string& what, const std::string& path, bool is_read, bool is_written) {
    if (!path.empty()) files_.push_back({what, path, is_read, is_written});
  }
  static bool are_one(const Named& a, const Named& b);
  bool is_sub(const std::string& path) const;

  std::vector<Named> files_;
  std::vector<std::string> sub_folders_;
};

// Does the same for a command that reads no file.
[[nodiscard]] bool outputs_are_apart(const std::vector<std::string>& pictures, const std::string& output);

}  // namespace passo
