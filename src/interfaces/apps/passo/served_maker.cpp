#include "served_maker.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "commands.hpp"
#include "part_job_record.hpp"
#include <sys/wait.h>

#include "passo/operations/cam_operation.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// A name that no uploaded file has: those begin with no dot.
constexpr const char* made_folder = ".made";
constexpr const char* board_profile = ".made/profile.toml";
constexpr const char* board_machine = ".made/machine.toml";
constexpr const char* shapes_folder = ".shapes";
constexpr std::string_view board_job = "board";
constexpr std::string_view part_job = "job";  // its file names other files

std::string picture_file(const std::string& job) {
  return std::string(made_folder) + (job == board_job ? "/board" : "/picture") +
         find_cam_operation(job)->picture_ending;
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
  if (!folder_.make()) return false;
  // Whoever reads the file meanwhile sees all of the old one or all of the new one. Names that are kept begin with no
  // dot.
  const std::string temporary = folder_.path(".new");
  std::error_code failed;
  const bool is_written = write_content(temporary, bytes);
  if (is_written) fs::rename(temporary, folder_.path(name), failed);
  if (!is_written || failed) {
    fs::remove(temporary, failed);
    return false;
  }
  forget_reading(name);
  if (same != kept_.end()) {
    *same = {.name = name, .bytes = bytes.size()};
  } else {
    kept_.push_back({name, bytes.size()});
  }
  return true;
}

std::vector<ServedMaker::Kept>::const_iterator ServedMaker::find(const std::string& name) const {
  return std::ranges::find(kept_, name, &Kept::name);
}

std::optional<std::string> ServedMaker::content(const std::string& name, std::size_t most) const {
  const auto found = find(name);
  if (found == kept_.end() || found->bytes > most) return std::nullopt;
  return content_of(folder_.path(name));
}

std::string ServedMaker::folder() const {
  return folder_.name() + "/";
}

CamShapes ServedMaker::shapes(const std::string& name) {
  poll_shapes();
  const auto found = find(name);
  if (found == kept_.end()) return {.state = CamResult::State::failed};
  if (found->shapes.state != CamResult::State::none || reader_.runs()) return found->shapes;
  std::error_code none;
  fs::create_directory(folder_.path(shapes_folder), none);
  read_name_ = name;
  const bool begun =
      reader_.begin(folder_.path(shapes_folder), {"passo", "cam", "show", "--shapes", "--", "../" + name});
  return {.state = begun ? CamResult::State::running : CamResult::State::failed};
}

void ServedMaker::poll_shapes() {
  const std::optional<int> end = reader_.poll();
  const auto found = std::ranges::find(kept_, read_name_, &Kept::name);
  if (!end || found == kept_.end()) return;
  constexpr std::uintmax_t longest = std::uintmax_t{16} << 20;
  const std::string folder = folder_.path(shapes_folder) + "/";
  std::error_code none;
  const bool good = WIFEXITED(*end) && WEXITSTATUS(*end) == exit_done &&
                    fs::file_size(folder + BackgroundProcess::printed_file, none) <= longest;
  CamShapes& shapes = found->shapes;
  shapes.state = good ? CamResult::State::done : CamResult::State::failed;
  shapes.words = content_of(folder + BackgroundProcess::said_file).substr(0, BackgroundProcess::longest_words);
  if (good) shapes.json = content_of(folder + BackgroundProcess::printed_file);
  if (!good && shapes.words.empty()) shapes.words = words_of_end(*end);
}

void ServedMaker::forget_reading(const std::string& name) {
  if (name != read_name_) return;
  reader_.end();
  read_name_.clear();
}

bool ServedMaker::remove(const std::string& name) {
  const auto found = find(name);
  if (found == kept_.end()) return false;
  forget_reading(name);
  std::error_code none;
  fs::remove(folder_.path(name), none);
  kept_.erase(found);
  return true;
}

void ServedMaker::clear() {
  process_.end();
  reader_.end();
  read_name_.clear();
  folder_.remove();
  kept_.clear();
  result_ = {};
}

bool ServedMaker::begin(const CamOrder& order) {
  if (process_.runs() || !folder_.make()) return false;
  std::error_code none;
  fs::remove_all(folder_.path(made_folder), none);
  fs::create_directory(folder_.path(made_folder), none);
  // A text to engrave has no file.
  stem_ = order.files.empty() ? "text" : fs::path(order.files.front()).stem().string();
  std::vector<std::string> words = {"passo", "cam", order.job};
  words.insert(words.end(), order.options.begin(), order.options.end());
  result_ = {.state = CamResult::State::running, .job = order.job};
  made_.clear();
  const auto failed = [this] {
    result_ = {};
    return false;
  };
  const auto add_file = [&](const char* option, const char* name, const std::string& text) {
    words.insert(words.end(), {option, name});
    return write_content(folder_.path(name), text);
  };
  const auto is_two_sided = [](const std::string& option) {
    return option.starts_with("--two-sided=") && option != "--two-sided=no";
  };
  makes_folder_ = order.job == board_job || std::ranges::any_of(order.options, is_two_sided);
  if (makes_folder_) words.insert(words.end(), {"--output", made_folder});
  if (order.job == board_job) {
    words.emplace_back("--json");
    if (!order.profile.empty() && !add_file("--profile", board_profile, order.profile)) return failed();
    if (!order.machine.empty() && !add_file("--machine", board_machine, order.machine)) return failed();
  } else if (!makes_folder_) {
    result_.names = {stem_ + "-" + order.job + ".ngc"};
    made_ = {program_file(result_.names.front())};
    words.insert(words.end(), {"--output", made_.front(), "--picture", picture_file(order.job)});
    if (!order.machine.empty() && !add_file("--limits", board_machine, order.machine)) return failed();
    if (order.job == part_job) words.emplace_back("--only-folder");
    // Only one program is returned.
    if (order.job == "profile") words.emplace_back("--most-sheets=1");
  }
  words.emplace_back("--");
  words.insert(words.end(), order.files.begin(), order.files.end());
  return process_.begin(folder_.name(), words) || failed();
}

const CamResult& ServedMaker::result() {
  const std::optional<int> end = process_.poll();
  if (process_.runs()) result_.progress = process_.percent() / 100.0;
  if (!end) return result_;
  result_.words = content_of(folder_.path(BackgroundProcess::said_file)).substr(0, BackgroundProcess::longest_words);
  // A program that leaves nets joined is written, and the words tell it, but the command fails.
  const bool may_join = result_.job == board_job || result_.job == "isolate";
  const int code = WIFEXITED(*end) ? WEXITSTATUS(*end) : -1;
  bool good = code == exit_done || (code == exit_failed && may_join);
  if (makes_folder_) poll_folder();
  if (result_.job == part_job)
    result_.report = content_of(folder_.path(record_file_of(program_file(result_.names.front()))));
  std::error_code none;
  good = good && !made_.empty() && fs::exists(folder_.path(made_.front()), none);
  result_.state = good ? CamResult::State::done : CamResult::State::failed;
  if (!good && result_.words.empty()) result_.words = words_of_end(*end);
  if (!good) result_.names.clear();
  if (good) result_.progress = 1;
  result_.has_page = good && makes_folder_;
  if (good && fs::exists(folder_.path(picture_file(result_.job)), none)) {
    result_.picture_type = picture_file(result_.job).ends_with(".png") ? "image/png" : "image/svg+xml";
  }
  return result_;
}

// The programs are numbered: "2-isolate-front.ngc".
void ServedMaker::poll_folder() {
  if (result_.job == board_job) result_.report = content_of(folder_.path(BackgroundProcess::printed_file));
  std::error_code none;
  std::vector<std::pair<int, std::string>> found;
  for (fs::directory_iterator at(folder_.path(made_folder), none), end; !none && at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    if (at->path().extension() == ".ngc") found.emplace_back(std::atoi(name.c_str()), name);
  }
  std::ranges::sort(found);
  for (const auto& [number, name] : found) {
    made_.push_back(program_file(name));
    result_.names.push_back(stem_ + "-" + name);
  }
}

std::string ServedMaker::program(std::size_t number) const {
  return number < made_.size() ? content_of(folder_.path(made_[number])) : std::string();
}

std::string ServedMaker::picture(std::optional<std::size_t> number) const {
  if (!number) return content_of(folder_.path(picture_file(result_.job)));
  if (*number >= made_.size()) return {};
  return content_of(folder_.path(fs::path(made_[*number]).replace_extension(".svg").string()));
}

std::string ServedMaker::page() const {
  return content_of(folder_.path(std::string(made_folder) + "/" + result_.job + ".html"));
}

}  // namespace passo
