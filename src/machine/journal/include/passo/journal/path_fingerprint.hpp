// PathFingerprint: a number that identifies the path of a program, whatever the text, tools and parameters it comes
// from.
#pragma once

#include <cstdint>

#include "passo/base/fingerprint.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class PathFingerprint {
 public:
  // Adds the items in the path's order.
  void add(const PathItem& item);
  std::uint64_t value() const { return of_all_.value(); }

 private:
  void add(const Segment& segment);
  void add(const Action& action);

  Fingerprint of_all_;
};

}  // namespace passo
