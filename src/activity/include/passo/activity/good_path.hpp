// GoodPath: the path as long as nothing is wrong with it. At an error it ends before the item at hand, with everything
// switched off: what was given already ends at rest there.
#pragma once

#include "passo/base/source.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class GoodPath final : public Source<PathItem> {
 public:
  // Both outlive it.
  GoodPath(Source<PathItem>& path, const Diagnostics& diagnostics) : path_(path), diagnostics_(diagnostics) {}

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
