// ServedTimer: times the motion of programs in a thread of its own, at the lowest priority: the machine's loop waits
// for nothing. What the thread uses is its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include "passo/api/motion_times.hpp"

namespace passo {

class ServedTimer final : public MotionTimer {
 public:
  explicit ServedTimer(const MachineDescription& machine);
  ~ServedTimer() override;
  ServedTimer(const ServedTimer&) = delete;
  ServedTimer& operator=(const ServedTimer&) = delete;
  void begin(MotionTiming wanted) override;
  std::optional<MotionTimes> take_times() override;

 private:
  void run();

  const MachineDescription machine_;
  std::atomic<std::uint64_t> orders_{0};  // what is timed for an older one is given up
  std::atomic<bool> ends_{false};
  std::mutex mutex_;  // guards what follows
  std::condition_variable news_;
  std::optional<MotionTiming> wanted_;
  std::optional<MotionTimes> found_;
  std::thread thread_;
};

}  // namespace passo
