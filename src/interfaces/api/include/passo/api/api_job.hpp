// ApiJob: a program that was asked to run, and what has become of it.
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
  Sentence why;              // of one that failed
  std::int64_t history = 0;  // its number in the history; 0: nobody keeps one
  friend bool operator==(const ApiJob&, const ApiJob&) = default;
};

}  // namespace passo
