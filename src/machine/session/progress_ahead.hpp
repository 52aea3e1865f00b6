// ProgressAhead: the executed fraction of a program, by its nominal time. Motion is planned ahead, in a short program
// as a whole, so each planned part is recorded with the time at which the board executes it. Private to session/.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <variant>
#include <vector>

#include "passo/activity/nominal_time.hpp"
#include "passo/base/source.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// Passes a path on, and adds up the nominal time of everything skipped before the point where the motion begins.
class SkippedTime final : public Source<PathItem> {
 public:
  SkippedTime(Source<PathItem>& path, const MotionLimits& limits, const PathPosition& begin)
      : path_(path), limits_(limits), items_(begin.item), left_out_(begin.s) {}
  [[nodiscard]] bool next(PathItem& item) override {
    if (!path_.next(item)) return false;
    const auto* segment = std::get_if<Segment>(&item);
    const bool counts = segment == nullptr || segment->curve.has_length();
    if (!counts) return true;
    if (items_ > 0) {
      --items_;
      time_ += nominal_time_of(item, limits_);
    } else if (segment != nullptr && left_out_ > Mm(0)) {
      time_ += nominal_time_of(item, limits_) * std::min(left_out_ / segment->curve.length(), 1.0);
      left_out_ = Mm(0);
    }
    return true;
  }
  Seconds time() const { return time_; }

 private:
  Source<PathItem>& path_;
  MotionLimits limits_;
  std::uint64_t items_;  // number of items still to be skipped
  Mm left_out_;          // to be skipped of the item after them
  Seconds time_{0};
};

class ProgressAhead {
 public:
  // The lead-in to the program's path is not part of the program.
  void begin_with(const std::vector<PathItem>& lead_in, const MotionLimits& limits) {
    for (const PathItem& item : lead_in) done_ = done_ - nominal_time_of(item, limits);
  }
  // Motion planned earlier to begin at that time or later is planned again, and replaced.
  void plan(Seconds nominal, Seconds begins, Seconds ends, Seconds now) {
    static_cast<void>(at(now));
    while (!ahead_.empty() && ahead_.back().begins >= begins) ahead_.pop_back();
    if (!ahead_.empty() && ahead_.back().ends > begins) ahead_.back().end_at(begins);
    const Seconds before = ahead_.empty() ? done_ : ahead_.back().to;
    ahead_.push_back({.begins = begins, .ends = ends, .from = before, .to = before + nominal});
  }
  // Returns the nominal time of the motion executed at that time; negative in a lead-in.
  Seconds at(Seconds time) {
    for (; !ahead_.empty() && ahead_.front().ends <= time; ahead_.pop_front()) done_ = ahead_.front().to;
    return ahead_.empty() || ahead_.front().begins > time ? done_ : ahead_.front().at(time);
  }

 private:
  struct Part {
    Seconds begins{0};
    Seconds ends{0};
    Seconds from{0};  // nominal time
    Seconds to{0};
    Seconds at(Seconds time) const { return from + (to - from) * ((time - begins) / (ends - begins)); }
    void end_at(Seconds time) {
      to = at(time);
      ends = time;
    }
  };
  std::deque<Part> ahead_;
  Seconds done_{0};
};

}  // namespace passo
