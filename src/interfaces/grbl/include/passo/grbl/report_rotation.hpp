// ReportRotation: selects the status reports that include the work offset, and those that include the overrides. A
// change is shown immediately, the offset first. Otherwise the two alternate, as in grbl: a report has no room for
// both.
#pragma once

#include "passo/grbl/grbl_reports.hpp"
#include "passo/session/machine_status.hpp"

namespace passo {

class ReportRotation {
 public:
  // Starts over: the next report shows the offset, the one after it the overrides.
  void begin();
  // Sets the contents of this report. `rests`: the machine is stopped; the intervals are then shorter, as in grbl.
  void choose(GrblStatus& report, const Overrides& overrides, bool rests);

 private:
  int offset_in_ = 0;  // number of reports until the work offset is shown again; 0: in the next one
  int overrides_in_ = 1;
  Point told_offset_;
  OutputState told_outputs_;
  Overrides told_overrides_;
};

}  // namespace passo
