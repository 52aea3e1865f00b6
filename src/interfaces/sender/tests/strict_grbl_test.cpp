// StrictGrbl answers as the real ones do (tests/command_line/real_grbl_test.cpp holds them against the same table), and
// loses bytes as they do.
#include "kit/strict_grbl.hpp"

#include <array>

#include "kit/grbl_conversations.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

class StrictTalker final : public test::GrblTalker {
 public:
  StrictTalker() {
    machine_.probe = [](const Point& place) { return place[Axis::z] <= -4; };
    machine_.restart();
    machine_.run(0.01);
    machine_.take_output();
  }
  std::string ask(std::string_view bytes, std::size_t lines) override {
    machine_.receive(bytes);
    std::string said;
    const auto count = [&] { return static_cast<std::size_t>(std::count(said.begin(), said.end(), '\n')); };
    for (double waited = 0; waited < 20 && (waited < 0.02 || count() < lines); waited += 0.005) {
      machine_.run(0.005);
      said += machine_.take_output();
    }
    return said;
  }

 private:
  StrictGrbl machine_;
};

TEST(StrictGrbl, says_in_each_conversation_what_the_real_one_says) {
  for (const test::GrblConversation& one : test::grbl_conversations()) {
    StrictTalker machine;
    test::hold_conversation(machine, one, false);
  }
}

}  // namespace
}  // namespace passo
