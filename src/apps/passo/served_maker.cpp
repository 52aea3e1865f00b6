#include "served_maker.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// Names that no uploaded file has: those begin with no dot.
constexpr const char* made_folder = ".made";
constexpr const char* said_file = ".said";
constexpr std::size_t longest_words = 8000;

std::string picture_file(const std::string& job) {
  return std::string(made_folder) + (job == "relief" ? "/picture.png" : "/picture.svg");
}

// The name stands in the program and in its picture.
std::string program_file(const std::string& name) {
  return std::string(made_folder) + "/" + name;
}

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void limit(decltype(RLIMIT_CPU) what, rlim_t most) {
  const rlimit bound{most, most};
  setrlimit(what, &bound);
}

// In the process of the order. It keeps none of the server's files and lines.
[[noreturn]] void become(const std::string& folder, const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the server, which ends this process
  std::signal(SIGTERM, SIG_DFL);
  if (chdir(folder.c_str()) != 0) _exit(127);
  const int said = open(said_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, 0);
  dup2(nothing, 1);
  dup2(said, 2);
  close_range(3, ~0U, 0);
  limit(RLIMIT_CPU, ServedMaker::most_time);
  limit(RLIMIT_AS, ServedMaker::most_memory);
  limit(RLIMIT_FSIZE, ServedMaker::most_bytes * 4);
  setpriority(PRIO_PROCESS, 0, 19);
  execv("/proc/self/exe", pointers.data());
  _exit(127);
}

std::string words_of_end(int status) {
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    return "it took too long, and was ended";
  }
  return "it has failed";
}

}  // namespace

ServedMaker::~ServedMaker() {
  clear();
}

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
  if (folder_.empty()) {
    std::error_code none;
    std::string made = (fs::temp_directory_path(none) / "passo-make-XXXXXX").string();
    if (mkdtemp(made.data()) == nullptr) return false;
    folder_ = made;
  }
  std::ofstream out(path(name), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) return false;
  if (same != kept_.end()) {
    same->bytes = bytes.size();
  } else {
    kept_.push_back({name, bytes.size()});
  }
  return true;
}

void ServedMaker::end_process() {
  if (process_ == 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = 0;
}

void ServedMaker::clear() {
  end_process();
  std::error_code none;
  if (!folder_.empty()) fs::remove_all(folder_, none);
  folder_.clear();
  kept_.clear();
  result_ = {};
}

bool ServedMaker::begin(const MakeOrder& order) {
  if (process_ != 0 || folder_.empty()) return false;
  std::error_code none;
  fs::remove_all(path(made_folder), none);
  fs::create_directory(path(made_folder), none);
  const std::string picture = picture_file(order.job);
  const std::string name = fs::path(order.files.front()).stem().string() + "-" + order.job + ".ngc";
  const std::string program = program_file(name);
  std::vector<std::string> words = {"passo", "cam", order.job};
  words.insert(words.end(), order.options.begin(), order.options.end());
  for (const std::string& word :
       {std::string("--output"), program, std::string("--picture"), picture, std::string("--")}) {
    words.push_back(word);
  }
  words.insert(words.end(), order.files.begin(), order.files.end());
  const pid_t process = fork();
  if (process == 0) become(folder_, words);
  if (process < 0) return false;
  process_ = process;
  result_ = {.state = MakeResult::State::running, .job = order.job, .name = name, .words = {}, .picture_type = {}};
  return true;
}

const MakeResult& ServedMaker::look() {
  int status = 0;
  if (process_ == 0 || waitpid(process_, &status, WNOHANG) != process_) return result_;
  process_ = 0;
  result_.words = content_of(path(said_file)).substr(0, longest_words);
  std::error_code none;
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0 && fs::exists(path(program_file(result_.name)), none);
  result_.state = good ? MakeResult::State::done : MakeResult::State::failed;
  if (!good && result_.words.empty()) result_.words = words_of_end(status);
  if (good && fs::exists(path(picture_file(result_.job)), none)) {
    result_.picture_type = result_.job == "relief" ? "image/png" : "image/svg+xml";
  }
  return result_;
}

std::string ServedMaker::program() const {
  return content_of(path(program_file(result_.name)));
}

std::string ServedMaker::picture() const {
  return content_of(path(picture_file(result_.job)));
}

}  // namespace passo
