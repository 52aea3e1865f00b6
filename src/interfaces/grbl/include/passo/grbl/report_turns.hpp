// ReportTurns: which status reports show the work offset, and which the overrides. What has changed is shown at once,
// the offset first. Else the two take turns, as in grbl: a report has no room for both.
#pragma once

#include "passo/grbl/grbl_reports.hpp"
#include "passo/session/machine_status.hpp"

namespace passo {

class ReportTurns {
 public:
  // The next report shows the offset, and the one after it the overrides.
  void begin();
  // Sets what this report shows. `rests`: there the turns are shorter, as in grbl.
  void choose(GrblStatus& report, const Overrides& overrides, bool rests);

 private:
  int offset_in_ = 0;  // reports until the work offset is shown again; 0: in the next
  int overrides_in_ = 1;
  Point told_offset_;
  OutputState told_outputs_;
  Overrides told_overrides_;
};

}  // namespace passo
