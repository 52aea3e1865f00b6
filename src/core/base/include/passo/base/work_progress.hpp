// WorkProgress: how much of a long computation is done, as a share from 0 to 1.
//
// A computation is given the part of the whole that it stands for, and passes smaller parts to its own stages. What
// arrives at the sink only grows, whatever the stages say. Copies are cheap, and report to the same sink.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

namespace passo {

class WorkProgress {
 public:
  using Sink = std::function<void(double share)>;

  // Nobody listens.
  WorkProgress() = default;
  explicit WorkProgress(Sink sink) : whole_(std::make_shared<Whole>(std::move(sink))) {}

  // This share of the part is done.
  void update(double share) const {
    if (whole_ == nullptr) return;
    const double inside = share > 0 ? std::min(1.0, share) : 0.0;
    const double done = std::min(1.0, from_ + width_ * inside);
    if (!(done > whole_->done)) return;
    whole_->done = done;
    whole_->sink(done);
  }
  void operator()(double share) const { update(share); }

  // The part of this part between two shares of it.
  WorkProgress part(double from, double to) const {
    WorkProgress inner = *this;
    inner.from_ = from_ + width_ * from;
    inner.width_ = width_ * (to - from);
    return inner;
  }
  // Stage `index` of so many that take about the same time.
  WorkProgress stage(std::size_t index, std::size_t count) const {
    const auto all = static_cast<double>(std::max<std::size_t>(1, count));
    return part(static_cast<double>(index) / all, static_cast<double>(index + 1) / all);
  }

 private:
  struct Whole {
    explicit Whole(Sink to) : sink(std::move(to)) {}
    Sink sink;
    double done = 0;
  };
  std::shared_ptr<Whole> whole_;
  double from_ = 0;
  double width_ = 1;
};

}  // namespace passo
