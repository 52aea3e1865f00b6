// Parameters: #1 … #5601, #<name> and #<_name>.
//
// Numbered parameters are 0 until set, except #5220 (the work system) and #5599, which are 1. #1 … #30 belong to the
// sub that runs, and so do names without a leading underscore. Names with a leading underscore are global. Home
// positions and offsets are parameters (#5161, #5181, #5211, #5221 … #5390), in the machine's unit and in degrees,
// whatever the program's units. The state of the machine (#5400 …, #5420 …, #<_x>, #<_feed> …) is computed when it is
// read and cannot be set. The same holds for the machine's settings (#<_ini[…]…>).
//
// Looking up a name is an index. A sub that sets a local name first puts the name's old value on an undo list.
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
inline constexpr int used_offset_parameter = 5081;  // the tool offset in effect
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

  // Called before the program and after it. save() updates the parameters that `saved` has and adds those that are
  // always saved.
  void load(const SavedParameters& saved);
  void save(SavedParameters& saved) const;

  bool numbered(std::int64_t number, double& value) const override;
  bool named(Symbol name, double& value) const override;
  // What the interpreter itself sets counts as set, and so do the arguments of a sub.
  bool was_set(std::int64_t number) const override {
    return number < 1 || number >= machine_position_parameter || set_[static_cast<std::size_t>(number)] ||
           is_of_sub(number);
  }

  // False: this name cannot be set.
  [[nodiscard]] bool set_named(Symbol name, double value);
  static bool is_settable(std::int64_t number);
  // #5021 to #5029, where a machine is there. Elsewhere they are numbers like others.
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

  // A point in millimetres and degrees. Nine parameters, beginning with `first`, hold it in the machine's unit.
  Point point(int first) const;
  void set_point(int first, const Point& point);

  // Notes what is set from now on. roll_back() undoes what was set since.
  void keep();
  void roll_back();

  // A sub begins, with these arguments as its #1 …
  void enter_sub(std::span<const double> arguments);
  // A subprogram of M98 begins. It has names of its own but shares #1 … #30 with its caller.
  void enter_subprogram();
  void leave_sub();

 private:
  struct Named {
    enum class Kind : std::uint8_t { unseen, local, global, predefined };
    Kind kind = Kind::unseen;
    std::uint8_t predefined = 0;  // index in predefined_parameters()
    std::int32_t depth = -1;      // call depth of the sub that set it; -1: never set
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
  // A parameter of the sub that runs: an argument that is not given is 0.
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
  std::bitset<highest_parameter + 1> set_;  // once set, also by a line that was taken back
  std::vector<Named> names_;                // by symbol
  std::vector<Undo> undo_;
  std::vector<Caller> callers_;
  bool keeps_ = false;
  std::vector<std::pair<int, double>> kept_numbers_;  // what they were, in the order in which they were set
  std::vector<std::pair<Symbol, Named>> kept_names_;
};

}  // namespace passo
