// PlaceFile: the file in which this computer keeps a PlaceRecord of a board, from one command to the next.
#pragma once

#include <optional>
#include <string>

#include "passo/session/place_record.hpp"

namespace passo {

class PlaceFile {
 public:
  // `board`: the board's address. Without a folder for state nothing is kept.
  explicit PlaceFile(const std::string& board);

  // The record, if there is a whole one.
  std::optional<PlaceRecord> read() const;
  // Call it before the board hears the record's numbers. If the record cannot be written, a note says so: the record
  // before it is of no use after the numbers were told.
  void write(const PlaceRecord& record) const;

 private:
  std::string path_;  // empty: there is no such folder
};

}  // namespace passo
