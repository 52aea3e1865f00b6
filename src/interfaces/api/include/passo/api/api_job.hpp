// ApiJob: a program requested to run, and its outcome.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "passo/base/sentence.hpp"

namespace passo {

enum class JobState : std::uint8_t { none, checking, running, done, stopped, failed, interrupted };
std::string_view name_of(JobState state);

struct ApiJob {
  std::uint64_t id = 0;
  std::uint64_t program = 0;
  std::string name;
  JobState state = JobState::none;
  Sentence why;              // reason of a failure
  std::int64_t history = 0;  // its number in the history; 0: there is no history
  friend bool operator==(const ApiJob&, const ApiJob&) = default;
};

}  // namespace passo
