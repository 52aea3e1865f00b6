// passo board list: the serial ports, who uses them, and, if asked for, which boards answer on them.
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "board_opening.hpp"
#include "board_words.hpp"
#include "commands.hpp"
#include "port_words.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "passo/link/await.hpp"
#include "passo/transport/serial_ports.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// A port of the list, or another one that was named.
struct ListedPort {
  std::string device;  // as it was named
  std::optional<SerialPort> port;
  std::string words;  // what the board has answered; empty: it was not asked
  std::optional<About> about;
};

bool is_same_device(const std::string& one, const std::string& other) {
  std::error_code none;
  return one == other || fs::weakly_canonical(one, none) == fs::weakly_canonical(other, none);
}

std::vector<ListedPort> ports_of(const BoardListArguments& arguments, const SerialPortList& known) {
  std::vector<ListedPort> ports;
  if (arguments.devices.empty()) {
    for (const SerialPort& port : known.ports) {
      ports.push_back({.device = port.lasting_name, .port = port, .words = {}, .about = {}});
    }
  }
  for (const std::string& device : arguments.devices) {
    ListedPort& one = ports.emplace_back(ListedPort{.device = device, .port = {}, .words = {}, .about = {}});
    for (const SerialPort& port : known.ports) {
      if (is_same_device(port.device, device)) one.port = port;
    }
  }
  return ports;
}

// Another program's job would be lost with the board's restart.
void ask(ListedPort& listed, Seconds wait) {
  if (listed.port && !listed.port->users.empty()) return;
  auto port = open_board({.kind = BoardAddress::Kind::serial, .place = listed.device, .port = ""});
  if (!port) {
    listed.words = port.error();
    return;
  }
  BoardSession board(**port, inquiry_care);
  listed.about = ask_about(board, wait);
  listed.words = listed.about ? fmt::format("{}, firmware {}, {} events/s", name_of(*listed.about),
                                            version_of(*listed.about), listed.about->highest_event_rate)
                              : silence_of(board);
}

nlohmann::ordered_json to_json(const ListedPort& listed) {
  nlohmann::ordered_json json = {{"board", "serial:" + listed.device}};
  if (listed.port) json.update(to_json(*listed.port));
  if (!listed.words.empty()) json["says"] = listed.words;
  if (listed.about) json["about"] = nlohmann::ordered_json(to_json(*listed.about));
  return json;
}

void print(const ListedPort& listed) {
  fmt::print("{}\n", listed.device);
  if (listed.port) {
    if (listed.port->device != listed.device) fmt::print("  device  {}\n", listed.port->device);
    fmt::print("  usb     {}\n", describe_device(*listed.port));
    fmt::print("  state   {}\n",
               listed.port->users.empty() ? "no program is known to use it" : describe_users(*listed.port));
  }
  if (!listed.words.empty()) fmt::print("  board   {}\n", listed.words);
}

}  // namespace

int board_list(const BoardListArguments& arguments) {
  const SerialPortList known = list_serial_ports(arguments.system);
  std::vector<ListedPort> ports = ports_of(arguments, known);
  const bool asks = arguments.ask || !arguments.devices.empty();
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (ListedPort& listed : ports) {
    if (asks) {
      if (is_terminal(STDERR_FILENO)) fmt::print(stderr, "{}: asking...\r", listed.device);
      ask(listed, Seconds(arguments.wait));
    }
    if (!arguments.json) print(listed);
    json.push_back(to_json(listed));
  }
  if (arguments.json) {
    fmt::print("{}\n", json.dump(2));
    return exit_done;
  }
  if (ports.empty()) fmt::print("No USB serial port found.\n");
  if (!known.sees_all_programs && !known.ports.empty()) {
    note("programs of other users are seen only if they lock their port: a port may be in use unnoticed");
  }
  if (!asks && !ports.empty()) {
    note(
        "no port was opened. `passo board list --ask` opens those that are not in use and asks which board is "
        "there; this restarts an Arduino");
  }
  return exit_done;
}

}  // namespace passo
