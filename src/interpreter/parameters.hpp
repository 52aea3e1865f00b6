// Parameters: #1…#5602 and the named ones, with the scopes of RS274/NGC.
//
// #1 to #30 belong to the subroutine that runs; names without an underscore too. The predefined names (#<_x>) and the
// numbers that tell positions and offsets (#5420) are read from the interpreter's state.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "modal_state.hpp"

#include "passo/gcode/expression.hpp"
#include "passo/gcode/symbols.hpp"

namespace passo {

class Parameters final : public ParameterValues {
 public:
  static constexpr std::int64_t highest = 5602;
  static constexpr std::size_t locals = 30;

  Parameters(const ModalState& state, const SymbolTable& symbols);

  bool numbered(std::int64_t number, double& value) const override;
  bool named(Symbol name, double& value) const override;

  enum class Setting : std::uint8_t { done, out_of_range, read_only };
  Setting set_numbered(std::int64_t number, double value);
  Setting set_named(Symbol name, double value);

  // A subroutine begins: its arguments are #1…, all other locals are zero, and it has no names yet.
  void enter(const std::vector<double>& arguments);
  // It ends: the caller's locals are as they were.
  void leave();

 private:
  struct Scope {
    std::vector<double> numbers = std::vector<double>(locals);
    std::vector<std::pair<Symbol, double>> names;
  };

  bool is_global(Symbol name) const;
  bool predefined(Symbol name, double& value) const;
  bool of_state(std::int64_t number, double& value) const;

  const ModalState& state_;
  const SymbolTable& symbols_;
  std::vector<double> numbers_;
  std::vector<std::pair<bool, double>> globals_;  // by symbol: set or not, value
  std::vector<Scope> scopes_;
};

}  // namespace passo
