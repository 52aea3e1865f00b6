// ServedTimer: computes the duration of programs in a separate thread at the lowest priority, so that the machine's
// loop never waits for it. The thread works on its own copies.
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
  std::atomic<std::uint64_t> orders_{0};  // number of the current order; computations for older orders are abandoned
  std::atomic<bool> ends_{false};
  std::mutex mutex_;  // guards the following members
  std::condition_variable news_;
  std::optional<MotionTiming> wanted_;
  std::optional<MotionTimes> found_;
  std::thread thread_;
};

}  // namespace passo
