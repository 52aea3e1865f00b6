// StoredPosition: the machine position of a board, stored in a file (PositionRecord) between commands.
#pragma once

#include <optional>
#include <string>

#include "passo/plant/motor_steps.hpp"
#include "passo/session/position_record.hpp"

namespace passo {

class StoredPosition {
 public:
  // Reads the record in the file. Empty path: nothing is stored.
  explicit StoredPosition(std::string path);

  const std::string& path() const { return path_; }
  // Returns the machine position, if it is certain. The status must be that of a stopped board.
  Result<KnownPosition, PositionDoubt> place(const MachineDescription& machine, const BoardStatus& status) const {
    return place_of(record_, machine, status);
  }
  // The same, or otherwise the position from the board's counts only, which is not trusted. Without a record it is
  // machine zero.
  KnownPosition counted(const MachineDescription& machine, const BoardStatus& status) const;
  // Stores the position. Call it before the board receives the numbers, because the board keeps them until it loses
  // power. `zero_counts`: the board's count of each motor at machine zero. Returns false if the file cannot be written,
  // so the next process will not know the machine position. The previous record becomes useless once the board has the
  // new numbers.
  [[nodiscard]] bool keep(const MachineDescription& machine, const KnownPosition& position,
                          const MotorSteps& zero_counts, const SessionNumbers& numbers);

 private:
  std::string path_;
  std::optional<PositionRecord> record_;  // the content of the file
};

}  // namespace passo
