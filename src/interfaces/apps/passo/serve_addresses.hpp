// Where `passo serve` is to be reached and by whom: read and judged before anything is opened.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "commands.hpp"

#include "passo/transport/board_address.hpp"
#include "passo/web/web_access.hpp"

namespace passo {

// "HOST:PORT", "[::1]:PORT" or ":PORT". Empty: it is none of them.
struct HostAndPort {
  std::string host;
  unsigned port = 0;
};
std::optional<HostAndPort> read_address(std::string_view text);

// Each of them: empty, with a message and `code`, if what the arguments say is not good or not allowed.
// `wanted`: of --grbl-tcp, or what stands for it.
std::optional<HostAndPort> sender_address(const ServeArguments& arguments, const std::string& wanted, int& code);
std::optional<BoardAddress> sender_port(const ServeArguments& arguments, int& code);
struct WebPlace {
  HostAndPort address;
  WebAccess access;
};
std::optional<WebPlace> web_place(const ServeArguments& arguments, int& code);

// --check: all that can be judged without a board, without a port, and without motion. Returns the exit code.
// `machine_name`: of the machine file, which is good.
int check_serve(const ServeArguments& arguments, const std::string& machine_name);

}  // namespace passo
