#include "passo/journal/session_numbers.hpp"

namespace passo {

SessionNumbers::Stage SessionNumbers::stage_of(const BoardStatus& status, bool may_be_early) const {
  if (status.session == session) return Stage::in_session;
  if (!may_be_early) return Stage::another;
  const bool greeted = greeting != 0 && status.session == 0 && status.motors != 0;
  if (greeted && status.executed == greeting) return Stage::before_session;
  const bool as_before = status.session == session_before && status.executed == executed_before;
  return as_before ? Stage::before_hello : Stage::another;
}

}  // namespace passo
