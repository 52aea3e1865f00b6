#include "served_timer.hpp"

#include <utility>

#include <sys/resource.h>
#include <unistd.h>

namespace passo {

ServedTimer::ServedTimer(const MachineDescription& machine) : machine_(machine), thread_([this] { run(); }) {}

ServedTimer::~ServedTimer() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  news_.notify_one();
  thread_.join();
}

void ServedTimer::begin(MotionTiming wanted) {
  {
    const std::lock_guard lock(mutex_);
    ++orders_;
    wanted_ = std::move(wanted);
    found_.reset();
  }
  news_.notify_one();
}

std::optional<MotionTimes> ServedTimer::take_times() {
  const std::lock_guard lock(mutex_);
  return std::exchange(found_, std::nullopt);
}

void ServedTimer::run() {
  constexpr int lowest_priority = 19;
  // Linux has a priority for each thread.
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), lowest_priority));
  std::unique_lock lock(mutex_);
  for (;;) {
    news_.wait(lock, [this] { return ends_ || wanted_.has_value(); });
    if (ends_) return;
    const MotionTiming wanted = *std::exchange(wanted_, std::nullopt);
    const std::uint64_t order = orders_;
    lock.unlock();
    std::optional<MotionTimes> times = time_motion(wanted, machine_, [&] { return !ends_ && orders_ == order; });
    lock.lock();
    if (times && orders_ == order) found_ = std::move(times);
  }
}

}  // namespace passo
