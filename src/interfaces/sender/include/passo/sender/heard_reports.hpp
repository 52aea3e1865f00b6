// HeardReports: the last status report of a machine, when it came, and the offset of the work, which a machine tells in
// few of its reports.
#pragma once

#include <optional>

#include "passo/sender/grbl_machine.hpp"
#include "passo/sender/grbl_reply.hpp"
#include "passo/units/units.hpp"

namespace passo {

class HeardReports {
 public:
  // True: the machine is in another state or at another place than before.
  bool hear(const GrblReport& report, Seconds now);
  const std::optional<GrblReport>& last() const { return last_; }
  void forget_last() { last_.reset(); }
  bool came_after(Seconds time) const { return last_ && came_ > time; }
  // The report came before something that it says nothing of: came_after() is false until the next one.
  void outdate() { came_ = Seconds(-1); }
  Seconds came() const { return came_; }
  // Where the machine stands, in machine coordinates, mm. Empty: not known yet.
  std::optional<Point> place(const GrblMachine& machine) const;

 private:
  std::optional<GrblReport> last_;
  std::optional<Point> offset_;
  Seconds came_{-1};
};

}  // namespace passo
