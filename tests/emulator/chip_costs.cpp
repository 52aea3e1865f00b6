// chip_costs: prints what a pulse of each method costs on the ATmega328P, as the table in docs/interpolation/costs.md.
#include <cstdio>
#include <exception>

#include "emulator/method_cost.hpp"

int main() {
  try {
    passo::MethodRunner runner(PASSO_METHODS_PROGRAM);
    std::fputs(passo::cost_table(passo::measure_all(runner), PASSO_CHIP_COMPILER).c_str(), stdout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "chip_costs: %s\n", error.what());
    return 1;
  }
  return 0;
}
