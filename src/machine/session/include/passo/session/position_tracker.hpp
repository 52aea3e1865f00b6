// PositionTracker: the machine position and its trust. The commanded position is compared with the board's counts;
// homing switches may give a better position.
//
// Invariant: a position whose trust is not `unknown` is as accurate as the board's counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "passo/activity/homing_path.hpp"
#include "passo/drive/motion_drive.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/motor_steps.hpp"
#include "passo/session/known_position.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// A difference between the board's counts and the commanded position.
struct CountMismatch {
  std::size_t motor = 0;
  std::int64_t counted = 0;  // from machine zero
  std::int64_t commanded = 0;
};

class PositionTracker {
 public:
  // `machine` must outlive this object.
  PositionTracker(const MachineDescription& machine, const KnownPosition& start)
      : machine_(machine), position_(start) {}

  const KnownPosition& position() const { return position_; }
  // The board's position, with fractions of steps. Empty: as after a handshake.
  const std::optional<BoardPosition>& on_board() const { return on_board_; }
  // The board's counts at machine zero. Empty: not tracked.
  const std::optional<MotorSteps>& zero_counts() const { return zero_counts_; }
  const std::optional<CountMismatch>& mismatch() const { return mismatch_; }

  // Call it before the first handshake.
  void start_at(const KnownPosition& position) { position_ = position; }
  // Relates the board's counts to that position. Fractions of steps are kept. In all of these functions, `board` is the
  // status at this stop; null: counts are not tracked.
  void stand_at(const KnownPosition& position, const BoardStatus* board);
  // The board starts counting at zero.
  void forget_board() { on_board_.reset(); }
  // Marks the position as doubtful. The previous trust is kept, because the board's counts may still confirm the
  // position, even after a failed reset.
  void doubt();
  // Processes the reported counts. `has_counted`: the board has continued counting, and has lost no step, so its counts
  // determine the position.
  void find_again(const BoardStatus& board, bool has_counted);
  // Sets the position at the end of a motion.
  void rest_at(const BoardPosition& place, AxisSet downs);
  // Returns false if the counts differ from the commanded position. This is reported once; later counts are compared
  // from there on.
  [[nodiscard]] bool agrees_with(const BoardStatus* board);
  // Sets the positions of homed axes from their switches. The other axes keep their positions.
  void home(const std::vector<HomedAxis>& homed, const BoardStatus* board);

  Point point_of(const BoardPosition& place, AxisSet downs) const;

 private:
  void count_from_here(const BoardStatus* board);
  MotorSteps steps_of(const BoardPosition& place) const;

  const MachineDescription& machine_;
  KnownPosition position_;
  Trust trust_before_ = Trust::unknown;  // the trust before the position became doubtful
  bool lost_before_ = false;             // and whether it was lost then
  std::optional<BoardPosition> on_board_;
  std::optional<MotorSteps> zero_counts_;
  std::optional<CountMismatch> mismatch_;
};

}  // namespace passo
