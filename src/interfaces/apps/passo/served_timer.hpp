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
#include "passo/sender/grbl_machine_session.hpp"
#include "passo/sender/grbl_times.hpp"

namespace passo {

class ServedTimer final : public MotionTimer {
 public:
  explicit ServedTimer(const MachineDescription& machine);
  // The motion is planned by that board, over a connection of that rate; 0: without limit. `board` must outlive this
  // object.
  void follow(const GrblMachineSession& board, double bytes_per_second);
  ~ServedTimer() override;
  ServedTimer(const ServedTimer&) = delete;
  ServedTimer& operator=(const ServedTimer&) = delete;
  void begin(MotionTiming wanted) override;
  std::optional<MotionTimes> take_times() override;
  std::uint64_t basis() override;

 private:
  void run();
  std::optional<MotionTimes> plan(const MotionTiming& wanted, const std::optional<GrblTiming>& board,
                                  std::uint64_t order) const;

  const MachineDescription machine_;
  const GrblMachineSession* board_ = nullptr;
  double bytes_per_second_ = 0;
  std::uint64_t basis_ = 0;
  std::optional<GrblTiming> based_on_;    // what the board has told last
  std::atomic<std::uint64_t> orders_{0};  // number of the current order; computations for older orders are abandoned
  std::atomic<bool> ends_{false};
  std::mutex mutex_;  // guards the following members
  std::condition_variable news_;
  std::optional<MotionTiming> wanted_;
  std::optional<GrblTiming> wanted_board_;  // null: our planner
  std::optional<MotionTimes> found_;
  std::thread thread_;
};

}  // namespace passo
