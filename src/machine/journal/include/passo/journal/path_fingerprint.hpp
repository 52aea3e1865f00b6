// PathFingerprint: a hash that identifies the path of a program, independent of the text, tools and parameters that
// produce it.
#pragma once

#include <cstdint>

#include "passo/base/fingerprint.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class PathFingerprint {
 public:
  // Adds the items in the order of the path.
  void add(const PathItem& item);
  std::uint64_t value() const { return of_all_.value(); }

 private:
  void add(const Segment& segment);
  void add(const Action& action);

  Fingerprint of_all_;
};

}  // namespace passo
