#include "port_words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace passo {

std::string describe_device(const SerialPort& port) {
  std::string words = fmt::format("{:04x}:{:04x}", port.vendor, port.product);
  // Many names begin with that of the manufacturer.
  if (!port.product_name.starts_with(port.manufacturer)) words += " " + port.manufacturer;
  if (!port.product_name.empty()) words += " " + port.product_name;
  return words;
}

nlohmann::ordered_json to_json(const SerialPort& port) {
  nlohmann::ordered_json users = nlohmann::ordered_json::array();
  for (const PortUser& user : port.users) {
    users.push_back({{"process", user.process > 0 ? nlohmann::ordered_json(user.process) : nlohmann::ordered_json()},
                     {"program", user.program}});
  }
  return {{"device", port.device},
          {"lasting_name", port.lasting_name},
          {"usb",
           {{"vendor", fmt::format("{:04x}", port.vendor)},
            {"product", fmt::format("{:04x}", port.product)},
            {"manufacturer", port.manufacturer},
            {"product_name", port.product_name},
            {"serial_number", port.serial_number}}},
          {"users", std::move(users)}};
}

nlohmann::ordered_json to_json(const SerialPortList& list) {
  nlohmann::ordered_json ports = nlohmann::ordered_json::array();
  for (const SerialPort& port : list.ports) ports.push_back(to_json(port));
  return {{"ports", std::move(ports)}, {"sees_all_programs", list.sees_all_programs}};
}

}  // namespace passo
