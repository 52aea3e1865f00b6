// ModbusPort: a serial port with one drive, through libmodbus. It opens the port when it is needed, and again after an
// error, e.g. when a USB adapter was unplugged. Private to spindle/.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "passo/base/result.hpp"
#include "passo/machine_file/spindle_bus_description.hpp"
#include "passo/spindle/vfd.hpp"

namespace passo {

class ModbusPort {
 public:
  using Reply = Result<std::uint16_t, VfdTrouble>;

  explicit ModbusPort(const SpindleBusDescription& bus);
  ~ModbusPort();
  ModbusPort(const ModbusPort&) = delete;
  ModbusPort& operator=(const ModbusPort&) = delete;

  // Opens the port, unless it is open.
  Status<VfdTrouble> open();
  Reply read(int function, std::uint16_t address);
  Reply write(int function, std::uint16_t address, std::uint16_t value);
  // Huanyang's frames. `request` is without its checksum.
  Reply exchange_huanyang(std::span<const std::uint8_t> request);

 private:
  struct Context;
  VfdTrouble trouble_of(int error);
  void await_silence();
  void close();

  SpindleBusDescription bus_;
  std::unique_ptr<Context> context_;  // null: the port is closed
};

}  // namespace passo
