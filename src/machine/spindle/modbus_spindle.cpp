#include "passo/spindle/modbus_spindle.hpp"

#include <chrono>
#include <utility>

namespace passo {
namespace {

constexpr Seconds longest_stop{1};

Seconds steady_now() {
  return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count());
}

std::chrono::duration<double> duration_of(Seconds time) {
  return std::chrono::duration<double>(time.value());
}

bool is_same(const HostSpindleStatus& one, const HostSpindleStatus& other) {
  return one.order == other.order && one.answers == other.answers && one.at_speed == other.at_speed &&
         one.revolutions_per_minute == other.revolutions_per_minute && one.current == other.current &&
         one.load == other.load && one.fault == other.fault;
}

}  // namespace

ModbusSpindle::ModbusSpindle(std::unique_ptr<Vfd> vfd, const SpindleBusDescription& bus)
    : vfd_(std::move(vfd)), controller_(*vfd_, bus, steady_now), thread_([this] { run(); }) {}

ModbusSpindle::~ModbusSpindle() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ModbusSpindle::order(const SpindleOrder& wanted) {
  {
    const std::lock_guard lock(mutex_);
    if (wanted == order_) return;
    order_ = wanted;
  }
  changed_.notify_all();
}

HostSpindleStatus ModbusSpindle::status() const {
  const std::lock_guard lock(mutex_);
  HostSpindleStatus status = status_;
  // What the thread has published may be about an earlier order.
  status.at_speed = status.at_speed && status.order == order_;
  status.order = order_;
  return status;
}

bool ModbusSpindle::await_drive(Seconds most) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, duration_of(most), [this] { return status_.answers && is_stopped_; });
}

bool ModbusSpindle::try_to_clear() {
  const std::lock_guard lock(mutex_);
  if (!status_.has_failed()) return status_.answers;
  clears_ = true;
  if (!can_be_cleared_) return false;
  status_.fault = {};
  status_.at_speed = false;
  return true;
}

void ModbusSpindle::publish() {
  HostSpindleStatus status = controller_.status();
  is_stopped_ = controller_.is_stopped();
  can_be_cleared_ = controller_.can_be_cleared();
  if (clears_ && !status_.has_failed()) {  // cleared since, which the controller learns next
    status.fault = {};
    status.at_speed = false;
  }
  status.version = status_.version + (is_same(status, status_) ? 0 : 1);
  status_ = std::move(status);
  changed_.notify_all();
}

void ModbusSpindle::run() {
  std::unique_lock lock(mutex_);
  std::optional<Seconds> end;
  for (;;) {
    if (ends_ && !end) end = steady_now() + longest_stop;
    const SpindleOrder applied = order_;
    controller_.order(end ? SpindleOrder() : applied);
    if (std::exchange(clears_, false)) controller_.clear_fault();
    lock.unlock();
    const Seconds pause = controller_.step();
    lock.lock();
    publish();
    if (end && (controller_.is_stopped() || steady_now() > *end)) return;
    const auto woken = [&] { return (ends_ && !end) || clears_ || order_ != applied; };
    changed_.wait_for(lock, duration_of(pause), woken);
  }
}

}  // namespace passo
