// JobLog: the output of a job by (PRINT,…), (MSG,…) and (LOG,…). Bounded. Private to api/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "api_call.hpp"

#include "passo/interpreter/interpreter.hpp"

namespace passo {

class JobLog {
 public:
  // The maximum amount kept per job.
  static constexpr std::size_t most_words = 50'000;
  static constexpr std::size_t longest_words = 200;

  void record(const Operation& operation);
  void clear() { all_.clear(); }
  // Returns the lines of (LOG,…).
  std::string lines() const;
  Json json() const;

 private:
  struct Words {
    std::string_view kind;  // "print", "message" or "log"
    std::uint32_t line = 0;
    std::string text;
  };
  std::vector<Words> all_;
};

}  // namespace passo
