#include "served_timer.hpp"

#include <utility>

#include "grbl_time_left.hpp"
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
    wanted_board_ = board_ != nullptr ? based_on_ : std::nullopt;
    wanted_ = std::move(wanted);
    found_.reset();
  }
  news_.notify_one();
}

std::optional<MotionTimes> ServedTimer::take_times() {
  const std::lock_guard lock(mutex_);
  return std::exchange(found_, std::nullopt);
}

void ServedTimer::follow(const GrblMachineSession& board, double bytes_per_second) {
  board_ = &board;
  bytes_per_second_ = bytes_per_second;
}

// The settings of the board may be changed at any time. While it is asked again, what it has told before counts.
std::uint64_t ServedTimer::basis() {
  if (board_ == nullptr) return 1;
  const GrblMachine& board = board_->board();
  GrblTiming told = grbl_timing_of(board, bytes_per_second_);
  if (!told.is_known()) return basis_;
  const bool is_same =
      based_on_ && based_on_->limits == told.limits && based_on_->target.measures_motors == told.target.measures_motors;
  if (!is_same) ++basis_;
  based_on_ = std::move(told);
  return basis_;
}

std::optional<MotionTimes> ServedTimer::plan(const MotionTiming& wanted, const std::optional<GrblTiming>& board,
                                             std::uint64_t order) const {
  const auto goes_on = [&] { return !ends_ && orders_ == order; };
  if (!board) return time_motion(wanted, machine_, goes_on);
  return predict_on_grbl(ProgramReader::from_text(wanted.name, wanted.text), machine_, wanted.options, *board,
                         wanted.factors, goes_on);
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
    const std::optional<GrblTiming> board = wanted_board_;
    const std::uint64_t order = orders_;
    lock.unlock();
    std::optional<MotionTimes> times = plan(wanted, board, order);
    lock.lock();
    if (times && orders_ == order) found_ = std::move(times);
  }
}

}  // namespace passo
