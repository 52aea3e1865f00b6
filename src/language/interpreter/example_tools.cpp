#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

ToolTable example_tools() {
  struct Example {
    double length;  // inches
    double diameter;
  };
  constexpr Example examples[] = {{0.511, 0.125}, {0.1, 0.0625}, {1.273, 0.201}};
  ToolTable table;
  std::int32_t number = 0;
  for (const Example& example : examples) {
    Tool tool;
    tool.number = tool.pocket = ++number;
    tool.offset[Axis::z] = example.length * mm_per_inch;
    tool.diameter = Mm(example.diameter * mm_per_inch);
    (void)table.add(tool);
  }
  return table;
}

}  // namespace passo
