// ProgressAhead: how much of a program is executed, by its nominal time. Motion is planned before it is made, a short
// program as a whole: so each planned part is noted with the time at which the board makes it. Private to session/.
#pragma once

#include <deque>

#include "passo/activity/nominal_time.hpp"
#include "passo/base/source.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// Passes a path on. Of the items that are left out at its beginning, it adds up the nominal time.
class LeftOutTime final : public Source<PathItem> {
 public:
  LeftOutTime(Source<PathItem>& path, const MotionLimits& limits, std::uint64_t items)
      : path_(path), limits_(limits), items_(items) {}
  [[nodiscard]] bool next(PathItem& item) override {
    if (!path_.next(item)) return false;
    const auto* segment = std::get_if<Segment>(&item);
    const bool counts = segment == nullptr || segment->curve.has_length();
    if (items_ == 0 || !counts) return true;
    --items_;
    time_ += nominal_time_of(item, limits_);
    return true;
  }
  Seconds time() const { return time_; }

 private:
  Source<PathItem>& path_;
  MotionLimits limits_;
  std::uint64_t items_;
  Seconds time_{0};
};

class ProgressAhead {
 public:
  // What was planned to begin then or later is planned anew.
  void plan(Seconds nominal, Seconds begins, Seconds ends, Seconds now) {
    static_cast<void>(at(now));
    while (!ahead_.empty() && ahead_.back().begins >= begins) ahead_.pop_back();
    if (!ahead_.empty() && ahead_.back().ends > begins) ahead_.back().end_at(begins);
    const Seconds before = ahead_.empty() ? done_ : ahead_.back().to;
    ahead_.push_back({.begins = begins, .ends = ends, .from = before, .to = before + nominal});
  }
  // The nominal time of all that is executed then.
  Seconds at(Seconds time) {
    for (; !ahead_.empty() && ahead_.front().ends <= time; ahead_.pop_front()) done_ = ahead_.front().to;
    return ahead_.empty() || ahead_.front().begins > time ? done_ : ahead_.front().at(time);
  }

 private:
  struct Part {
    Seconds begins{0};
    Seconds ends{0};
    Seconds from{0};  // nominal
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
