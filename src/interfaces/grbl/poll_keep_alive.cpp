#include "passo/grbl/poll_keep_alive.hpp"

namespace passo {
namespace {

constexpr Seconds lease{0.25};
constexpr Seconds slowest_pace{1};

}  // namespace

void PollKeepAlive::on_question(Seconds now) {
  const bool asks_often = now - asked_at_ <= slowest_pace;
  pace_ = asks_often ? std::optional(now - asked_at_) : std::nullopt;
  asked_at_ = now;
}

bool PollKeepAlive::is_over(Seconds now) const {
  return pace_ && now - heard_at_ > *pace_ + lease;
}

}  // namespace passo
