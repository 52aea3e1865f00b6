// OpenedGrbl: a machine that speaks Grbl 1.1, at the end of a serial line or a connection, after it was greeted.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "board_claim.hpp"

#include "passo/sender/grbl_sender.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {

// Whether an address of --board names such a machine.
bool names_grbl_machine(const std::string& board);

class OpenedGrbl {
 public:
  static constexpr Seconds between_looks{0.02};

  // Opens `board`, and waits until the machine has told what it is. Null, with a message and `code`: there is none, or
  // another program drives it. The machine may be in an alarm.
  static std::unique_ptr<OpenedGrbl> open(const std::string& board, int& code);

  GrblSender& sender() { return sender_; }
  const GrblSender& sender() const { return sender_; }
  Seconds now() const { return port_->elapsed(); }
  // Sends what is to be sent and hears what comes, for `most` at most.
  void poll(Seconds most);
  // Turns until the machine has done all lines and rests, or has a fault. Ctrl-C brakes, and drops what it holds.
  // Shows what somebody must do at the machine. `look`, if any, is called after each turn. False: it was interrupted,
  // or there is a fault.
  [[nodiscard]] bool poll_until_rest(const std::function<void()>& look = {});
  // What somebody must do at the machine, if that is new: once for each wait.
  std::string_view news_of_wait();
  // Shows why the machine is not at rest with all lines done. Returns the exit code.
  [[nodiscard]] int give_up() const;
  // Unlocks the machine by homing it. False, with a message.
  [[nodiscard]] bool home(int& code);
  // "X1.000 Y2.000 Z0.000", machine coordinates; or that the place is not known.
  std::string place_words() const;

 private:
  OpenedGrbl(std::string board, BoardClaim claim, std::unique_ptr<StreamPort> port)
      : board_(std::move(board)), claim_(std::move(claim)), port_(std::move(port)), sender_(port_->elapsed()) {}

  std::string board_;
  BoardClaim claim_;
  std::unique_ptr<StreamPort> port_;
  GrblSender sender_;
  std::string_view last_wait_;
};

// The fault for people: where, what, and its code.
std::string describe(const GrblFault& fault, const std::string& program);

}  // namespace passo
