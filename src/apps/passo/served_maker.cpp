#include "served_maker.hpp"

#include <algorithm>
#include <filesystem>

#include <sys/wait.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// A name that no uploaded file has: those begin with no dot.
constexpr const char* made_folder = ".made";

std::string picture_file(const std::string& job) {
  return std::string(made_folder) + (job == "relief" ? "/picture.png" : "/picture.svg");
}

// The name stands in the program and in its picture.
std::string program_file(const std::string& name) {
  return std::string(made_folder) + "/" + name;
}

}  // namespace

std::vector<std::string> ServedMaker::files() const {
  std::vector<std::string> names;
  for (const Kept& one : kept_) names.push_back(one.name);
  return names;
}

bool ServedMaker::keep(const std::string& name, std::string_view bytes) {
  std::size_t all = bytes.size();
  for (const Kept& one : kept_) all += one.name == name ? 0 : one.bytes;
  const auto same = std::ranges::find(kept_, name, &Kept::name);
  if (all > most_bytes || (same == kept_.end() && kept_.size() >= most_files)) return false;
  if (!folder_.make() || !write_content(folder_.path(name), bytes)) return false;
  if (same != kept_.end()) {
    same->bytes = bytes.size();
  } else {
    kept_.push_back({name, bytes.size()});
  }
  return true;
}

void ServedMaker::clear() {
  process_.end();
  folder_.remove();
  kept_.clear();
  result_ = {};
}

bool ServedMaker::begin(const MakeOrder& order) {
  if (process_.runs() || !folder_.make()) return false;
  std::error_code none;
  fs::remove_all(folder_.path(made_folder), none);
  fs::create_directory(folder_.path(made_folder), none);
  const std::string picture = picture_file(order.job);
  // A text to engrave has no file.
  const std::string stem = order.files.empty() ? "text" : fs::path(order.files.front()).stem().string();
  const std::string name = stem + "-" + order.job + ".ngc";
  const std::string program = program_file(name);
  std::vector<std::string> words = {"passo", "cam", order.job};
  words.insert(words.end(), order.options.begin(), order.options.end());
  for (const std::string& word :
       {std::string("--output"), program, std::string("--picture"), picture, std::string("--")}) {
    words.push_back(word);
  }
  words.insert(words.end(), order.files.begin(), order.files.end());
  if (!process_.begin(folder_.name(), words)) return false;
  result_ = {.state = MakeResult::State::running, .job = order.job, .name = name, .words = {}, .picture_type = {}};
  return true;
}

const MakeResult& ServedMaker::look() {
  const std::optional<int> end = process_.look();
  if (!end) return result_;
  result_.words = content_of(folder_.path(LowProcess::said_file)).substr(0, LowProcess::longest_words);
  std::error_code none;
  const bool good =
      WIFEXITED(*end) && WEXITSTATUS(*end) == 0 && fs::exists(folder_.path(program_file(result_.name)), none);
  result_.state = good ? MakeResult::State::done : MakeResult::State::failed;
  if (!good && result_.words.empty()) result_.words = words_of_end(*end);
  if (good && fs::exists(folder_.path(picture_file(result_.job)), none)) {
    result_.picture_type = result_.job == "relief" ? "image/png" : "image/svg+xml";
  }
  return result_;
}

std::string ServedMaker::program() const {
  return content_of(folder_.path(program_file(result_.name)));
}

std::string ServedMaker::picture() const {
  return content_of(folder_.path(picture_file(result_.job)));
}

}  // namespace passo
