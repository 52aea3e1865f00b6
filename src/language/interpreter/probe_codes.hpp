// ProbeCodes: probing, G38.2 to G38.5. On a machine the program waits for the result of a probe move.
#pragma once

#include <optional>

#include "code_family.hpp"

namespace passo {

class ProbeCodes : private CodeFamily {
 public:
  explicit ProbeCodes(BlockContext& block) : CodeFamily(block) {}

  bool probe(CodeNumber code);
  // Returns whether the program waits for the result of the last probe move.
  bool awaits_outcome() const { return awaited_.has_value(); }
  void apply_outcome();

 private:
  bool check(CodeNumber code);
  void keep_result(const Point& place, bool touched);
  Point preview_backoff(const Point& start, const Point& end) const;

  std::optional<CodeNumber> awaited_;
};

}  // namespace passo
