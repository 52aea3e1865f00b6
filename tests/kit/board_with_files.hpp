// BoardWithFiles: a FirmwareFake of grblHAL or FluidNC with a card, onto which files are sent, and from which they are
// run. Written after the published sources of grblHAL's SD card plugin and of FluidNC.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kit/file_receivers.hpp"
#include "kit/firmware_fakes.hpp"
#include <fmt/format.h>

namespace passo::test {

class BoardWithFiles {
 public:
  BoardWithFiles(FirmwareTraits traits, bool is_fluidnc)
      : is_fluidnc_(is_fluidnc), receiver_(is_fluidnc), fake_(std::move(traits)) {}

  std::map<std::string, std::string>& files() { return receiver_.files; }
  double run_time = 1;  // of each file, s

  void restart() { fake_.restart(); }
  std::string take_output() { return std::exchange(output_, {}); }
  void run(double seconds) {
    if (receives_) receiver_.run(seconds);
    fake_.run(seconds);
    left_ = std::max(0.0, left_ - seconds);
    collect();
  }
  void receive(std::string_view bytes) {
    for (const char byte : bytes) {
      take(byte);
      collect();
    }
  }

 private:
  void take(char byte) {
    if (!is_fluidnc_ && byte == '\x01') receives_ = true;
    if (receives_) return receiver_.receive(std::string(1, byte));
    if (byte == '?' && left_ > 0) {
      output_ +=
          fmt::format("<Run|MPos:0.000,0.000,0.000|FS:0,0|SD:{:.1f},{}>\r\n", 100 * (1 - left_ / run_time), name_);
      return;
    }
    if (byte != '\n') {
      const auto code = static_cast<unsigned char>(byte);
      if (byte == '\x18') left_ = 0;
      if (code >= ' ' && code < 0x7F && byte != '?' && byte != '!' && byte != '~') {
        line_ += byte;
        return;
      }
      return fake_.receive(std::string_view(&byte, 1));
    }
    const std::string line = std::exchange(line_, {});
    if (line.starts_with("$Xmodem/Receive=")) {
      receives_ = true;
      return receiver_.receive(line + "\n");
    }
    if (!answer(line)) fake_.receive(line + "\n");
  }
  // The list, and the start of a file.
  bool answer(const std::string& line) {
    if (line == "$F+" || line == "$SD/List" || line == "$LocalFS/List") {
      for (const auto& [path, content] : files()) {
        const bool is_card = path.starts_with("/sd/");
        if (is_fluidnc_ && is_card != (line == "$SD/List")) continue;
        const std::string name = is_fluidnc_ ? " " + (is_card ? path.substr(4) : path) : path;
        output_ += fmt::format("[FILE:{}|SIZE:{}]\r\n", name, content.size());
      }
      output_ += "ok\r\n";
      return true;
    }
    constexpr std::string_view show = "$LocalFS/Show=/";
    if (line.starts_with(show)) {
      const auto found = files().find(line.substr(show.size()));
      output_ += found == files().end() ? "error:61\r\n" : found->second + "\r\nok\r\n";
      return true;
    }
    const std::string_view run = is_fluidnc_ ? "$SD/Run=" : "$F=";
    if (!line.starts_with(run)) return false;
    const std::string path = (is_fluidnc_ ? "/sd" : "") + line.substr(run.size());
    if (!files().contains(path)) {
      output_ += "error:61\r\n";
      return true;
    }
    name_ = path.substr(path.rfind('/') + 1);
    left_ = run_time;
    output_ += "ok\r\n";
    return true;
  }
  void collect() {
    const std::string said = receiver_.take_output();
    if (receives_ && (said.ends_with("\x06"
                                     "C")
                          ? ends()
                          : said.ends_with("ok\r\n")))
      receives_ = false;
    output_ += said + fake_.take_output();
  }
  // grblHAL says the same after the header and at the end.
  bool ends() { return std::exchange(has_begun_, !has_begun_); }

  bool is_fluidnc_;
  bool receives_ = false;
  bool has_begun_ = false;
  FileReceiver receiver_;
  FirmwareFake fake_;
  std::string line_;
  std::string name_;
  double left_ = 0;
  std::string output_;
};

}  // namespace passo::test
