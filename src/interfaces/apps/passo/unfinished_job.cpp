#include "unfinished_job.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <vector>

#include "program_input.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// "2-isolate-front.ngc": a program of a job, or its picture. Of an earlier job it would be taken for one of this job.
bool is_of_a_job(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t dash = stem.find_first_not_of("0123456789");
  const fs::path kind = file.extension();
  if (dash == 0 || dash == std::string::npos || (kind != ".ngc" && kind != ".svg" && kind != ".png")) return false;
  constexpr std::array<std::string_view, 15> names = {
      "-dowels",       "-top",        "-bottom",        "-drill",         "-isolate-front",
      "-isolate-back", "-outline",    "-heights-front", "-heights-back",  "-find-holes",
      "-flip",         "-mask-front", "-mask-back",     "-stencil-front", "-stencil-back"};
  return std::ranges::find(names, std::string_view(stem).substr(dash)) != names.end();
}

std::vector<fs::path> files_in(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> files;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    files.push_back(at->path());
  }
  return files;
}

}  // namespace

UnfinishedJob::~UnfinishedJob() {
  if (!is_begun_) return;
  std::error_code none;
  fs::remove_all(made_, none);
  if (is_new_) fs::remove(folder_, none);  // if nothing is in it
}

int UnfinishedJob::begin() {
  std::error_code error;
  is_begun_ = true;
  is_new_ = fs::create_directories(folder_, error);
  if (!error) fs::remove_all(made_, error);
  if (!error) fs::create_directory(made_, error);
  return error ? fail(exit_failed, folder_.string() + ": " + error.message()) : exit_done;
}

int UnfinishedJob::finish() {
  std::error_code error;
  for (const fs::path& file : files_in(folder_, error)) {
    if (!error && is_of_a_job(file)) fs::remove(file, error);
  }
  if (!error) {
    for (const fs::path& file : files_in(made_, error)) {
      if (!error) fs::rename(file, folder_ / file.filename(), error);
    }
  }
  return error ? fail(exit_failed, folder_.string() + ": " + error.message()) : exit_done;
}

}  // namespace passo
