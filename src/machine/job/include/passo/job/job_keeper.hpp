// JobKeeper: where the journal of a job is kept, and how the board hears the number by which it knows the job.
#pragma once

#include <cstdint>
#include <string>

#include "passo/journal/journal.hpp"

namespace passo {

class JobKeeper {
 public:
  virtual ~JobKeeper() = default;
  virtual JournalStore& store() = 0;
  // The journal's text. Empty: there is none.
  virtual std::string read() = 0;
  // Why the journal could not be written last.
  virtual std::string trouble() { return {}; }
  virtual double noted_at() = 0;  // when it was last written; seconds since 1970
  // Removes the journal.
  virtual void remove() = 0;
  // A number for a session that is not the board's present one.
  virtual std::uint16_t new_number() = 0;
  // Sends the board its new number, while it is stopped.
  virtual void name_session(std::uint16_t number) = 0;
};

}  // namespace passo
