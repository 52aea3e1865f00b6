// WaitWords: what a program says to the person for whom it waits, at M0, M1 and M6.
//
// The program is read ahead of the machine. So the words of each stop are kept until the machine has passed the stop.
// They are the messages, (MSG,…), since the last feed or stop, the comment of the stop's own line, and, for a tool
// change, the remark of the tool table. The place of a stop is its line: stops are passed in the order in which they
// were read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

class WaitWords {
 public:
  static constexpr std::size_t most_stops = 64;    // the oldest are dropped
  static constexpr std::size_t most_messages = 8;  // the first are dropped
  static constexpr std::size_t longest = 200;      // bytes of each, cut at a character

  // Takes the next operation of the program.
  void watch(const Operation& operation, const ToolTable& tools);
  // The words at the next stop of that line, separated by line ends. Empty: the program says nothing.
  std::string at(std::uint32_t line) const;
  // The machine has passed the stop of that line, and with it all stops before.
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
