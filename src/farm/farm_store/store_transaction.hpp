// in_transaction(): one call of FarmStore as one transaction. Private to farm_store/.
#pragma once

#include <optional>
#include <utility>

#include "passo/farm_store/farm_store.hpp"

namespace passo {

inline StoreError store_error(const DatabaseError& error) {
  switch (error.kind) {
    case DatabaseError::Kind::unreachable: return {StoreRefusal::unreachable, error.text};
    case DatabaseError::Kind::conflict: return {StoreRefusal::conflict, error.text};
    default: return {StoreRefusal::failed, error.text};
  }
}

// What transact() has to know of a refusal: whether it is worth another try.
inline DatabaseError database_error(const StoreError& error) {
  switch (error.refusal) {
    case StoreRefusal::unreachable: return {DatabaseError::Kind::unreachable, error.text};
    case StoreRefusal::conflict: return {DatabaseError::Kind::conflict, error.text};
    default: return {DatabaseError::Kind::other, error.text};
  }
}

inline Failure<StoreError> refuse(StoreRefusal refusal) {
  return Failure{StoreError{.refusal = refusal}};
}

// `work`: Database& -> FarmStore::Answer<T>. A refusal rolls back.
template <class Work>
auto in_transaction(Database& database, const Work& work) -> decltype(work(database)) {
  std::optional<decltype(work(database))> answer;
  const Database::Done done = database.transact([&](Database& within) -> Database::Done {
    answer.reset();
    answer.emplace(work(within));
    if (*answer) return Unit{};
    return Failure{database_error(answer->error())};
  });
  if (answer && (done || !*answer)) return *std::move(answer);
  return Failure{store_error(done.error())};
}

}  // namespace passo
