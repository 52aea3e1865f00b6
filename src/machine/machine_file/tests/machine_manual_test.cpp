// Fails unless docs/manual/machine-file.md shows real messages and every key.
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "machine_text.hpp"

namespace passo {
namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(std::string(PASSO_SOURCE_DIR) + "/" + path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

const std::string manual_path = "docs/manual/machine-file.md";

// The mistakes that the manual shows, made in the pantograph's file.
const std::pair<const char*, const char*> shown_mistakes[] = {
    {"step_pulse_us = 2.5 ", "step_pulse_us = 2,5 "},
    {"max_velocity_mm_s = 25 ", "max_velocity_mm_s = 25 mm/s "},
    {"max_velocity_mm_s = 25 ", "max_velocity = 25 "},
    {"clock_hz = 16_000_000", "clock_hz = \"16 MHz\""},
    {"[-150, 150]", "[150, -150]"},
    {"max_velocity_mm_s = 25 ", "max_velocity_mm_s = 1500 "},
    {"steps_per_turn = 400        # a motor", "steps_per_mm = 100\nsteps_per_turn = 400        # a motor"},
    {"screw_pitch_mm = 4          # one", "# one"},
    {"[axis.Y]", "[axis.X]"},
    {"[axis.Z]", "path_tolerance_mm = 0.02\n\n[axis.Z]"},
    {"max_event_rate_hz = 50_000", "max_event_rate_hz = 2_000_000"},
    {"step_pulse_us = 2.5 ", "step_pulse_us = 15 "},
};

TEST(MachineManual, shows_each_message_exactly_as_it_is_printed) {
  const std::string manual = content_of(manual_path);
  const std::string sound = content_of("examples/machines/pantograph.toml");
  std::set<std::string> heads;
  for (const auto& [from, to] : shown_mistakes) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_machine(replaced(sound, from, to), "my-machine.toml", diagnostics));
    ASSERT_FALSE(diagnostics.all().empty()) << to;
    const std::string message = render(diagnostics.all()[0], false);
    EXPECT_NE(manual.find(message), std::string::npos) << manual_path << " does not show this:\n" << message;
    heads.insert(message.substr(0, message.find('\n')));
  }
  std::istringstream lines(manual);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("error: ") != std::string::npos) {
      EXPECT_TRUE(heads.contains(line)) << "not tested: " << line;
    }
  }
}

TEST(MachineManual, explains_every_key_that_a_message_may_name_and_each_code) {
  const std::string manual = content_of(manual_path);
  // All keys, as the program itself lists them to users who guess.
  std::string keys;
  for (const char* table : {"",
                            "[board]\n",
                            "[tool]\n",
                            "[probe]\n",
                            "[spindle]\n",
                            "[silence]\n",
                            "[work]\n",
                            "[camera]\n",
                            "[park]\n",
                            "[homing]\n",
                            "[hooks]\n",
                            "[handwheel]\n",
                            "[tool_change]\n",
                            "[tool_change.rack]\n",
                            "[inputs]\n",
                            "[outputs]\n",
                            "[axis.X]\n",
                            "[axis.A]\n",
                            "[axis.X.torque]\n",
                            "[axis.X.home]\n",
                            "[axis.A.home]\n",
                            "[axis.X.second_motor]\n",
                            "[axis.A.second_motor]\n",
                            "[axis.X.screw]\n",
                            "[axis.A.screw]\n",
                            "[axis.X.encoder]\n",
                            "[axis.A.encoder]\n"}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_machine(std::string(table) + "qqqqqqqqqqqqqqqqqqqqqqqqqqqqqq = 1\n", "m.toml", diagnostics));
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      if (diagnostic.code == "machine.unknown-key") keys += diagnostic.expected.substr(7) + ", ";
    }
  }
  std::istringstream words(keys);
  std::set<std::string> seen;
  for (std::string key; std::getline(words, key, ',');) {
    key.erase(0, key.find_first_not_of(' '));
    if (key.empty()) continue;
    seen.insert(key);
    EXPECT_TRUE(manual.find("`" + key + "`") != std::string::npos || manual.find("`[" + key) != std::string::npos)
        << key;
  }
  EXPECT_GE(seen.size(), 49U);

  for (const char* source :
       {"machine/machine_file/board_reader", "machine/machine_file/camera_reader",
        "machine/machine_file/encoder_reader", "machine/machine_file/machine_file",
        "machine/machine_file/machine_reader", "machine/machine_file/homing_reader",
        "machine/machine_file/hooks_reader", "machine/machine_file/handwheel_reader",
        "machine/machine_file/pins_reader", "machine/machine_file/park_reader", "machine/machine_file/screw_reader",
        "machine/machine_file/tool_change_reader", "machine/machine_file/torque_reader", "core/toml/table_reader",
        "core/toml/toml_document"}) {
    const std::string code = content_of(fmt::format("src/{}.cpp", source));
    for (std::size_t i = code.find("\"machine."); i != std::string::npos; i = code.find("\"machine.", i + 1)) {
      const std::string name = code.substr(i + 1, code.find('"', i + 1) - i - 1);
      EXPECT_NE(manual.find("`" + name + "`"), std::string::npos) << name;
    }
  }
}

}  // namespace
}  // namespace passo
