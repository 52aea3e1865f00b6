#include "passo/sender/file_upload.hpp"

#include <algorithm>
#include <utility>

#include <boost/crc.hpp>
#include <fmt/format.h>

#include "passo/sender/board_files.hpp"

namespace passo {
namespace {

constexpr char soh = 0x01;  // begins a packet of 128 bytes
constexpr char stx = 0x02;  // 1,024 bytes
constexpr char eot = 0x04;
constexpr char ack = 0x06;
constexpr char nak = 0x15;
constexpr char can = 0x18;
constexpr char padding = 0x1A;

// grblHAL's buffer of a connection may be no longer than 1,024 bytes, so its packets are short.
constexpr std::size_t ymodem_size = 128;
// FluidNC writes packets correctly only if all have the same size.
constexpr std::size_t xmodem_size = 1024;
constexpr std::size_t longest_ymodem_name = 31;
constexpr std::size_t longest_line = 200;
constexpr int most_tries = 10;
constexpr Seconds longest_start{30};
constexpr Seconds longest_acknowledgement{5};

std::string with_crc(std::string data) {
  boost::crc_xmodem_t crc;
  crc.process_bytes(data.data(), data.size());
  const unsigned value = crc.checksum();
  data += static_cast<char>(value >> 8);
  data += static_cast<char>(value & 255);
  return data;
}

}  // namespace

Result<FileUpload, std::string> FileUpload::begin(const GrblMachine& machine, const std::string& path,
                                                  std::string content) {
  const auto files = BoardFiles::of(machine);
  if (!files) return Failure{files.error()};
  auto command = files->upload_line(path);
  if (!command) return Failure{command.error()};
  if (content.size() > most_bytes) return Failure{std::string("expected a file of at most 64 MiB")};
  if (!files->is_fluidnc()) {
    if (!machine.has_option("YM")) {
      return Failure{
          std::string("its grblHAL was built without YMODEM: copy the file to the card, or use its FTP server")};
    }
    if (path.size() > longest_ymodem_name) return Failure{std::string("expected a name of at most 31 characters")};
    return FileUpload("", path, std::move(content));
  }
  // XMODEM does not tell the size: padding at the end is removed.
  if (content.ends_with(padding)) return Failure{std::string("expected a file that does not end with Ctrl-Z")};
  return FileUpload(*command + "\n", path, std::move(content));
}

double FileUpload::share() const {
  return content_.empty() ? (ended() ? 1 : 0) : static_cast<double>(sent_) / static_cast<double>(content_.size());
}

void FileUpload::enter(Stage stage, Seconds now) {
  stage_ = stage;
  tries_ = 0;
  since_ = now;
}

void FileUpload::fail(std::string words) {
  trouble_ = std::move(words);
  ready_.assign(8, can);
  stage_ = Stage::ended;
}

void FileUpload::cancel() {
  if (!ended()) fail("the upload was interrupted");
}

// A packet has its number and its complement, so that a repeated one is recognised.
std::string FileUpload::packet() const {
  const std::size_t size = is_ymodem() ? ymodem_size : xmodem_size;
  std::string data;
  if (stage_ == Stage::header) {
    data = name_ + '\0' + std::to_string(content_.size()) + '\0';
    data.resize(ymodem_size, '\0');
  } else {
    data = content_.substr(sent_, size);
    data.resize(size, padding);
  }
  std::string bytes{is_ymodem() ? soh : stx, static_cast<char>(number_), static_cast<char>(~number_)};
  return bytes + with_crc(std::move(data));
}

void FileUpload::send_packet(Seconds now) {
  since_ = now;
  if (++tries_ > most_tries) return fail("the board did not acknowledge a part of the file");
  ready_ = stage_ == Stage::end ? std::string(1, eot) : packet();
}

std::string FileUpload::take_bytes(Seconds now) {
  switch (stage_) {
    case Stage::begins:
      enter(is_ymodem() ? Stage::header : Stage::waits, now);
      ready_ = command_;
      if (is_ymodem()) send_packet(now);
      break;
    case Stage::waits:
      if (now - since_ > longest_start) fail("the board did not begin to receive the file");
      break;
    case Stage::header:
    case Stage::data:
    case Stage::end:
      if (now - since_ > longest_acknowledgement) send_packet(now);
      break;
    case Stage::closes:
      if (now - since_ > longest_acknowledgement) fail("the board did not confirm the file");
      break;
    case Stage::ended: break;
  }
  return std::exchange(ready_, {});
}

void FileUpload::receive(std::string_view bytes, Seconds now) {
  for (const char byte : bytes) {
    if (!ended()) hear(byte, now);
  }
}

void FileUpload::acknowledge(Seconds now) {
  switch (stage_) {
    case Stage::header: break;
    case Stage::data: sent_ = std::min(content_.size(), sent_ + (is_ymodem() ? ymodem_size : xmodem_size)); break;
    // FluidNC says a line then.
    case Stage::end: return enter(is_ymodem() ? Stage::ended : Stage::closes, now);
    default: return;
  }
  ++number_;
  enter(sent_ < content_.size() ? Stage::data : Stage::end, now);
  send_packet(now);
}

// Lines of text come in between: "[MSG:INFO: Cannot open …]" has a C that asks for nothing.
void FileUpload::hear(char byte, Seconds now) {
  cancels_ = byte == can ? cancels_ + 1 : 0;
  const bool waits = stage_ == Stage::waits;
  if (cancels_ >= 2 || (waits && byte == can))
    return fail("the board refuses the file: no card, no room, or a wrong name");
  if (line_.empty()) {
    if (byte == ack) return acknowledge(now);
    if (byte == nak && !waits && stage_ != Stage::closes) return send_packet(now);
    if (byte == 'C' && waits) {
      number_ = 1;
      enter(content_.empty() ? Stage::end : Stage::data, now);
      return send_packet(now);
    }
    if (byte == 'C' && stage_ != Stage::closes) return;
  }
  if (byte != '\n' && byte != '\r') {
    if (byte >= ' ' && line_.size() < longest_line) line_ += byte;
    return;
  }
  const std::string line = std::exchange(line_, {});
  if (line.starts_with("error:")) return fail(fmt::format("the board refuses the file: {}", line));
  if (line == "ok" && stage_ == Stage::closes) stage_ = Stage::ended;
}

}  // namespace passo
