// passo/kinematics turns axes into motors, and motors into axes. Nobody else does that by hand.
#include <algorithm>
#include <map>
#include <regex>

#include "source_tree.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// Who reads the steps of an axis in a machine's description. That an axis has a motor of its own is true of a machine
// file, and need not be true of a machine.
const std::map<std::string, std::string> readers = {
    {"src/machine/activity/stage_options.cpp", "makes the rows of it"},
    {"src/machine/activity/machine_plant.cpp",
     "the driver's steps to a step of the motor, and the counts of an encoder"},
    {"src/check/tuning/axis_tuner.cpp", "what the board can do for a motor"},
    {"src/interfaces/api/api_json.cpp", "says what the machine file says"},
    {"src/interfaces/grbl/grbl_settings.cpp", "says what the machine file says"},
    {"src/interfaces/grbl/kept_settings.cpp", "writes the machine file"},
    {"src/interfaces/sender/grbl_match.cpp", "compares what the machine file says with a board's settings"},
    {"src/check/verdict/margin_survey.cpp", "a field of its own"},
    {"src/check/verdict/surveyed_motors.cpp", "a field of its own"},
};

TEST(OneInverse, only_kinematics_knows_which_motor_turns_an_axis) {
  static const std::regex reads(R"((\.|->)steps_per_unit\b(?!\())");
  std::size_t found = 0;
  for (const fs::path& file : files_below("src", {".hpp", ".cpp"})) {
    const std::string module = module_of(file);
    if (is_test(file) || module == "machine_file" || module == "kinematics") continue;
    const std::string text = text_of(file);
    if (!has_word(text, "steps_per_unit") || !std::regex_search(text, reads)) continue;
    EXPECT_TRUE(readers.contains(file.generic_string()))
        << file << " reads steps_per_unit: ask passo/kinematics for motors or axes";
    ++found;
  }
  EXPECT_EQ(found, readers.size()) << "a file of the list reads no steps_per_unit any more";
}

}  // namespace
}  // namespace passo
