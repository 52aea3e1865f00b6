// KeptPlace: the machine position of a board, kept in a file (PlaceRecord) from one command to the next.
#pragma once

#include <optional>
#include <string>

#include "passo/plant/motor_steps.hpp"
#include "passo/session/place_record.hpp"

namespace passo {

class KeptPlace {
 public:
  // Reads the record in the file. Empty path: nothing is kept.
  explicit KeptPlace(std::string path);

  const std::string& path() const { return path_; }
  // The machine position, if it is certain. The status must be one at rest.
  Result<KnownPosition, PlaceDoubt> place(const MachineDescription& machine, const BoardStatus& status) const {
    return place_of(record_, machine, status);
  }
  // The same, or else the place by the board's counts alone, which is not trusted. Without a record it is machine zero.
  KnownPosition counted(const MachineDescription& machine, const BoardStatus& status) const;
  // Call it before the board hears the numbers, for what a board has heard it does not forget as long as it has power.
  // `zero_counts`: the board's count of each motor at machine zero. False: the file cannot be written, so the next
  // program will not know the machine position. The record before is of no use after the numbers were told.
  [[nodiscard]] bool keep(const MachineDescription& machine, const KnownPosition& position,
                          const MotorSteps& zero_counts, const SessionNumbers& numbers);

 private:
  std::string path_;
  std::optional<PlaceRecord> record_;  // as it is in the file
};

}  // namespace passo
