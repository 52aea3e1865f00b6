// TrackedPlace: where the machine stands, and how far that is certain. What was commanded is compared with what the
// board has counted, and switches may show a place better than counts do.
//
// Invariant: a place whose trust is not `unknown` is as true as the board's counts.
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

// How the board's counts differed from what was commanded.
struct CountMismatch {
  std::size_t motor = 0;
  std::int64_t counted = 0;  // from machine zero
  std::int64_t commanded = 0;
};

class TrackedPlace {
 public:
  // `machine` outlives this.
  TrackedPlace(const MachineDescription& machine, const KnownPosition& start) : machine_(machine), position_(start) {}

  const KnownPosition& position() const { return position_; }
  // Where the board stands, exact below a step. Empty: as after a hello.
  const std::optional<BoardPlace>& on_board() const { return on_board_; }
  // The board's counts at machine zero. Empty: nobody watches them.
  const std::optional<MotorSteps>& zero_counts() const { return zero_counts_; }
  const std::optional<CountMismatch>& mismatch() const { return mismatch_; }

  // Before the first hello.
  void start_at(const KnownPosition& position) { position_ = position; }
  // From here on the board's counts are those of that place. What the board has below a step stays. In all of these,
  // `board` is what the board has told at this rest; null: its counts are not watched.
  void stand_at(const KnownPosition& position, const BoardStatus* board);
  // The board begins to count anew.
  void forget_board() { on_board_.reset(); }
  // The board may not stand where it stood. What the place was trusted for is kept: the board's counts may still prove
  // the place, also after a reset that fails.
  void doubt();
  // The board has told where it is. `has_counted`: it has gone on counting since it was last heard, and has lost no
  // step. Then its counts tell the place.
  void find_again(const BoardStatus& board, bool has_counted);
  // A motion has ended there.
  void rest_at(const BoardPlace& place, AxisSet downs);
  // False: the counts differ from what was commanded. That is told once: what comes after is compared from there on.
  [[nodiscard]] bool agrees_with(const BoardStatus* board);
  // The switches have told where the homed axes stand. The other axes keep their places.
  void home(const std::vector<HomedAxis>& homed, const BoardStatus* board);

  Point point_of(const BoardPlace& place, AxisSet downs) const;

 private:
  void count_from_here(const BoardStatus* board);
  MotorSteps steps_of(const BoardPlace& place) const;

  const MachineDescription& machine_;
  KnownPosition position_;
  Trust trust_before_ = Trust::unknown;  // the trust before the place was doubted
  bool lost_before_ = false;             // and whether it was lost then
  std::optional<BoardPlace> on_board_;
  std::optional<MotorSteps> zero_counts_;
  std::optional<CountMismatch> mismatch_;
};

}  // namespace passo
