#include "passo/path/backlash_compensator.hpp"

#include <algorithm>
#include <utility>

#include "backlash_overlap.hpp"
#include "backlash_stops.hpp"

namespace passo {

class BacklashCompensator::Implementation {
 public:
  Implementation(Source<PathItem>& path, const BacklashOptions& options)
      : stops(path, options), overlap(stops, options) {}

  BacklashStops stops;
  BacklashOverlap overlap;
};

BacklashCompensator::BacklashCompensator(Source<PathItem>& path, const BacklashOptions& options) : path_(path) {
  const bool any = std::ranges::any_of(options.backlash.values, [](double backlash) { return backlash > 0; });
  if (any) implementation_ = std::make_unique<Implementation>(path, options);
}

BacklashCompensator::~BacklashCompensator() = default;

void BacklashCompensator::ask_after_probe(std::function<BacklashAtRest()> at_rest) {
  if (implementation_) implementation_->stops.ask_after_probe(std::move(at_rest));
}

bool BacklashCompensator::next(PathItem& item) {
  return implementation_ ? implementation_->overlap.next(item) : path_.next(item);
}

}  // namespace passo
