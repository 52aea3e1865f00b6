#include "passo/spindle/open_vfd.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "modbus_port.hpp"
#include <fmt/format.h>

#include "passo/spindle/huanyang_frames.hpp"
#include "passo/spindle/vfd_table.hpp"

namespace passo {
namespace {

std::uint16_t in_counts(double value) {
  return static_cast<std::uint16_t>(std::clamp(std::round(value), 0.0, 65535.0));
}

// A drive with standard Modbus.
class TableVfd final : public Vfd {
 public:
  TableVfd(const SpindleBusDescription& bus, VfdTable table)
      : port_(bus), table_(std::move(table)), rpm_per_hertz_(bus.rpm_per_hertz()) {}

  Status<VfdTrouble> open() { return port_.open(); }

  bool can(VfdTask task) const override {
    switch (task) {
      case VfdTask::run_reverse: return table_.reverse.has_value();
      case VfdTask::reset_fault: return table_.reset.has_value();
      case VfdTask::read_current: return table_.current.has_value();
      case VfdTask::read_load: return table_.load.has_value();
      case VfdTask::read_fault: return table_.fault.has_value();
      default: return true;
    }
  }

  Result<double, VfdTrouble> exchange(VfdTask task, double rpm) override {
    switch (task) {
      case VfdTask::set_speed: {
        const VfdRegister& speed = table_.speed;
        return value_of(port_.write(speed.function, speed.address, in_counts(rpm / rpm_a_count(speed))), 1);
      }
      case VfdTask::run_forward: return command(table_.forward);
      case VfdTask::run_reverse: return command(*table_.reverse);
      case VfdTask::stop: return command(table_.stop);
      case VfdTask::reset_fault: return command(*table_.reset);
      case VfdTask::read_speed: return read(table_.actual_speed, rpm_a_count(table_.actual_speed));
      case VfdTask::read_current: return read(*table_.current, 1 / table_.current->scale);
      case VfdTask::read_load: return read(*table_.load, 0.01 / table_.load->scale);
      case VfdTask::read_fault: break;
    }
    const auto fault = port_.read(table_.fault->function, table_.fault->address);
    if (!fault) return Failure{fault.error()};
    return static_cast<double>(*fault & table_.fault->mask);
  }

  std::string fault_text(int number) const override {
    const auto found = table_.fault_texts.find(number);
    return found != table_.fault_texts.end() ? found->second : "";
  }

 private:
  double rpm_a_count(const VfdRegister& speed) const { return (speed.is_in_hertz ? rpm_per_hertz_ : 1) / speed.scale; }
  static Result<double, VfdTrouble> value_of(const ModbusPort::Reply& reply, double a_count) {
    if (!reply) return Failure{reply.error()};
    return *reply * a_count;
  }
  Result<double, VfdTrouble> command(const VfdCommand& command) {
    return value_of(port_.write(command.function, command.address, command.value), 1);
  }
  Result<double, VfdTrouble> read(const VfdRegister& from, double a_count) {
    return value_of(port_.read(from.function, from.address), a_count);
  }

  ModbusPort port_;
  VfdTable table_;
  double rpm_per_hertz_;
};

class HuanyangVfd final : public Vfd {
 public:
  explicit HuanyangVfd(const SpindleBusDescription& bus)
      : port_(bus), address_(bus.address), rpm_per_hertz_(bus.rpm_per_hertz()) {}

  Status<VfdTrouble> open() { return port_.open(); }
  bool can(VfdTask task) const override { return !huanyang_request(address_, task, 0).empty(); }
  std::string fault_text(int) const override { return ""; }

  Result<double, VfdTrouble> exchange(VfdTask task, double rpm) override {
    constexpr double counts_per_hertz = 100;
    constexpr double counts_per_ampere = 10;
    const double rpm_a_count = rpm_per_hertz_ / counts_per_hertz;
    const auto reply = port_.exchange_huanyang(huanyang_request(address_, task, in_counts(rpm / rpm_a_count)));
    if (!reply) return Failure{reply.error()};
    if (task == VfdTask::read_speed) return *reply * rpm_a_count;
    if (task == VfdTask::read_current) return *reply / counts_per_ampere;
    return static_cast<double>(*reply);
  }

 private:
  ModbusPort port_;
  int address_;
  double rpm_per_hertz_;
};

template <class Kind>
Result<OpenedVfd, std::string> opened(std::unique_ptr<Kind> vfd, const SpindleBusDescription& bus, std::string name,
                                      std::string timeout_setting) {
  if (const auto port = vfd->open(); !port) return Failure{fmt::format("{}: {}", bus.device, port.error().words)};
  return OpenedVfd{.vfd = std::move(vfd), .name = std::move(name), .timeout_setting = std::move(timeout_setting)};
}

}  // namespace

Result<OpenedVfd, std::string> open_vfd(const SpindleBusDescription& bus, Diagnostics& diagnostics) {
  if (bus.drive == "huanyang") return opened(std::make_unique<HuanyangVfd>(bus), bus, "Huanyang HY", "");
  const auto table = bus.drive == "h100" ? std::optional(h100_table()) : load_vfd_table(bus.drive, diagnostics);
  if (!table) return Failure{fmt::format("{} is not a usable table of a drive", bus.drive)};
  return opened(std::make_unique<TableVfd>(bus, *table), bus, table->name, table->timeout_setting);
}

}  // namespace passo
