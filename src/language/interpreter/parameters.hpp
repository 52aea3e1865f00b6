// Parameters: #1 … #5601, #<name> and #<_name>.
//
// Numbered parameters are 0 until set, except #5220 (the work coordinate system) and #5599, which are 1. #1 … #30 are
// local to the running subroutine, and so are names without a leading underscore. Names with a leading underscore are
// global. Home positions and offsets are parameters (#5161, #5181, #5211, #5221 … #5390), in the machine's unit and in
// degrees, whatever the program's units. The state of the machine (#5400 …, #5420 …, #<_x>, #<_feed> …) is computed on
// reading and cannot be set. The same holds for the machine's settings (#<_ini[…]…>).
//
// Looking up a name is an index operation. When a subroutine sets a local name, the name's old value is saved in an
// undo list.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "program_state.hpp"

#include "passo/gcode/expression.hpp"
#include "passo/gcode/symbols.hpp"
#include "passo/interpreter/saved_offsets.hpp"
#include "passo/interpreter/settings_file.hpp"

namespace passo {

inline constexpr int highest_parameter = 5601;
inline constexpr std::size_t sub_parameters = 30;

// Numbers of further parameters; those of offsets are in saved_offsets.hpp.
inline constexpr int first_home_parameter = 5161;
inline constexpr int second_home_parameter = 5181;
inline constexpr int machine_position_parameter = 5021;
inline constexpr int probe_parameter = 5061;
inline constexpr int probe_success_parameter = 5070;
inline constexpr int used_offset_parameter = 5081;  // the active tool offset
inline constexpr int input_parameter = 5399;
inline constexpr int show_debug_parameter = 5599;
inline constexpr int tool_parameter = 5400;
inline constexpr int tool_offset_parameter = 5401;
inline constexpr int tool_shape_parameter = 5410;  // diameter, front angle, back angle, orientation
inline constexpr int last_tool_parameter = 5413;
inline constexpr int position_parameter = 5420;

class Parameters final : public ParameterValues {
 public:
  Parameters(SymbolTable& symbols, const ProgramState& state, LengthUnits machine_units = LengthUnits::mm,
             std::shared_ptr<const SettingsFile> settings = nullptr);

  // Called before and after the program. save() updates the parameters in `saved` and adds those that are always saved.
  void load(const SavedParameters& saved);
  void save(SavedParameters& saved) const;

  bool numbered(std::int64_t number, double& value) const override;
  bool named(Symbol name, double& value) const override;
  // Parameters set by the interpreter itself, and arguments of a subroutine, count as set.
  bool was_set(std::int64_t number) const override {
    return number < 1 || number >= machine_position_parameter || set_[static_cast<std::size_t>(number)] ||
           is_of_sub(number);
  }

  // Returns false if this name cannot be set.
  [[nodiscard]] bool set_named(Symbol name, double value);
  static bool is_settable(std::int64_t number);
  // Returns whether this is one of #5021 to #5029 on a machine. Without a machine they are ordinary parameters.
  bool is_machine_position(std::int64_t number) const {
    return state_.on_machine && number >= machine_position_parameter &&
           number < machine_position_parameter + static_cast<int>(axis_count);
  }
  void set(int number, double value) {
    double& parameter = numbers_[static_cast<std::size_t>(number)];
    if (keeps_) kept_numbers_.emplace_back(number, parameter);
    parameter = value;
    if (!is_of_sub(number)) set_[static_cast<std::size_t>(number)] = true;
  }
  double get(int number) const { return numbers_[static_cast<std::size_t>(number)]; }

  // Returns a point in millimetres and degrees, from nine parameters beginning with `first`, which are in the machine's
  // unit.
  Point point(int first) const;
  void set_point(int first, const Point& point);

  // Starts recording changes. roll_back() undoes the recorded changes.
  void keep();
  void roll_back();

  // Enters a subroutine with these arguments as its #1 …
  void enter_sub(std::span<const double> arguments);
  // Enters a subprogram of M98. It has its own local names but shares #1 … #30 with its caller.
  void enter_subprogram();
  void leave_sub();

 private:
  struct Named {
    enum class Kind : std::uint8_t { unseen, local, global, predefined };
    Kind kind = Kind::unseen;
    std::uint8_t predefined = 0;  // index in predefined_parameters()
    std::int32_t depth = -1;      // call depth of the subroutine that set it; -1: never set
    double value = 0;
  };
  struct Undo {
    std::uint32_t symbol;
    std::int32_t depth;
    double value;
  };
  struct Caller {
    std::array<double, sub_parameters> numbers;
    std::size_t undo_size;
    bool shares_numbers;
  };
  Named& at(Symbol name);
  double of_tool(int number) const;
  // Returns whether this is a parameter of the running subroutine: arguments that are not given are 0.
  bool is_of_sub(std::int64_t number) const {
    return number <= static_cast<int>(sub_parameters) && !std::ranges::all_of(callers_, &Caller::shares_numbers);
  }
  bool forgets(int number) const;
  double unit_of(Axis axis) const { return is_rotary(axis) ? 1 : machine_unit_; }

  SymbolTable& symbols_;
  const ProgramState& state_;
  double machine_unit_;  // in millimetres
  std::shared_ptr<const SettingsFile> settings_;
  std::array<double, highest_parameter + 1> numbers_{};
  std::bitset<highest_parameter + 1> set_;  // once set, even by a line that was rolled back
  std::vector<Named> names_;                // by symbol
  std::vector<Undo> undo_;
  std::vector<Caller> callers_;
  bool keeps_ = false;
  std::vector<std::pair<int, double>> kept_numbers_;  // previous values, in the order of the changes
  std::vector<std::pair<Symbol, Named>> kept_names_;
};

}  // namespace passo
