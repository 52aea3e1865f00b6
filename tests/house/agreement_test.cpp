// What two modules, or the program and the page, know without knowing each other.
#include <map>
#include <regex>
#include <string>

#include "source_tree.hpp"

#include "passo/machine_file/machine_description.hpp"
#include "passo/port/parallel_port.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {
namespace {

TEST(Agreement, a_machine_file_allows_as_many_motors_as_a_board_segment_carries) {
  EXPECT_EQ(most_motors, static_cast<std::size_t>(max_motors));
}

using Register = ParallelPort::Register;
const std::map<std::string, Register> registers = {
    {"data", Register::data}, {"status", Register::status}, {"control", Register::control}};

TEST(Agreement, the_pins_of_the_parallel_port_in_the_lab_are_those_of_the_program) {
  static const std::regex row(R"re(\bpin\((\d+), '(\w+)', (\d)(, true)?\))re");
  std::map<int, ParallelPort::Bit> pins;
  const std::string text = text_of("page/src/lab/board/port.ts");
  for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found) {
    const std::smatch& words = *found;
    const auto number = static_cast<unsigned>(std::stoul(words[3]));
    pins[std::stoi(words[1])] = {registers.at(words[2]), number, words[4].matched};
  }
  for (int pin = 1; pin <= ParallelPort::pin_count; ++pin) {
    const auto bit = ParallelPort::bit_of(pin);
    ASSERT_EQ(pins.contains(pin), bit.has_value()) << pin;
    if (bit) EXPECT_EQ(pins.at(pin), *bit) << pin;
  }
}

TEST(Agreement, the_addresses_of_the_parallel_port_in_the_lab_are_those_of_the_program) {
  static const std::regex row(R"re((\w+): (0x[0-9a-f]+)\b)re");
  const std::string text = text_of("page/src/lab/board/port.ts");
  std::map<std::string, unsigned long> addresses;
  for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found) {
    addresses[(*found)[1]] = std::stoul((*found)[2], nullptr, 16);
  }
  ASSERT_EQ(addresses.size(), registers.size());
  for (const auto& [name, which] : registers) {
    EXPECT_EQ(addresses.at(name), ParallelPort::usual_base + static_cast<unsigned long>(which)) << name;
  }
}

}  // namespace
}  // namespace passo
