// Faulty listings: what circulating programs and texts print for a line, run as they stand, beside the method that they
// were meant to be.
//
//   listing:rounding         round((s/max)*i) in doubles: the quotient is rounded before the multiplication
//   listing:shared-variable  the lean form with one decision variable for all axes, started at +m
//   listing:slope-blocks     slope in blocks; above slope 1 with the remainder and the extra step of the other axis
//   listing:projection       point comparison that ends as soon as the longer axis (X if equal) has arrived
//
// docs/interpolation/errata.md tells what each gets wrong, and why.
#pragma once

#include <memory>
#include <optional>

#include "passo/study/method.hpp"

namespace passo {

// The longest move of a listing, in steps per axis. Up to here doubles only miss ties, and no 32-bit sum overflows.
inline constexpr std::int64_t longest_listed = 1'000'000;

// Starts a listing on a checked line. Fails with the reason if the listing has no pulses for it.
Result<std::unique_ptr<PulseSource>, std::string> start_listing(const Method& listing, const StepMove& move);

// Compares the pulses of a listing with those of right_method_of() as they come.
class ListingCheck {
 public:
  // `move` must be one on which the listing starts, and must outlive the check.
  ListingCheck(const Method& listing, const StepMove& move);
  // Takes the next pulse of the listing. Returns whether the right method makes another pulse there, or none.
  bool is_wrong(Pulse pulse);
  // Call it after the last pulse: if all were right, the next one may be missing.
  void end();

  const Place& place() const { return place_; }              // of the listing
  const Place& right_place() const { return right_place_; }  // of the right method after as many pulses
  std::int64_t pulses() const { return pulses_; }
  std::int64_t wrong() const { return wrong_; }
  std::int64_t first_wrong() const { return first_wrong_; }  // the number of the first wrong or missing pulse; 0: none
  // Returns the result in words, e.g. "pulse 8 is missing; it ends at (4, 3) instead of (4, 4)".
  std::string describe() const;

 private:
  const StepMove& move_;
  std::unique_ptr<PulseSource> right_;
  Place place_;
  Place right_place_;
  std::int64_t pulses_ = 0;
  std::int64_t wrong_ = 0;
  std::int64_t first_wrong_ = 0;
};

// Runs the whole listing.
Result<ListingCheck, std::string> check_listing(const Method& listing, const StepMove& move);

}  // namespace passo
