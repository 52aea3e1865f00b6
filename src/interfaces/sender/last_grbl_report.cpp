#include "passo/sender/last_grbl_report.hpp"

namespace passo {

bool LastGrblReport::hear(const GrblReport& report, Seconds now) {
  if (report.work_offset) offset_ = report.work_offset;
  const bool is_news = !last_ || report.state != last_->state || report.machine_place != last_->machine_place ||
                       report.work_place != last_->work_place;
  last_ = report;
  came_ = now;
  return is_news;
}

std::optional<Point> LastGrblReport::place(const GrblMachine& machine) const {
  if (!last_) return {};
  if (last_->machine_place) return machine.millimetres(*last_->machine_place);
  if (!last_->work_place) return {};
  if (offset_) return machine.millimetres(*last_->work_place + *offset_);
  // A machine whose reports ($10) tell no offset: from its own offsets.
  const auto zero = machine.work_zero();
  if (!zero) return {};
  return machine.millimetres(*last_->work_place) + *zero;
}

}  // namespace passo
