// LastGrblReport: the last status report received from a Grbl machine, its time, and the work offset, which a machine
// includes in only few of its reports.
#pragma once

#include <optional>

#include "passo/sender/grbl_machine.hpp"
#include "passo/sender/grbl_reply.hpp"
#include "passo/units/units.hpp"

namespace passo {

class LastGrblReport {
 public:
  // Adds a report. Returns true if the state or the position of the machine has changed.
  bool hear(const GrblReport& report, Seconds now);
  const std::optional<GrblReport>& last() const { return last_; }
  void forget_last() { last_.reset(); }
  bool came_after(Seconds time) const { return last_ && came_ > time; }
  // Marks the last report as outdated by a later event: came_after() is false until the next report.
  void outdate() { came_ = Seconds(-1); }
  Seconds came() const { return came_; }
  // Returns the machine position, in mm. Empty: not known yet.
  std::optional<Point> place(const GrblMachine& machine) const;

 private:
  std::optional<GrblReport> last_;
  std::optional<Point> offset_;
  Seconds came_{-1};
};

}  // namespace passo
