// The rows of the tables as values, and back. Private to farm_store/.
#pragma once

#include <string>

#include "passo/farm_store/farm_store.hpp"

namespace passo {

// Words in one column: each with its line feed.
std::string joined(const Words& words);
Words split(const std::string& column);
// Sorts, and removes what is there twice or empty.
Words in_order(Words words);
bool has_all(const Words& words, const Words& wanted);

// The columns of machine_of(), job_of() and attempt_of(), in their order.
extern const std::string machine_columns;
extern const std::string job_columns;
extern const std::string attempt_columns;
FarmMachine machine_of(const Row& row);
FarmJob job_of(const Row& row);
Attempt attempt_of(const Row& row);

template <class State>
std::int64_t number_of(State state) {
  return static_cast<std::int64_t>(state);
}

}  // namespace passo
