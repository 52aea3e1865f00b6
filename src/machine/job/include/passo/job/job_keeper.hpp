// JobKeeper: the storage of a job's journal, and the way to give the board the session number that identifies the job.
#pragma once

#include <cstdint>
#include <string>

#include "passo/journal/journal.hpp"

namespace passo {

class JobKeeper {
 public:
  virtual ~JobKeeper() = default;
  virtual JournalStore& store() = 0;
  // Returns the journal's text. Empty: there is none.
  virtual std::string read() = 0;
  // Returns the last write error.
  virtual std::string trouble() { return {}; }
  virtual double noted_at() = 0;  // time of the last write; seconds since 1970
  // Removes the journal.
  virtual void remove() = 0;
  // Returns a session number that differs from the board's present one.
  virtual std::uint16_t new_number() = 0;
  // Sends the board its new number, while it is stopped.
  virtual void name_session(std::uint16_t number) = 0;
};

}  // namespace passo
