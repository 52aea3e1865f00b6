#include "serve_addresses.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>

#include "program_input.hpp"
#include "served_status.hpp"
#include <fmt/format.h>
#include <unistd.h>

#include "passo/base/lower_case.hpp"
#include "passo/pendant/pendant_finder.hpp"

namespace passo {
namespace {

constexpr std::size_t shortest_token = 16;

// The first line of a file.
std::optional<std::string> read_token(const std::string& file) {
  std::ifstream in(file);
  std::string token;
  if (!std::getline(in, token)) return {};
  while (!token.empty() && (token.back() == '\r' || token.back() == ' ')) token.pop_back();
  return token;
}

bool is_this_computer(const std::string& host) {
  return host.starts_with("127.") || host == "::1" || host == "localhost";
}

// A folder that is there can be written; one that is not can be made.
bool can_keep_data(const std::string& folder) {
  std::error_code none;
  std::filesystem::path place = folder;
  while (!std::filesystem::exists(place, none)) {
    const auto above = std::filesystem::absolute(place, none).parent_path();
    if (above == place) return false;
    place = above;
  }
  return std::filesystem::is_directory(place, none) && access(place.c_str(), W_OK | X_OK) == 0;
}

}  // namespace

std::optional<HostAndPort> read_address(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return {};
  std::string_view host = text.substr(0, colon);
  const std::string_view digits = text.substr(colon + 1);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  unsigned port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (error != std::errc() || end != digits.data() + digits.size() || port > 65535) return {};
  return HostAndPort{.host = host.empty() ? "127.0.0.1" : std::string(host), .port = port};
}

std::optional<HostAndPort> sender_address(const ServeArguments& arguments, const std::string& wanted, int& code) {
  const auto address = read_address(wanted);
  if (!address) {
    code = fail(exit_bad_program, "--grbl-tcp: expected HOST:PORT, e.g. 127.0.0.1:7071, not " + wanted);
    return {};
  }
  if (!is_this_computer(address->host) && !arguments.anybody_may_drive) {
    code = fail(exit_bad_program,
                fmt::format("--grbl-tcp {}: everybody who reaches this port can move the machine, because the Grbl "
                            "protocol has no password. To allow it, add --anybody-may-drive [serve.open-port]",
                            wanted));
    return {};
  }
  return address;
}

std::optional<BoardAddress> sender_port(const ServeArguments& arguments, int& code) {
  auto address = parse_board_address("grbl:" + arguments.grbl_serial);
  if (address && address->kind == BoardAddress::Kind::serial) return std::move(*address);
  code = fail(exit_bad_program,
              "--grbl-serial: expected DEVICE or DEVICE@BAUD, e.g. /dev/ttyS0@115200, not " + arguments.grbl_serial);
  return {};
}

std::optional<WebPlace> web_place(const ServeArguments& arguments, int& code) {
  const auto address = read_address(arguments.http);
  if (!address) {
    code = fail(exit_bad_program, "--http: expected HOST:PORT, e.g. 127.0.0.1:7080, not " + arguments.http);
    return {};
  }
  WebAccess access{.names = {"localhost", "127.0.0.1", "[::1]"}};
  const bool has_colon = address->host.find(':') != std::string::npos;
  access.names.push_back(has_colon ? "[" + address->host + "]" : address->host);
  for (const std::string& name : arguments.http_names) access.names.push_back(lower_case(name));
  if (!arguments.http_token.empty()) {
    const auto token = read_token(arguments.http_token);
    if (!token || token->size() < shortest_token) {
      code =
          fail(exit_bad_program, fmt::format("--http-token {}: expected a file whose first line is a token of at least "
                                             "{} characters, e.g. from `openssl rand -hex 16` [serve.bad-token]",
                                             arguments.http_token, shortest_token));
      return {};
    }
    access.token = *token;
  }
  if (access.token.empty() && !is_this_computer(address->host)) {
    code = fail(exit_bad_program, fmt::format("--http {}: other computers can reach this port, so a token is required: "
                                              "add --http-token FILE [serve.open-http]",
                                              arguments.http));
    return {};
  }
  return WebPlace{.address = *address, .access = std::move(access)};
}

int check_serve(const ServeArguments& arguments, const std::string& machine_name) {
  int code = exit_done;
  if (!arguments.grbl_tcp.empty() && !sender_address(arguments, arguments.grbl_tcp, code)) return code;
  if (!arguments.grbl_serial.empty() && !sender_port(arguments, code)) return code;
  if (!arguments.http.empty() && !web_place(arguments, code)) return code;
  if (!arguments.pendant.empty()) {
    Diagnostics diagnostics;
    const bool is_good = PendantFinder::make(arguments.pendant, arguments.system, diagnostics).has_value();
    show(diagnostics);
    if (!is_good) return exit_bad_program;
  }
  if (!arguments.mqtt.broker.empty() && !ServedStatus::check(arguments, code)) return code;
  if (const auto board = parse_board_address(arguments.board); !board) return fail(exit_bad_program, board.error());
  if (!arguments.data.empty() && !can_keep_data(arguments.data)) {
    return fail(exit_failed, fmt::format("--data {}: the folder is not writable [serve.data]", arguments.data));
  }
  fmt::print("{} on {}: the options and the machine file are valid. Nothing was opened, and nothing moved.\n",
             machine_name, arguments.board == "virtual" ? "a simulated board" : arguments.board);
  return exit_done;
}

}  // namespace passo
