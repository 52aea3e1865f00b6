#include "passo/grbl/report_rotation.hpp"

namespace passo {
namespace {

// How many reports lie between two that show the work offset, or the overrides: at rest, and while the machine moves.
constexpr int offset_each_at_rest = 10;
constexpr int offset_each = 30;
constexpr int overrides_each_at_rest = 10;
constexpr int overrides_each = 20;

}  // namespace

void ReportRotation::begin() {
  offset_in_ = 0;
  overrides_in_ = 1;
}

void ReportRotation::choose(GrblStatus& report, const Overrides& overrides, bool rests) {
  const bool has_moved = report.work_offset != told_offset_;
  const bool is_news = report.outputs != told_outputs_ || overrides != told_overrides_;
  report.shows_offset = has_moved || (offset_in_ <= 0 && !is_news);
  report.shows_overrides = !report.shows_offset && (is_news || overrides_in_ <= 0);
  if (report.shows_overrides) {
    told_outputs_ = report.outputs;
    told_overrides_ = overrides;
  }
  offset_in_ = report.shows_offset ? (rests ? offset_each_at_rest : offset_each) - 1 : offset_in_ - 1;
  overrides_in_ = report.shows_overrides ? (rests ? overrides_each_at_rest : overrides_each) - 1 : overrides_in_ - 1;
  if (report.shows_offset) told_offset_ = report.work_offset;
}

}  // namespace passo
