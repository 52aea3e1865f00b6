// Macros on the buttons of a board over a line, in virtual time.
#include <filesystem>
#include <fstream>
#include <string>

#include "kit/example_machine.hpp"
#include "kit/scratch_folder.hpp"
#include "pipeline/session_kit.hpp"
#include <nlohmann/json.hpp>

#include "passo/api/web_api.hpp"
#include "passo/wire/message.hpp"

namespace passo::test {
namespace {

using Json = nlohmann::ordered_json;

std::string folder_of_input_macros() {
  const std::filesystem::path folder = scratch_folder();
  std::ofstream(folder / "up.ngc")
      << "; title = \"Up\"\n; input = \"cycle_start\"\n; [value.way]\n; least = 1\n; most = 9\n"
         "; default = 4\nG21 G91 G0 Z#<way>\n";
  std::ofstream(folder / "far.ngc") << "; title = \"Far\"\n; input = \"feed_hold\"\nG53 G0 X4000\n";
  return folder.string();
}

class AtBoard {
 public:
  explicit AtBoard(std::uint16_t held = 0)
      : run(example_machine("router"), {.line = true}),
        api(run.description(), run.session(), owner,
            {.version = "1",
             .openapi = "{}",
             .make_key = [] { return std::string("key"); },
             .macro_folder = folder_of_input_macros()}) {
    run.another_takes_changes = true;
    run.board().set_switch(held, true);
    pass(Seconds(3));
    EXPECT_EQ(run.state(), MachineState::idle);
  }
  void pass(Seconds time) {
    for (const Seconds end = run.now() + time; run.now() < end;) {
      run.session().poll(Seconds(0.005));
      api.on_change(run.session().take_changes());
      api.poll();
    }
  }
  void press(std::uint16_t button, Seconds time = Seconds(0.1)) {
    run.board().set_switch(button, true);
    pass(time);
    run.board().set_switch(button, false);
    pass(Seconds(0.3));
  }
  Json ask(const std::string& method, const std::string& path, const std::string& body = "") {
    const WebAnswer answer = api.answer({.method = method, .path = "/api/v1" + path, .key = "key", .body = body});
    return Json::parse(answer.body, nullptr, false);
  }
  double z() { return run.session().status().position.place[Axis::z]; }

  SessionRun run;
  MachineControl owner;
  WebApi api;
};

TEST(InputMacros, start_when_a_button_is_pressed_at_an_idle_machine) {
  AtBoard at;
  at.press(input_start);
  at.pass(Seconds(2));
  EXPECT_EQ(at.api.job().name, "macro up");
  EXPECT_EQ(at.api.job().state, JobState::done);
  EXPECT_NEAR(at.z(), 4, 0.002);
  at.press(input_start, Seconds(3));
  EXPECT_NEAR(at.z(), 8, 0.002) << "once, however long it is pressed";
}

TEST(InputMacros, are_checked_before_anything_moves) {
  AtBoard at;
  at.press(input_hold);
  at.pass(Seconds(1));
  EXPECT_EQ(at.api.job().state, JobState::failed) << "it leaves the travel";
  EXPECT_EQ(at.run.steps_made(), 0);
}

TEST(InputMacros, do_not_start_for_a_button_that_is_held_at_the_start) {
  AtBoard at(input_start);
  at.pass(Seconds(3));
  EXPECT_EQ(at.run.steps_made(), 0);
  at.run.board().set_switch(input_start, false);
  at.pass(Seconds(0.5));
  EXPECT_EQ(at.run.steps_made(), 0);
  at.press(input_start);
  at.pass(Seconds(2));
  EXPECT_NEAR(at.z(), 4, 0.002);
}

TEST(InputMacros, leave_the_buttons_their_meaning_while_a_program_runs) {
  AtBoard at;
  at.ask("POST", "/owner", "{}");
  const Json program = at.ask("POST", "/programs", "G21 G90 G1 X30 F1200\nM2\n");
  at.ask("POST", "/programs/" + program["id"].dump() + "/run");
  at.pass(Seconds(0.5));
  ASSERT_EQ(at.run.state(), MachineState::run);
  at.press(input_hold);
  at.pass(Seconds(0.3));
  EXPECT_EQ(at.run.state(), MachineState::hold);
  at.press(input_start);
  EXPECT_EQ(at.run.state(), MachineState::run);
  at.pass(Seconds(4));
  EXPECT_EQ(at.api.job().state, JobState::done);
  EXPECT_EQ(at.z(), 0);
}

TEST(InputMacros, say_why_they_were_refused) {
  AtBoard at;
  EXPECT_EQ(at.ask("GET", "/macros")["refused"], Json());
  ASSERT_TRUE(at.run.session().request(request::SetPosition{{.place = Point(), .trust = Trust::unknown}}));
  at.press(input_start);
  EXPECT_EQ(at.run.steps_made(), 0);
  const Json refused = at.ask("GET", "/macros")["refused"];
  EXPECT_EQ(refused["name"], "up");
  EXPECT_EQ(refused["error"]["code"], "goto.place-unknown") << refused;
}

}  // namespace
}  // namespace passo::test
