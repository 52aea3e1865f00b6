// FileUpload: sends one file to a board over the connection that also carries the lines: by YMODEM to grblHAL, by
// XMODEM-1K with CRC to FluidNC.
//
//   while (!upload.ended()) { send(upload.take_bytes(now)); upload.receive(bytes, now); }
//
// Meanwhile nothing else may be sent: a `?` would be a byte of the file. Each packet has a checksum and is repeated
// until the board has acknowledged it, so the file arrives as it is, or the upload ends with trouble().
//
// Like GrblSender, this class uses no sockets and no clock.
// Source: C. Forsberg, "XMODEM/YMODEM Protocol Reference" (1988); grblHAL's ymodem.c begins without the initial C of
// the receiver, and ends without the empty packet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "passo/base/result.hpp"
#include "passo/sender/grbl_machine.hpp"
#include "passo/session/board_storage.hpp"
#include "passo/units/units.hpp"

namespace passo {

class FileUpload {
 public:
  static constexpr std::size_t most_bytes = BoardStorage::most_bytes;

  // `path`: where the board stores the file, as BoardFiles lists it. The error is a clause.
  static Result<FileUpload, std::string> begin(const GrblMachine& machine, const std::string& path,
                                               std::string content);

  // Returns what to send now.
  std::string take_bytes(Seconds now);
  void receive(std::string_view bytes, Seconds now);
  // Interrupts the upload; the next take_bytes() informs the board.
  void cancel();
  bool ended() const { return stage_ == Stage::ended; }
  // Why the file did not arrive, a clause; empty: it did, or is on its way.
  const std::string& trouble() const { return trouble_; }
  // The acknowledged part of the file, 0 to 1.
  double share() const;

 private:
  enum class Stage : std::uint8_t { begins, waits, header, data, end, closes, ended };
  FileUpload(std::string command, std::string name, std::string content)
      : command_(std::move(command)), name_(std::move(name)), content_(std::move(content)) {}

  bool is_ymodem() const { return command_.empty(); }
  std::string packet() const;
  void send_packet(Seconds now);
  void hear(char byte, Seconds now);
  void acknowledge(Seconds now);
  void enter(Stage stage, Seconds now);
  void fail(std::string words);

  std::string command_;  // begins XMODEM; empty: YMODEM
  std::string name_;     // for YMODEM
  std::string content_;
  Stage stage_ = Stage::begins;
  std::string ready_;     // to be sent
  std::size_t sent_ = 0;  // acknowledged bytes of the content
  std::uint8_t number_ = 0;
  int tries_ = 0;
  int cancels_ = 0;  // one after the other
  Seconds since_{0};
  std::string line_;  // what the board is saying
  std::string trouble_;
};

}  // namespace passo
