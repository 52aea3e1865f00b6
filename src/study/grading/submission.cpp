#include "passo/grading/submission.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include <fmt/format.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20;
constexpr std::size_t most_files = 2000;

bool is_plain(const fs::directory_entry& entry) {
  std::error_code none;
  return !entry.is_symlink(none) && entry.is_regular_file(none);
}

// By its first bytes: files that were uploaded to a school's server have lost their permissions.
bool is_runnable(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 4> begin{};
  in.read(begin.data(), begin.size());
  const std::string_view text(begin.data(), static_cast<std::size_t>(in.gcount()));
  return text ==
             "\x7f"
             "ELF" ||
         text.starts_with("#!");
}

Status<std::string> copy_file_to(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, error);
  if (error) return Failure{from.filename().string() + ": " + error.message()};
  fs::permissions(to, is_runnable(to) ? fs::perms::owner_all : fs::perms::owner_read | fs::perms::owner_write, error);
  return Unit{};
}

Status<std::string> copy_tree(const fs::path& from, const fs::path& to) {
  std::error_code error;
  std::uintmax_t bytes = 0;
  std::size_t files = 0;
  fs::recursive_directory_iterator entry(from, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code none;
    const fs::path there = to / entry->path().lexically_relative(from);
    if (!entry->is_symlink(none) && entry->is_directory(none)) fs::create_directory(there, none);
    if (!is_plain(*entry)) continue;
    bytes += entry->file_size(none);
    if (bytes > most_bytes || ++files > most_files) {
      return Failure{fmt::format("more than {} MB or {} files", most_bytes >> 20, most_files)};
    }
    if (Status<std::string> copied = copy_file_to(entry->path(), there); !copied) return copied;
  }
  if (error) return Failure{error.message()};
  return Unit{};
}

std::string lowered(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

template <class Wanted>
std::vector<fs::path> files_in(const fs::path& folder, const Wanted& wanted) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (is_plain(*entry) && !name.starts_with('.') && wanted(entry->path())) files.push_back(entry->path());
  }
  std::ranges::sort(files);
  return files;
}

// Among several.
Result<fs::path, std::string> chosen(const std::vector<fs::path>& files, const std::string& name,
                                     const std::string& what) {
  if (files.empty()) return Failure{"no " + what};
  if (files.size() == 1) return files[0];
  for (const fs::path& file : files) {
    if (file.stem() == name) return file;
  }
  return Failure{fmt::format("{} files could be the {}: {}, {}{}; the one to use must be named {}", files.size(), what,
                             files[0].filename().string(), files[1].filename().string(), files.size() > 2 ? " ..." : "",
                             name)};
}

}  // namespace

std::vector<Submission> submissions_in(const fs::path& folder, const std::string& ending,
                                       const std::vector<std::string>& command) {
  std::vector<Submission> submissions;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code none;
    const fs::path& path = entry->path();
    if (path.filename().string().starts_with('.')) continue;
    if (!ending.empty() && !entry->is_directory(none) && lowered(path.extension().string()) != ending) continue;
    submissions.push_back({entry->is_directory(none) ? path.filename().string() : path.stem().string(), path, command});
  }
  // Names alone are the same for anna.py and anna.cpp.
  std::ranges::sort(submissions, {}, &Submission::handed);
  for (std::size_t i = 0; i + 1 < submissions.size(); ++i) {
    if (submissions[i].student != submissions[i + 1].student) continue;
    for (std::size_t j : {i, i + 1}) submissions[j].student = submissions[j].handed.filename().string();
  }
  return submissions;
}

Status<std::string> copy_submission(const Submission& submission, const fs::path& folder) {
  if (submission.handed.empty()) return Unit{};
  std::error_code none;
  const fs::directory_entry entry(submission.handed, none);
  if (entry.is_symlink(none)) return Failure{std::string("a link, not a file or a folder")};
  if (entry.is_directory(none)) return copy_tree(submission.handed, folder);
  if (!entry.is_regular_file(none)) return Failure{std::string("neither a file nor a folder")};
  if (entry.file_size(none) > most_bytes) return Failure{fmt::format("more than {} MB", most_bytes >> 20)};
  return copy_file_to(submission.handed, folder / submission.handed.filename());
}

Result<std::vector<std::string>, std::string> command_for(const Submission& submission, const fs::path& copy,
                                                          const std::string& name) {
  const auto has_place = [](const std::string& word) { return word.find("{}") != std::string::npos; };
  std::vector<std::string> command = submission.command;
  if (!command.empty() && std::ranges::none_of(command, has_place)) return command;
  const bool any_file = !command.empty();
  const auto file = chosen(files_in(copy, [&](const fs::path& one) { return any_file || is_runnable(one); }), name,
                           "program, that is, an executable or a script that begins with #!");
  if (!file) return Failure{file.error()};
  const std::string run = "./" + file->filename().string();
  if (command.empty()) return std::vector<std::string>{run};
  for (std::string& word : command) {
    for (std::size_t at = 0; (at = word.find("{}", at)) != std::string::npos; at += run.size()) {
      word.replace(at, 2, run);
    }
  }
  return command;
}

Result<fs::path, std::string> only_file_with(const fs::path& copy, const std::string& ending) {
  return chosen(files_in(copy, [&](const fs::path& one) { return lowered(one.extension().string()) == ending; }),
                "board", ending + " file");
}

}  // namespace passo
