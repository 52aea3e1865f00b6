// FarmStore: which program is proven on which machine file.
#include "farm_store_rows.hpp"
#include "store_transaction.hpp"

namespace passo {

// Programs and machine files that were checked by another version of Passo are checked again.
FarmStore::Answer<std::int64_t> FarmStore::want_checks() {
  const auto wanted = database_->execute(
      "INSERT INTO checks (program, machine_file, passo, state, planned_s, findings, worker, taken_until)"
      " SELECT DISTINCT jobs.program, machines.machine_file, $1, $2, 0.0, '', '', 0.0 FROM jobs CROSS JOIN machines"
      " WHERE jobs.state = $3 ON CONFLICT (program, machine_file, passo) DO NOTHING RETURNING program",
      {passo_, number_of(CheckState::wanted), number_of(FarmJobState::open)});
  if (!wanted) return Failure{store_error(wanted.error())};
  return static_cast<std::int64_t>(wanted->size());
}

FarmStore::Answer<std::optional<CheckOrder>> FarmStore::take_check(const std::string& worker, double now,
                                                                   double lease) {
  using Order = std::optional<CheckOrder>;
  return in_transaction(*database_, [&](Database& within) -> Answer<Order> {
    const auto found = within.execute(
        "SELECT program, machine_file FROM checks WHERE passo = $1 AND (state = $2 OR (state = $3 AND taken_until <= "
        "$4))"
        " ORDER BY state, taken_until LIMIT 1" +
            std::string(within.skip_locked()),
        {passo_, number_of(CheckState::wanted), number_of(CheckState::taken), now});
    if (!found) return Failure{store_error(found.error())};
    if (found->empty()) return Order();
    const CheckOrder order{.program = found->front().text(0), .machine_file = found->front().text(1)};
    const auto taken = within.execute(
        "UPDATE checks SET state = $4, worker = $5, taken_until = $6 WHERE program = $1 AND machine_file = $2 AND "
        "passo = $3",
        {order.program, order.machine_file, passo_, number_of(CheckState::taken), worker, now + lease});
    if (!taken) return Failure{store_error(taken.error())};
    return Order(order);
  });
}

FarmStore::Answer<Unit> FarmStore::finish_check(const CheckOrder& order, const CheckOutcome& outcome) {
  const auto finished = database_->execute(
      "UPDATE checks SET state = $4, planned_s = $5, findings = $6 WHERE program = $1 AND machine_file = $2 AND passo "
      "= $3",
      {order.program, order.machine_file, passo_, number_of(outcome.good ? CheckState::good : CheckState::bad),
       outcome.planned_s, outcome.findings});
  if (!finished) return Failure{store_error(finished.error())};
  return Unit{};
}

}  // namespace passo
