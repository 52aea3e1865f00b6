#include "passo/transport/board_address.hpp"

#include <charconv>

namespace passo {
namespace {

constexpr const char* websocket_port = ":81";  // of FluidNC and grblHAL
constexpr std::string_view expected =
    ": expected virtual, serial:DEVICE, serial:DEVICE@BAUD, tcp:HOST:PORT, sim:BOARD or grbl:DEVICE";

Failure<std::string> refuse(std::string_view text) {
  return Failure{"'" + std::string(text) + "' is not a board" + std::string(expected)};
}

bool read_number(std::string_view text, unsigned low, unsigned high, unsigned& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
}

// Takes @BAUD away from the end, if it is there.
bool take_baud(std::string_view& text, unsigned& baud) {
  const std::size_t at = text.rfind('@');
  if (at == std::string_view::npos) return true;
  if (!read_number(text.substr(at + 1), 1200, 4'000'000, baud)) return false;
  text = text.substr(0, at);
  return true;
}

// DEVICE, DEVICE@BAUD
bool read_device(std::string_view device, BoardAddress& address) {
  address.kind = BoardAddress::Kind::serial;
  if (!take_baud(device, address.baud)) return false;
  address.place = device;
  return !device.empty();
}

// grbl:tcp:HOST:PORT[@BAUD], grbl:ws://HOST[:PORT], grbl:serial:DEVICE, grbl:DEVICE
Result<BoardAddress, std::string> read_grbl_address(std::string_view text) {
  std::string_view line = text.substr(5);
  BoardAddress address;
  if (line.starts_with("tcp:")) {
    unsigned baud = 0;
    const bool is_rate = take_baud(line, baud);
    auto connection = parse_board_address(line);
    if (!is_rate || !connection) return refuse(text);
    address = std::move(*connection);
    address.behind_baud = baud;
  } else if (line.starts_with("ws://")) {
    std::string host(line.substr(5));
    if (host.ends_with('/')) host.pop_back();
    const bool has_port = host.find(':', host.starts_with('[') ? host.find(']') : 0) != std::string::npos;
    auto connection = parse_board_address("tcp:" + host + (has_port ? "" : websocket_port));
    if (!connection || host.find('/') != std::string::npos) return refuse(text);
    address = std::move(*connection);
    address.kind = BoardAddress::Kind::websocket;
  } else {
    address.baud = grbl_baud;
    if (!read_device(line.starts_with("serial:") ? line.substr(7) : line, address)) return refuse(text);
    if (address.place.find('/') == std::string::npos) return refuse(text);
  }
  address.speaks_grbl = true;
  return address;
}

}  // namespace

Result<BoardAddress, std::string> parse_board_address(std::string_view text) {
  if (text == "virtual") return BoardAddress();
  BoardAddress address;
  if (text.starts_with("sim:")) {
    address.kind = BoardAddress::Kind::emulated;
    address.place = text.substr(4);
    return address.place.empty() ? Result<BoardAddress, std::string>(refuse(text)) : address;
  }
  if (text.starts_with("serial:")) {
    if (!read_device(text.substr(7), address)) return refuse(text);
    return address;
  }
  if (text.starts_with("grbl:")) return read_grbl_address(text);
  if (!text.starts_with("tcp:")) return refuse(text);
  address.kind = BoardAddress::Kind::tcp;
  std::string_view host = text.substr(4);
  const std::size_t colon = host.rfind(':');
  unsigned port = 0;
  if (colon == std::string_view::npos || !read_number(host.substr(colon + 1), 1, 65535, port)) return refuse(text);
  address.port = std::to_string(port);
  host = host.substr(0, colon);
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (bracketed) host = host.substr(1, host.size() - 2);
  // Without brackets an address with colons could not be told from its port.
  if (host.empty() || (!bracketed && host.find_first_of(":[]") != std::string_view::npos)) return refuse(text);
  address.place = host;
  return address;
}

}  // namespace passo
