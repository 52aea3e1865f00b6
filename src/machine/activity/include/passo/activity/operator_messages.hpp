// OperatorMessages: the messages of a program for the operator at its stops: M0, M1 and M6.
//
// The program is read ahead of the machine. So the messages of each stop are kept until the machine has passed the
// stop. They are the (MSG,…) comments since the last feed or stop, the comment on the stop's own line, and, for a tool
// change, the remark of the tool table. A stop is identified by its line: stops are passed in the order in which they
// were read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

class OperatorMessages {
 public:
  static constexpr std::size_t most_stops = 64;    // the oldest are dropped
  static constexpr std::size_t most_messages = 8;  // the first are dropped
  static constexpr std::size_t longest = 200;      // bytes of each message, truncated at a character

  // Processes the next operation of the program.
  void watch(const Operation& operation, const ToolTable& tools);
  // Returns the messages of the next stop on that line, separated by line ends. Empty: there are none.
  std::string at(std::uint32_t line) const;
  // Call when the machine has passed the stop on that line. Earlier stops are dropped too.
  void pass(std::uint32_t line);

 private:
  struct Stop {
    std::uint32_t line = 0;
    std::string words;
  };
  void say(std::string_view text);
  void stop(std::uint32_t line, std::string_view remark);

  std::vector<Stop> stops_;
  std::vector<std::string> messages_;
  std::string comment_;
  std::uint32_t comment_line_ = 0;
};

}  // namespace passo
