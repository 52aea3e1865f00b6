// ModbusSpindle: a spindle whose drive is on a serial bus, as a HostSpindle. A thread of its own waits for the drive's
// replies, so no caller does.
//
// When it is destroyed, the drive is told to stop, for at most a second.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>

#include "passo/drive/host_spindle.hpp"
#include "passo/machine_file/spindle_bus_description.hpp"
#include "passo/spindle/spindle_controller.hpp"
#include "passo/spindle/vfd.hpp"

namespace passo {

class ModbusSpindle final : public HostSpindle {
 public:
  ModbusSpindle(std::unique_ptr<Vfd> vfd, const SpindleBusDescription& bus);
  ~ModbusSpindle() override;

  void order(const SpindleOrder& wanted) override;
  HostSpindleStatus status() const override;
  // Waits until the drive has answered and is stopped, at most for `most`. Returns whether it has.
  bool await_drive(Seconds most);

 private:
  bool try_to_clear() override;
  void run();
  void publish();

  std::unique_ptr<Vfd> vfd_;
  SpindleController controller_;  // of the thread alone
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // Below: shared by both threads.
  SpindleOrder order_;
  HostSpindleStatus status_;
  bool is_stopped_ = false;
  bool can_be_cleared_ = false;
  bool clears_ = false;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace passo
