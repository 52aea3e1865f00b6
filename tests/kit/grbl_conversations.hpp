// Conversations with a Grbl machine: what is sent, and what the machine says. One table for StrictGrbl and for the real
// ones: Grbl 1.1h on an emulated Uno and grblHAL's simulator. It was recorded from Grbl 1.1h; where grblHAL differs,
// its own words stand beside.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace passo::test {

// `*` in an answer stands for any characters.
struct GrblTurn {
  std::string_view sent;
  std::string_view answer;         // lines, each with its end as "\n"
  std::string_view grblhal = "=";  // "=": the same; "-": not compared; "!": it is not asked
  std::string_view awaited = {};   // the state in which the machine must be before it is sent, e.g. "Idle"
};
struct GrblConversation {
  std::string_view name;
  bool on_grblhal;
  std::vector<GrblTurn> turns;
};

inline constexpr std::string_view grbl_greeting = "\nGrbl 1.1h ['$' for help]\n";

inline const std::vector<GrblConversation>& grbl_conversations() {
  static const std::vector<GrblConversation> all = {
#include "kit/grbl_conversations.inc"
  };
  return all;
}

// The other end of a conversation.
class GrblTalker {
 public:
  virtual ~GrblTalker() = default;
  // Sends bytes, and returns what the machine says: at least `lines` lines if it says so many, and nothing more within
  // a short time.
  virtual std::string ask(std::string_view bytes, std::size_t lines) = 0;
};

inline bool grbl_matches(std::string_view said, std::string_view pattern) {
  while (!pattern.empty() && pattern.front() != '*') {
    if (said.empty() || said.front() != pattern.front()) return false;
    said.remove_prefix(1);
    pattern.remove_prefix(1);
  }
  if (pattern.empty()) return said.empty();
  pattern.remove_prefix(1);
  for (std::size_t at = 0; at <= said.size(); ++at) {
    if (grbl_matches(said.substr(at), pattern)) return true;
  }
  return false;
}

inline std::string without_returns(std::string text) {
  std::erase(text, '\r');
  return text;
}

// Asks for reports until the machine is in the state.
inline bool await_grbl(GrblTalker& machine, std::string_view state) {
  for (int i = 0; i < 400; ++i) {
    if (without_returns(machine.ask("?", 1)).find("<" + std::string(state)) != std::string::npos) return true;
  }
  return false;
}

inline void hold_conversation(GrblTalker& machine, const GrblConversation& one, bool is_grblhal) {
  machine.ask("\x18", 2);
  machine.ask("$X\n", 1);
  for (const GrblTurn& turn : one.turns) {
    if (is_grblhal && turn.grblhal == "!") continue;
    const std::string where = fmt::format("{}: \"{}\"", one.name, turn.sent);
    if (!turn.awaited.empty()) {
      ASSERT_TRUE(await_grbl(machine, turn.awaited)) << where << " in state " << turn.awaited;
    }
    const std::string_view wanted = is_grblhal && turn.grblhal != "=" ? turn.grblhal : turn.answer;
    const auto ends = static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), '\n'));
    const std::size_t lines = wanted == "-" ? 1 : ends;
    const std::string said = without_returns(machine.ask(turn.sent, lines));
    // After an error grblHAL repeats it until an empty line.
    if (is_grblhal && said.find("error:") != std::string::npos) machine.ask("\n", 1);
    if (wanted == "-") continue;
    EXPECT_TRUE(grbl_matches(said, wanted)) << where << "\nsaid\n" << said << "instead of\n" << wanted;
  }
}

}  // namespace passo::test
