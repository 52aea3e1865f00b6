#include "passo/transport/board_address.hpp"

#include <charconv>

namespace passo {
namespace {

constexpr std::string_view expected =
    ": expected virtual, serial:DEVICE, serial:DEVICE@BAUD, tcp:HOST:PORT or sim:BOARD";

Failure<std::string> refuse(std::string_view text) {
  return Failure{"'" + std::string(text) + "' is no board" + std::string(expected)};
}

bool read_number(std::string_view text, unsigned low, unsigned high, unsigned& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
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
    address.kind = BoardAddress::Kind::serial;
    std::string_view device = text.substr(7);
    const std::size_t at = device.rfind('@');
    if (at != std::string_view::npos) {
      if (!read_number(device.substr(at + 1), 1200, 4'000'000, address.baud)) return refuse(text);
      device = device.substr(0, at);
    }
    if (device.empty()) return refuse(text);
    address.place = device;
    return address;
  }
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
