// BoardAddress: the address of a board, as a user writes it.
//
//   virtual                       a virtual machine in this process
//   serial:/dev/ttyUSB0           a serial port at 500,000 baud
//   serial:/dev/ttyUSB0@115200    at another baud rate
//   sim:uno                       that board's firmware on an emulated chip, in this process
//   grbl:/dev/ttyUSB0             a machine with Grbl 1.1, at 115,200 baud; also @BAUD and grbl:tcp:HOST:PORT
//   grbl:tcp:HOST:PORT@115200     the same behind a serial line of that rate, which somebody connects to the network
//   grbl:ws://HOST:PORT           the same through a WebSocket; without a port, 81
//   tcp:HOST:PORT                 a board, or `passo board serve`, in the network; IPv6 addresses in brackets: [::1]
#pragma once

#include <string>
#include <string_view>

#include "passo/base/result.hpp"

namespace passo {

inline constexpr unsigned usual_baud = 500'000;
inline constexpr unsigned grbl_baud = 115'200;

struct BoardAddress {
  enum class Kind : unsigned char { virtual_machine, serial, tcp, emulated, websocket };
  Kind kind = Kind::virtual_machine;
  std::string place;           // device, host, or emulated board
  std::string port;            // tcp, websocket
  unsigned baud = usual_baud;  // serial
  unsigned behind_baud = 0;    // tcp: of a serial line behind the network; 0: there is none
  bool speaks_grbl = false;    // the other end is a machine that accepts G-code, not a board

  bool operator==(const BoardAddress&) const = default;
};

// The error is a sentence with the expected form.
Result<BoardAddress, std::string> parse_board_address(std::string_view text);

}  // namespace passo
