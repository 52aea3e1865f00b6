// GrblBoardSettings: the settings of a StrictGrbl: Grbl's defaults, what it accepts, and how many bytes of the EEPROM a
// new value changes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>

#include <fmt/format.h>

namespace passo {

class GrblBoardSettings {
 public:
  explicit GrblBoardSettings(std::size_t axes = 3) {
    values_ = {{0, 10},    {1, 25},     {2, 0},  {3, 0},     {4, 0},  {5, 0},  {6, 0},  {10, 1},
               {11, 0.01}, {12, 0.002}, {13, 0}, {20, 0},    {21, 0}, {22, 0}, {23, 0}, {24, 25},
               {25, 500},  {26, 250},   {27, 1}, {30, 1000}, {31, 0}, {32, 0}};
    use_axes(axes);
  }
  // Adds the settings of the axes that have none.
  void use_axes(std::size_t axes) {
    for (int axis = 0; axis < static_cast<int>(axes); ++axis) {
      values_.try_emplace(100 + axis, 250);
      values_.try_emplace(110 + axis, 500);
      values_.try_emplace(120 + axis, 10);
      values_.try_emplace(130 + axis, 200);
    }
  }

  double operator[](int number) const {
    const auto found = values_.find(number);
    return found == values_.end() ? 0 : found->second;
  }
  // Without any check.
  void put(int number, double value) { values_[number] = value; }

  // Returns the number of Grbl's error; 0: stored.
  int store(double number, double value) {
    if (number > 255) return 3;
    const int which = static_cast<int>(number);
    if (value < 0) return 4;
    if (!values_.contains(which)) return 3;
    if (which == 0 && value < 3) return 6;
    if (which == 20 && value != 0 && values_[22] == 0) return 10;
    const double kept = is_whole(which) && which < 30 ? std::trunc(value) : value;
    changed_ = changed_bytes(values_[which], is_flag(which) ? (value != 0 ? 1.0 : 0.0) : kept);
    values_[which] = is_flag(which) ? (value != 0 ? 1 : 0) : kept;
    if (which == 22 && value == 0) values_[20] = 0;
    return 0;
  }
  // Bytes of the EEPROM that the last store() has changed.
  std::size_t changed() const { return changed_; }

  std::string text() const {
    std::string all;
    for (const auto& [number, value] : values_) {
      all += is_whole(number) ? fmt::format("${}={:.0f}\r\n", number, value)
                              : fmt::format("${}={:.3f}\r\n", number, value);
    }
    return all;
  }

 private:
  static bool is_whole(int number) {
    return number < 100 && number != 11 && number != 12 && number != 24 && number != 25 && number != 27;
  }
  static bool is_flag(int number) {
    return (number >= 4 && number <= 6) || number == 13 || (number >= 20 && number <= 22) || number == 32;
  }
  static std::size_t changed_bytes(double before, double after) {
    const auto a = static_cast<float>(before);
    const auto b = static_cast<float>(after);
    if (a == b) return 0;
    std::uint32_t bits_a = 0;
    std::uint32_t bits_b = 0;
    std::memcpy(&bits_a, &a, sizeof a);
    std::memcpy(&bits_b, &b, sizeof b);
    std::size_t count = 1;  // the checksum
    for (unsigned i = 0; i < 4; ++i) count += ((bits_a ^ bits_b) >> 8 * i & 0xffU) != 0 ? 1 : 0;
    return count;
  }

  std::map<int, double> values_;
  std::size_t changed_ = 0;
};

}  // namespace passo
