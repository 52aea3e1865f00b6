// The receivers of files of grblHAL and FluidNC, byte by byte, written after their published sources (ymodem.c of
// grblHAL's SD card plugin, xmodem.cpp of FluidNC). Their public variables script a bad connection.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace passo::test {

// As the polynomial division is defined, bit by bit.
inline unsigned xmodem_crc(const std::string& data) {
  unsigned crc = 0;
  for (const char byte : data) {
    for (int bit = 7; bit >= 0; --bit) {
      const bool is_one = ((crc >> 15 ^ static_cast<unsigned char>(byte) >> bit) & 1U) != 0;
      crc = crc << 1 & 0xFFFF;
      if (is_one) crc ^= 0x1021;
    }
  }
  return crc;
}

class FileReceiver {
 public:
  explicit FileReceiver(bool is_fluidnc) : is_fluidnc_(is_fluidnc) {}

  std::map<std::string, std::string> files;
  std::function<void(std::string& packet)> disturb = {};  // before it is read
  bool refuses = false;                                   // it cannot open the file
  std::string command;                                    // the line that began the upload

  std::string take_output() { return std::exchange(output_, {}); }
  bool is_receiving() const { return receives_; }
  void receive(const std::string& bytes) {
    for (const char byte : bytes) take(byte);
  }
  // Time passes.
  void run(double seconds) {
    idle_ += seconds;
    if (is_fluidnc_ && receives_ && number_ == 1 && packet_.empty() && idle_ >= 1) {
      output_ += 'C';
      idle_ = -1;  // then every two seconds
    } else if (receives_ && !packet_.empty() && idle_ >= 1) {
      packet_.clear();
      output_ += '\x15';
      idle_ = 0;
    }
  }

 private:
  void take(char byte) {
    idle_ = 0;
    if (is_fluidnc_ && !receives_) {
      if (byte != '\n') {
        line_ += byte;
        return;
      }
      command = std::exchange(line_, {});
      name_ = command.substr(command.find('=') + 1);
      if (refuses) {
        output_ += "\x18[MSG:INFO: Cannot open " + name_ + "]\r\nerror:70\r\n";
        return;
      }
      receives_ = true;
      number_ = 1;
      held_.reset();
      return;
    }
    if (packet_.empty() && byte == '\x04') return end();
    if (packet_.empty() && byte == '\x18') receives_ = false;
    if (packet_.empty() && byte != '\x01' && byte != '\x02') return;
    if (!std::exchange(receives_, true)) {
      number_ = 0;
      has_header_ = false;
    }
    packet_ += byte;
    const std::size_t size = packet_[0] == '\x01' ? 128 : 1024;
    if (packet_.size() < size + 5) return;
    std::string packet = std::exchange(packet_, {});
    if (disturb) disturb(packet);
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(packet[i]); };
    const std::string data = packet.substr(3, size);
    const bool good = packet.size() == size + 5 && (at(1) ^ at(2)) == 255 &&
                      xmodem_crc(data) == (unsigned{at(size + 3)} << 8 | at(size + 4));
    if (!good) {
      output_ += '\x15';
    } else if (at(1) == static_cast<std::uint8_t>(number_ - 1)) {
      output_ += '\x06';  // repeated: its acknowledgement was lost
    } else if (at(1) == number_) {
      ++number_;
      is_fluidnc_ ? hold(data) : write(data);
    }
  }
  // FluidNC holds a packet back, and writes it with the size of the next one.
  void hold(const std::string& data) {
    if (held_) files[name_] += held_->substr(0, data.size());
    held_ = std::make_unique<std::string>(data);
    output_ += '\x06';
  }
  void write(const std::string& data) {
    if (std::exchange(has_header_, true)) {
      const std::size_t left = size_ - files[name_].size();
      files[name_] += data.substr(0, left);
      output_ += '\x06';
      return;
    }
    if (refuses) {
      output_ += "\x18\x18";
      receives_ = false;
      return;
    }
    name_ = data.c_str();
    size_ = std::stoul(data.c_str() + name_.size() + 1);
    files[name_].clear();
    output_ +=
        "\x06"
        "C";
  }
  void end() {
    if (!receives_) return;
    receives_ = false;
    output_ += '\x06';
    if (!is_fluidnc_) {
      output_ += 'C';
      return;
    }
    std::string& file = files[name_];
    if (held_) file += *held_;
    while (!file.empty() && file.back() == '\x1A') file.pop_back();
    output_ += "[MSG:INFO: Received " + std::to_string(file.size()) + " bytes to file " + name_ + "]\r\nok\r\n";
  }

  bool is_fluidnc_;
  bool receives_ = false;
  bool has_header_ = false;  // of YMODEM
  std::uint8_t number_ = 0;
  std::string line_;
  std::string packet_;
  std::string name_;
  std::size_t size_ = 0;
  std::unique_ptr<std::string> held_;
  std::string output_;
  double idle_ = 0;
};

}  // namespace passo::test
