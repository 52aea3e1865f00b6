#include "passo/study/faulty_listing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/base/counted.hpp"
#include "passo/study/measure.hpp"

namespace passo {
namespace {

// What all listings share: they count from the start in the direction of travel.
class Listing : public PulseSource {
 public:
  explicit Listing(const StepMove& move) {
    for (std::size_t axis = 0; axis < move.axes(); ++axis) {
      const std::int64_t distance = move.to[axis] - move.from[axis];
      lengths_.push_back(std::abs(distance));
      if (distance < 0) directions_ = static_cast<std::uint8_t>(directions_ | 1U << axis);
      longest_ = std::max(longest_, std::abs(distance));
    }
  }

 protected:
  static std::uint8_t bit(std::size_t axis) { return static_cast<std::uint8_t>(1U << axis); }
  Pulse pulse(std::uint8_t steps) const { return {steps, static_cast<std::uint8_t>(steps & directions_)}; }

  std::vector<std::int64_t> lengths_;
  std::int64_t longest_ = 0;

 private:
  std::uint8_t directions_ = 0;
};

class RoundingListing : public Listing {
 public:
  explicit RoundingListing(const StepMove& move) : Listing(move), listed_(move.axes(), 0) {}
  bool done() const override { return i_ == longest_; }
  Pulse next() override {
    ++i_;
    std::uint8_t steps = 0;
    for (std::size_t axis = 0; axis < lengths_.size(); ++axis) {
      const double quotient = static_cast<double>(lengths_[axis]) / static_cast<double>(longest_);
      const auto now = static_cast<std::int64_t>(std::round(quotient * static_cast<double>(i_)));
      if (now != listed_[axis]) steps = static_cast<std::uint8_t>(steps | bit(axis));
      listed_[axis] = now;
    }
    return pulse(steps);
  }
  void decisions(std::vector<std::int64_t>& values) const override { values.clear(); }
  std::vector<std::string> decision_names() const override { return {}; }

 private:
  std::vector<std::int64_t> listed_;
  std::int64_t i_ = 0;
};

class SharedVariableListing : public Listing {
 public:
  explicit SharedVariableListing(const StepMove& move) : Listing(move), left_(longest_), decision_(longest_) {}
  bool done() const override { return left_ == 0; }
  Pulse next() override {
    --left_;
    std::uint8_t steps = 0;
    for (std::size_t axis = 0; axis < lengths_.size(); ++axis) {
      decision_ += 2 * lengths_[axis];
      if (decision_ < 0) continue;
      steps = static_cast<std::uint8_t>(steps | bit(axis));
      decision_ -= 2 * longest_;
    }
    return pulse(steps);
  }
  void decisions(std::vector<std::int64_t>& values) const override { values.assign({decision_}); }
  std::vector<std::string> decision_names() const override { return {"decision"}; }

 private:
  std::int64_t left_;
  std::int64_t decision_;
};

// Below slope 1 the listing is right. Above it the blocks are those of the quotient dy div dx, as they must be, but
// their number of extra steps is dx mod dy, and each is one of X.
class SlopeBlocksListing : public Listing {
 public:
  explicit SlopeBlocksListing(const StepMove& move)
      : Listing(move),
        is_steep_(lengths_[1] > lengths_[0]),
        quotient_(longest_ / lengths_[is_steep_ ? 0 : 1]),
        blocks_(lengths_[is_steep_ ? 0 : 1]),
        extra_(lengths_[0] % lengths_[1]) {}
  bool done() const override { return blocks_ == 0; }
  Pulse next() override {
    const std::uint8_t plain = is_steep_ ? 2 : 1;
    const std::int64_t at = in_block_++;
    if (in_block_ >= quotient_ + (extra_ > 0 ? 1 : 0)) {
      in_block_ = 0;
      --blocks_;
    }
    if (at == quotient_) {
      --extra_;
      return pulse(1);
    }
    return pulse(at == quotient_ / 2 ? 3 : plain);
  }
  void decisions(std::vector<std::int64_t>& values) const override { values.assign({blocks_, extra_}); }
  std::vector<std::string> decision_names() const override { return {"blocks", "m"}; }

 private:
  bool is_steep_;
  std::int64_t quotient_;
  std::int64_t blocks_;  // still to come
  std::int64_t extra_;   // the listing's m
  std::int64_t in_block_ = 0;
};

class ProjectionListing : public Listing {
 public:
  explicit ProjectionListing(const StepMove& move)
      : Listing(move), counted_(lengths_[0] >= lengths_[1] ? 0 : 1), left_(longest_) {}
  bool done() const override { return left_ == 0; }
  Pulse next() override {
    const std::size_t axis = deviation_ >= 0 ? 0 : 1;
    deviation_ += axis == 0 ? -lengths_[1] : lengths_[0];
    if (axis == counted_) --left_;
    return pulse(bit(axis));
  }
  void decisions(std::vector<std::int64_t>& values) const override { values.assign({deviation_}); }
  std::vector<std::string> decision_names() const override { return {"deviation"}; }

 private:
  std::size_t counted_;
  std::int64_t left_;
  std::int64_t deviation_ = 0;
};

std::string coordinates(const Place& place) {
  return fmt::format("({})", fmt::join(place, ", "));
}

}  // namespace

Result<std::unique_ptr<PulseSource>, std::string> start_listing(const Method& listing, const StepMove& move) {
  std::size_t axes_that_move = 0;
  for (std::size_t axis = 0; axis < move.axes(); ++axis) {
    const std::int64_t length = std::abs(move.to[axis] - move.from[axis]);
    if (length > longest_listed) return Failure{fmt::format("is for moves of at most {} steps", longest_listed)};
    if (length != 0) ++axes_that_move;
  }
  using Started = std::unique_ptr<PulseSource>;
  if (listing.name == MethodName::listing_rounding) return Started(std::make_unique<RoundingListing>(move));
  if (listing.name == MethodName::listing_shared_variable) {
    return Started(std::make_unique<SharedVariableListing>(move));
  }
  if (move.axes() != 2) return Failure{fmt::format("is for two axes, but the move has {}", move.axes())};
  if (listing.name == MethodName::listing_projection) return Started(std::make_unique<ProjectionListing>(move));
  if (axes_that_move != 2) return Failure{std::string("divides by zero if an axis does not move")};
  return Started(std::make_unique<SlopeBlocksListing>(move));
}

ListingCheck::ListingCheck(const Method& listing, const StepMove& move)
    : move_(move), place_(move.from), right_place_(move.from) {
  right_ = std::move(*start(*right_method_of(listing), move));
}

bool ListingCheck::is_wrong(Pulse pulse) {
  ++pulses_;
  apply(pulse, place_);
  const Pulse right = right_->done() ? Pulse{} : right_->next();
  apply(right, right_place_);
  if (pulse.steps == right.steps) return false;
  if (wrong_ == 0) first_wrong_ = pulses_;
  ++wrong_;
  return true;
}

void ListingCheck::end() {
  if (wrong_ == 0 && !right_->done()) first_wrong_ = pulses_ + 1;
}

std::string ListingCheck::describe() const {
  const std::string pulses = counted(pulses_, "pulse");
  std::string text = fmt::format("pulse {} is the first wrong one; wrong are {} of {}", first_wrong_, wrong_, pulses);
  if (first_wrong_ == 0) text = fmt::format("no pulse of {} is wrong", pulses_);
  if (first_wrong_ > pulses_) text = fmt::format("pulse {} is missing", first_wrong_);
  if (place_ == move_.to) return text + "; it ends at " + coordinates(place_) + ", as it should";
  return text + fmt::format("; it ends at {} instead of {}", coordinates(place_), coordinates(move_.to));
}

Result<ListingCheck, std::string> check_listing(const Method& listing, const StepMove& move) {
  auto source = start(listing, move);
  if (!source) return Failure{source.error()};
  ListingCheck check(listing, move);
  while (!(*source)->done()) check.is_wrong((*source)->next());
  check.end();
  return check;
}

}  // namespace passo
