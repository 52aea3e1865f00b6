#include "passo/job/cut_recorder.hpp"

namespace passo {

void CutRecorder::begin(request::Start& start, std::string_view run) {
  end();
  meter_ = CutMeter();
  reported_.clear();
  if (start.from) meter_ = CutMeter(start.from->tool, start.from->outputs, start.lead_in.size());
  is_open_ = true;
  run_ = run;
  is_begun_ = records_.begin(machine_, run_);
  records_.keep();
  start.watchers.motion = [this, before = std::move(start.watchers.motion)](const MotionItem& motion) {
    if (before) before(motion);
    meter_.watch(motion);
  };
}

bool CutRecorder::report() {
  is_begun_ = is_begun_ || records_.begin(machine_, run_);
  return is_begun_ && records_.record(machine_, meter_.amounts());
}

void CutRecorder::poll(double now) {
  if (!is_open_ || now - reported_at_ < between_reports || meter_.amounts() == reported_) return;
  reported_at_ = now;
  if (report()) reported_ = meter_.amounts();
}

bool CutRecorder::end() {
  if (!is_open_) return true;
  constexpr int most_attempts = 20;  // another process may be writing
  bool is_written = false;
  for (int i = 0; i < most_attempts && !is_written; ++i) {
    is_written = report() && records_.end(machine_);
  }
  is_open_ = false;
  records_.keep();
  return is_written;
}

}  // namespace passo
