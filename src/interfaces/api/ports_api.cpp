#include "ports_api.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t longest_machine_name = 80;  // of a machine file
constexpr std::size_t longest_address = 200;
constexpr unsigned usual_grbl_baud = 115'200;

const char* name_of(ContactResult::State state) {
  switch (state) {
    case ContactResult::State::none: return "none";
    case ContactResult::State::running: return "running";
    case ContactResult::State::done: return "done";
    case ContactResult::State::failed: return "failed";
  }
  return "";
}

// The port of the list with that device or lasting name. Null: there is none.
Json port_named(const std::string& list, const std::string& name) {
  const Json known = Json::parse(list, nullptr, false);
  if (!known.is_object()) return {};
  for (const Json& port : known.value("ports", Json::array())) {
    if (port.value("device", "") == name || port.value("lasting_name", "") == name) return port;
  }
  return {};
}

// "cncjs (4711), minicom"
std::string users_of(const Json& port) {
  std::string words;
  for (const Json& user : port.value("users", Json::array())) {
    const std::string program = user.value("program", "");
    const Json process = user.value("process", Json());
    words += words.empty() ? "" : ", ";
    words += program.empty() ? "?" : program;
    if (process.is_number()) words += fmt::format(" ({})", process.get<int>());
  }
  return words;
}

// A member that nobody knows is a mistake.
bool has_members_of(const Json& said, std::string_view one, std::string_view other) {
  for (const auto& [name, value] : said.items()) {
    if (name != one && name != other) return false;
  }
  return true;
}

bool is_network_address(const std::string& text) {
  return text.starts_with("tcp:") && text.size() <= longest_address &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 0x7F; });
}

bool is_file_name(const std::string& name) {
  constexpr std::string_view ending = ".toml";
  const auto is_usual = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return name.size() > ending.size() && name.size() <= longest_machine_name && name.ends_with(ending) &&
         name.front() != '.' && name.front() != '-' && std::all_of(name.begin(), name.end(), is_usual);
}

WebAnswer unsound(const Diagnostics& findings) {
  const FindingWords why = findings.all().empty() ? "it has errors" : findings.all().front().message;
  return error_answer(409, "machine-file.unsound",
                      Sentence{.code = "machine-file.unsound",
                               .arguments = held_as("finding", why),
                               .text = fmt::format("invalid machine file: {}", why)});
}

}  // namespace

// To look through all processes takes some milliseconds: nothing waits for that while nothing moves.
std::optional<WebAnswer> PortsApi::refuse_while_moving() const {
  if (!shared_.session.busy() && !jobs_.is_checking()) return {};
  return error_answer(
      409, "machine.busy",
      Sentence{.code = "machine.busy.ports", .text = "the machine is moving: the ports can be used when it stops"});
}

WebAnswer PortsApi::state_answer(unsigned status) const {
  const ContactResult& result = contact().result();
  const Json report = Json::parse(result.report, nullptr, false);
  return json_answer(status, {{"state", name_of(result.state)},
                              {"device", result.device},
                              {"board", result.board},
                              {"words", result.words},
                              {"report", report.is_object() ? report : Json()}});
}

WebAnswer PortsApi::list(const ApiCall&) {
  if (auto refused = refuse_while_moving()) return std::move(*refused);
  Json list = Json::parse(contact().ports(), nullptr, false);
  if (!list.is_object()) list = {{"ports", Json::array()}, {"sees_all_programs", false}};
  list["board"] = contact().board();
  return json_answer(200, list);
}

WebAnswer PortsApi::opened(const ApiCall&) {
  return state_answer(200);
}

WebAnswer PortsApi::open_board(const std::string& device, const std::string& board) {
  if (contact().begin(device, board)) return state_answer(202);
  return error_answer(409, "ports.reading", "a board is being read: wait for its end");
}

WebAnswer PortsApi::open(const ApiCall& call) {
  const Json said = call.members();
  const Json device = said.value("device", Json());
  const Json baud = said.value("baud", Json(usual_grbl_baud));
  if (!has_members_of(said, "device", "baud") || !device.is_string() || !baud.is_number_unsigned() || baud < 1200 ||
      baud > 4'000'000) {
    return bad_body(
        "expected \"device\", a port of GET /ports or tcp:HOST:PORT, and \"baud\", 1200 to 4000000, of a port");
  }
  if (shared_.options.contact == nullptr) return no_ports();
  if (auto refused = refuse_while_moving()) return std::move(*refused);
  const auto name = device.get<std::string>();
  if (is_network_address(name)) return open_board(name, "grbl:" + name);
  const Json port = port_named(contact().ports(), name);
  if (port.is_null()) {
    return error_answer(404, "ports.unknown", "there is no such serial port: it may have been unplugged");
  }
  if (!port["users"].empty()) {
    const std::string users = users_of(port);
    return error_answer(
        409, "ports.busy",
        Sentence{.code = "ports.busy", .arguments = {{"users", users}}, .text = "the port is in use by " + users});
  }
  const auto lasting = port["lasting_name"].get<std::string>();
  const auto rate = baud.get<unsigned>();
  return open_board(lasting,
                    fmt::format("grbl:{}{}", lasting, rate == usual_grbl_baud ? "" : fmt::format("@{}", rate)));
}

WebAnswer PortsApi::keep_machine(const ApiCall& call) {
  const Json said = call.members();
  const Json name = said.value("name", Json());
  const Json text = said.value("text", Json());
  if (!has_members_of(said, "name", "text") || !name.is_string() || !text.is_string())
    return bad_body("expected \"name\" and \"text\", those of a machine file");
  if (shared_.options.contact == nullptr) return no_ports();
  if (auto refused = refuse_while_moving()) return std::move(*refused);
  const auto file = name.get<std::string>();
  if (!is_file_name(file)) {
    return error_answer(400, "machine-file.bad-name",
                        "the name of a machine file has letters, digits, dots, - and _, and ends in .toml");
  }
  Diagnostics findings;
  if (!parse_machine(text.get<std::string>(), file, findings, MachineUse::any_board)) return unsound(findings);
  if (contact().keeps(file)) {
    return error_answer(409, "machine-file.exists",
                        Sentence{.code = "machine-file.exists",
                                 .arguments = {{"name", file}},
                                 .text = fmt::format("there is already a machine file {}", file)});
  }
  const auto kept = contact().keep(file, text.get<std::string>());
  if (!kept) {
    return error_answer(507, "machine-file.unwritten",
                        Sentence{.code = "machine-file.unwritten",
                                 .arguments = {{"name", file}, {"why", kept.error()}},
                                 .text = fmt::format("{} cannot be written: {}", file, kept.error())});
  }
  return json_answer(201, {{"path", kept->path}, {"command", kept->command}});
}

}  // namespace passo
