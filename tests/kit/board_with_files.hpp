// BoardWithFilesOn: a board of the kit with a card, as grblHAL or FluidNC have one: files are sent onto it, listed,
// deleted and run. Inner executes the lines of a file as it would execute those of a host, so a file moves it, and
// holds, resets and errors do what they do. Written after the published sources of grblHAL's plugin for SD cards
// (fs_stream.c) and of FluidNC (InputFile.cpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kit/file_receivers.hpp"
#include "kit/firmware_fakes.hpp"
#include <fmt/format.h>

namespace passo::test {

template <class Inner>
class BoardWithFilesOn {
 public:
  template <class Kind>
  BoardWithFilesOn(Kind kind, bool is_fluidnc)
      : is_fluidnc_(is_fluidnc), receiver_(is_fluidnc), inner_(std::move(kind)) {}

  std::map<std::string, std::string>& files() { return receiver_.files; }
  FileReceiver& receiver() { return receiver_; }
  Inner& inner() { return inner_; }
  std::map<std::string, std::vector<std::string>> answers;  // to further questions
  bool has_card = true;
  int runs = 0;             // files that have begun
  bool interfered = false;  // the host has sent something else than real-time commands while a file ran

  void restart() {
    end_file();
    inner_.restart();
  }
  std::string take_output() { return std::exchange(output_, {}); }
  void run(double seconds) {
    if (receives_) receiver_.run(seconds);
    inner_.run(seconds);
    collect();
    for (int lines = 0; lines < most_lines_of_a_turn && feed(); ++lines) {
      inner_.run(0);
      collect();
    }
  }
  void receive(std::string_view bytes) {
    for (const char byte : bytes) {
      take(byte);
      collect();
    }
  }

 private:
  static constexpr int most_lines_of_a_turn = 50;
  struct RunningFile {
    std::string name;
    std::deque<std::string> lines;
    std::size_t all = 0;
    std::size_t line = 0;
    bool waits = false;  // for the answer to a line
  };

  void take(char byte) {
    if (!is_fluidnc_ && byte == '\x01') receives_ = true;
    if (receives_) {
      receiver_.receive(std::string(1, byte));
      if (byte == '\x18' && !receiver_.is_receiving()) receives_ = has_begun_ = false;  // the host has cancelled it
      return;
    }
    const auto code = static_cast<unsigned char>(byte);
    const bool is_real_time = byte == '?' || byte == '!' || byte == '~' || byte == '\x18' || code >= 0x80;
    if (byte == '\x18') end_file();
    if (is_real_time) return inner_.receive(std::string_view(&byte, 1));
    if (is_running_) {
      interfered = true;
      return;
    }
    if (byte != '\n') {
      line_ += byte;
      return;
    }
    const std::string line = std::exchange(line_, {});
    if (line.starts_with("$Xmodem/Receive=")) {
      receives_ = true;
      return receiver_.receive(line + "\n");
    }
    if (!answer(line)) inner_.receive(line + "\n");
  }
  void say(const std::string& line) { output_ += line + "\r\n"; }
  bool starts(const std::string& line, std::string_view of_grblhal, std::string_view of_fluidnc,
              std::string& path) const {
    const std::string_view head = is_fluidnc_ ? of_fluidnc : of_grblhal;
    if (!line.starts_with(head)) return false;
    path = (is_fluidnc_ ? "/sd" : "") + line.substr(head.size());
    return true;
  }
  bool answer(const std::string& line) {
    if (const auto found = answers.find(line); found != answers.end()) {
      for (const std::string& one : found->second) say(one);
      say("ok");
      return true;
    }
    if (line == "$F+" || line == "$SD/List" || line == "$LocalFS/List") {
      list(line != "$LocalFS/List");
      return true;
    }
    constexpr std::string_view show = "$LocalFS/Show=/";
    if (line.starts_with(show)) {
      const auto found = files().find(line.substr(show.size()));
      output_ += found == files().end() ? "error:61\r\n" : found->second + "\r\nok\r\n";
      return true;
    }
    std::string path;
    if (starts(line, "$FD=", "$SD/Delete=", path)) {
      say(files().erase(path) == 1 ? "ok" : "error:61");
      return true;
    }
    if (!starts(line, "$F=", "$SD/Run=", path)) return false;
    begin(path);
    return true;
  }
  void list(bool of_card) {
    if (of_card && !has_card) return say("error:60");
    for (const auto& [path, content] : files()) {
      const bool is_card = path.starts_with("/sd/");
      if (is_fluidnc_ && is_card != of_card) continue;
      const std::string name = is_fluidnc_ ? " " + (is_card ? path.substr(4) : path) : path;
      say(fmt::format("[FILE:{}|SIZE:{}]", name, content.size()));
    }
    say("ok");
  }

  void begin(const std::string& path) {
    if (!files().contains(path)) return say("error:61");
    end_file();
    file_.name = path.substr(path.rfind('/') + 1);
    std::string line;
    for (const char letter : files()[path]) {
      if (letter == '\n') {
        file_.lines.push_back(std::exchange(line, {}));
      } else if (letter > ' ') {
        line += letter;
      }
    }
    if (!line.empty()) file_.lines.push_back(line);
    file_.all = file_.lines.size();
    is_running_ = true;
    ++runs;
    say("ok");
  }
  void end_file() {
    is_running_ = false;
    file_ = RunningFile();
  }
  // Whether a line was fed.
  bool feed() {
    if (!is_running_ || file_.waits) return false;
    if (file_.lines.empty()) {
      end_file();
      return false;
    }
    inner_.receive(file_.lines.front() + "\n");
    file_.lines.pop_front();
    ++file_.line;
    file_.waits = true;
    return true;
  }

  void collect() {
    const std::string said = receiver_.take_output();
    if (receives_ && (said.ends_with("\x06"
                                     "C")
                          ? ends()
                          : said.ends_with("ok\r\n")))
      receives_ = false;
    output_ += said;
    from_inner_ += inner_.take_output();
    for (std::size_t end = 0; (end = from_inner_.find('\n')) != std::string::npos;) {
      std::string line = from_inner_.substr(0, end + 1);
      from_inner_.erase(0, end + 1);
      if (is_running_) line = of_running(std::move(line));
      output_ += line;
    }
  }
  // What the board makes of a line that Inner says while a file runs.
  std::string of_running(std::string line) {
    if (line.starts_with('<')) {
      const double share =
          100.0 * static_cast<double>(file_.line) / static_cast<double>(std::max<std::size_t>(file_.all, 1));
      line.insert(line.rfind('>'), fmt::format("|SD:{:.1f},{}", std::min(share, 99.9), file_.name));
      return line;
    }
    if (line.starts_with("ok")) {
      file_.waits = false;
      return {};
    }
    if (!line.starts_with("error:")) return line;
    const std::string number = line.substr(6, line.find('\r') - 6);
    const std::string told =
        is_fluidnc_ ? fmt::format("[MSG:ERR: {} (wrong) in /sd/{} at line {}]\r\n", number, file_.name, file_.line)
                    : fmt::format("error:{} in SD file at line {}\r\n{}", number, file_.line, line);
    end_file();
    return told;
  }
  // grblHAL says the same after the header and at the end.
  bool ends() { return std::exchange(has_begun_, !has_begun_); }

  bool is_fluidnc_;
  bool receives_ = false;
  bool has_begun_ = false;
  FileReceiver receiver_;
  Inner inner_;
  std::string line_;
  bool is_running_ = false;
  RunningFile file_;
  std::string from_inner_;
  std::string output_;
};

using BoardWithFiles = BoardWithFilesOn<FirmwareFake>;

}  // namespace passo::test
