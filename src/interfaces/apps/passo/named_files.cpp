#include "named_files.hpp"

#include <algorithm>
#include <filesystem>

#include "commands.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// False: there is no such file.
bool find(const std::string& path, int standard, struct stat& found) {
  return path == "-" ? fstat(standard, &found) == 0 : stat(path.c_str(), &found) == 0;
}

// weakly_canonical() alone leaves "a.csv" as it is where there is no such file, and makes "./a.csv" absolute.
std::string without_detours(const std::string& path) {
  std::error_code none;
  const fs::path all = fs::weakly_canonical(fs::absolute(path, none), none);
  return none ? path : all.string();
}

}  // namespace

// Devices and pipes may be named as often as one likes. A file that is not there yet has only its name.
bool NamedFiles::are_one(const Named& a, const Named& b) {
  struct stat one {};
  struct stat other {};
  const bool is_one = find(a.path, a.is_read ? STDIN_FILENO : STDOUT_FILENO, one);
  const bool is_other = find(b.path, b.is_read ? STDIN_FILENO : STDOUT_FILENO, other);
  if (is_one && is_other) {
    const bool same = one.st_dev == other.st_dev && one.st_ino == other.st_ino;
    return same && (S_ISREG(one.st_mode) || (a.path == "-" && b.path == "-"));
  }
  return !is_one && !is_other && a.path != "-" && b.path != "-" && without_detours(a.path) == without_detours(b.path);
}

bool NamedFiles::is_sub(const std::string& path) const {
  std::error_code none;
  const fs::path file = fs::canonical(path, none);
  if (none || file.extension() != ".ngc") return false;
  return std::ranges::any_of(sub_folders_, [&](const std::string& folder) {
    std::error_code missing;
    return fs::equivalent(folder, file.parent_path(), missing);
  });
}

bool NamedFiles::are_apart() const {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    for (std::size_t j = 0; j < files_.size(); ++j) {
      const Named& output = files_[i];
      const Named& other = files_[j];
      // Each pair once: an input with an output, or the later of two outputs with the earlier.
      if (i == j || !output.is_written || (other.is_written && i < j) || !are_one(output, other)) continue;
      const char* const why =
          other.is_read ? "an input file, which would be overwritten" : "so one would overwrite the other";
      fail(exit_bad_program,
           fmt::format("{} {}: it is the same file as {}, {}", output.what, output.path, other.what, why));
      return false;
    }
  }
  for (const Named& output : files_) {
    if (!output.is_written || output.is_read || !is_sub(output.path)) continue;
    fail(exit_bad_program,
         fmt::format("{} {}: would overwrite a program that other programs may call", output.what, output.path));
    return false;
  }
  return true;
}

bool outputs_are_apart(const std::vector<std::string>& pictures, const std::string& output) {
  NamedFiles files;
  for (const std::string& picture : pictures) files.writes("--picture", picture);
  files.writes("--output", output);
  return files.are_apart();
}

}  // namespace passo
