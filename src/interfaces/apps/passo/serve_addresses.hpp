// The addresses of `passo serve` and their access rights: parsed and checked before anything is opened.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "commands.hpp"

#include "passo/transport/board_address.hpp"
#include "passo/web/web_access.hpp"

namespace passo {

// "HOST:PORT", "[::1]:PORT" or ":PORT". Empty: none of these.
struct HostAndPort {
  std::string host;
  unsigned port = 0;
};
std::optional<HostAndPort> read_address(std::string_view text);

// Each returns nothing, with a message and `code`, if the arguments are invalid or not allowed. `wanted`: the value of
// --grbl-tcp, or its default.
std::optional<HostAndPort> sender_address(const ServeArguments& arguments, const std::string& wanted, int& code);
std::optional<BoardAddress> sender_port(const ServeArguments& arguments, int& code);
struct WebPlace {
  HostAndPort address;
  WebAccess access;
};
std::optional<WebPlace> web_place(const ServeArguments& arguments, int& code);

// --check: checks everything that is possible without a board, without a port, and without motion. Returns the exit
// code. `machine_name`: the name in the valid machine file.
int check_serve(const ServeArguments& arguments, const std::string& machine_name);

}  // namespace passo
