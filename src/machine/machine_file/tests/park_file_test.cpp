#include "machine_text.hpp"

namespace passo {
namespace {

const std::string with_plane = sound_machine + R"(
[axis.Y]
steps_per_mm = 100
travel_mm = [0, 200]
max_velocity_mm_s = 25
max_acceleration_mm_s2 = 200
)";
const std::string with_z = with_plane + R"(
[axis.Z]
steps_per_mm = 100
travel_mm = [-60, 0]
max_velocity_mm_s = 25
max_acceleration_mm_s2 = 200
)";

std::string first_code(const std::string& text) {
  Diagnostics diagnostics;
  if (parse_machine(text, "m.toml", diagnostics)) return "";
  return diagnostics.all().empty() ? "none" : diagnostics.all()[0].code;
}

TEST(ParkFile, gives_the_place_and_what_the_end_of_a_program_does) {
  Diagnostics diagnostics;
  const auto machine =
      parse_machine(with_z + "[park]\nplace_mm = [10, 190.5]\nat_end = \"park\"\n", "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  ASSERT_TRUE(machine->park.place);
  EXPECT_EQ((*machine->park.place)[Axis::x], 10);
  EXPECT_EQ((*machine->park.place)[Axis::y], 190.5);
  EXPECT_EQ(machine->park.at_end, ParkDescription::AtEnd::park);
  EXPECT_NE(describe(*machine).find("X 10 Y 190.5 (machine); programs that end park the tool"), std::string::npos);
  EXPECT_EQ(machine->top_of_travel(), 0);
}

TEST(ParkFile, is_optional_and_programs_then_end_where_they_are) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(with_z, "m.toml", diagnostics);
  ASSERT_TRUE(machine);
  EXPECT_FALSE(machine->park.place);
  EXPECT_EQ(machine->park.at_end, ParkDescription::AtEnd::stay);
  EXPECT_EQ(describe(*machine).find("park"), std::string::npos);
}

TEST(ParkFile, is_refused_where_the_machine_cannot_go) {
  EXPECT_EQ(first_code(with_z + "[park]\nplace_mm = [10, 190]\n"), "");
  EXPECT_EQ(first_code(with_z + "[park]\nat_end = \"rise\"\n"), "") << "needs no park position";
  EXPECT_EQ(first_code(with_z + "[park]\nplace_mm = [10, 201]\n"), "machine.park");
  EXPECT_EQ(first_code(with_z + "[park]\nplace_mm = [-151, 0]\n"), "machine.park");
  EXPECT_EQ(first_code(sound_machine + "[park]\nplace_mm = [10, 10]\n"), "machine.park") << "without Y";
  EXPECT_EQ(first_code(with_plane + "[park]\nplace_mm = [10, 10]\nat_end = \"park\"\n"), "machine.park") << "without Z";
  EXPECT_EQ(first_code(with_z + "[park]\nat_end = \"park\"\n"), "machine.park") << "without a place";
  EXPECT_EQ(first_code(with_z + "[park]\nat_end = \"home\"\n"), "machine.park");
  EXPECT_EQ(first_code(with_z + "[park]\nplace_mm = 10\n"), "machine.wrong-type");
  EXPECT_EQ(first_code(with_z + "[park]\nplace = [10, 10]\n"), "machine.unknown-key");
}

}  // namespace
}  // namespace passo
