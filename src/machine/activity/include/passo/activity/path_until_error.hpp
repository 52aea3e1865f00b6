// PathUntilError: passes a path on until there is an error. At an error, the path ends before the current item, all
// outputs are switched off, and motion stops.
#pragma once

#include "passo/base/source.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class PathUntilError final : public Source<PathItem> {
 public:
  // `path` and `diagnostics` must outlive the PathUntilError.
  PathUntilError(Source<PathItem>& path, const Diagnostics& diagnostics) : path_(path), diagnostics_(diagnostics) {}

  [[nodiscard]] bool next(PathItem& item) override {
    if (ended_) return false;
    const bool more = path_.next(item);
    if (!diagnostics_.any_error()) return more;
    ended_ = true;
    item = Action{.kind = Action::Kind::program_end};
    return true;
  }

 private:
  Source<PathItem>& path_;
  const Diagnostics& diagnostics_;
  bool ended_ = false;
};

}  // namespace passo
