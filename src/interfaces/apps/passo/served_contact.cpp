#include "served_contact.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "port_words.hpp"
#include "state_folder.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "passo/report/output_file.hpp"
#include "passo/transport/serial_ports.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// A word for a POSIX shell.
std::string quoted(const std::string& word) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./:@+=").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string ServedContact::ports() {
  const auto now = Clock::now();
  if (list_.empty() || now - listed_ >= between_lists) {
    list_ = to_json(list_serial_ports(arguments_.system)).dump();
    listed_ = now;
  }
  return list_;
}

bool ServedContact::begin(const std::string& device, const std::string& board) {
  if (process_.runs()) return false;
  result_ = {.device = device, .board = board};
  folder_.remove();
  if (!folder_.make()) return false;
  if (!process_.begin(folder_.name(), {"passo", "machine", "--from", result_.board, "--json"})) return false;
  begun_ = Clock::now();
  listed_ = {};  // the port is in use now
  result_.state = ContactResult::State::running;
  return true;
}

const ContactResult& ServedContact::result() {
  if (result_.state != ContactResult::State::running) return result_;
  const std::optional<int> end = process_.poll();
  if (!end && Clock::now() - begun_ < longest_contact) return result_;
  listed_ = {};
  result_.state = ContactResult::State::failed;
  if (!end) {
    process_.end();
    result_.words = fmt::format("the board did not answer within {} s", longest_contact.count());
    return result_;
  }
  result_.words = content_of(folder_.path(BackgroundProcess::said_file)).substr(0, BackgroundProcess::longest_words);
  result_.report = content_of(folder_.path(BackgroundProcess::printed_file));
  const bool good = WIFEXITED(*end) && WEXITSTATUS(*end) == 0 && result_.report.starts_with("{");
  if (good) result_.state = ContactResult::State::done;
  if (!good && result_.words.empty()) result_.words = words_of_end(*end);
  return result_;
}

std::string ServedContact::folder_of_machines() const {
  const std::string folder = arguments_.data.empty() ? state_folder() : arguments_.data;
  std::error_code none;
  return folder.empty() ? folder : (fs::absolute(folder, none) / "machines").string();
}

bool ServedContact::keeps(const std::string& name) const {
  std::error_code none;
  return fs::exists(fs::path(folder_of_machines()) / name, none);
}

// As this server was started, with another machine.
std::string ServedContact::command_with(const std::string& machine) const {
  std::vector<std::string> words{"passo", "serve", "--machine", machine};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--board", result_.board);
  add("--http", arguments_.http);
  add("--http-token", arguments_.http_token);
  for (const std::string& name : arguments_.http_names) add("--http-name", name);
  add("--data", arguments_.data);
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

Result<KeptMachine, std::string> ServedContact::keep(const std::string& name, const std::string& text) {
  const std::string folder = folder_of_machines();
  if (folder.empty()) return Failure<std::string>{"there is no folder for it: start passo serve with --data DIR"};
  std::error_code error;
  fs::create_directories(folder, error);
  const std::string path = (fs::path(folder) / name).string();
  auto file = OutputFile::open(path);
  if (!file) return Failure<std::string>{file.error().message};
  file->write(text);
  if (const auto done = file->commit(); !done) return Failure<std::string>{done.error().message};
  return KeptMachine{.path = path, .command = command_with(path)};
}

}  // namespace passo
