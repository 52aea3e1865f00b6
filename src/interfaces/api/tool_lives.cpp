#include "passo/api/tool_lives.hpp"

#include <algorithm>

namespace passo {

LivesLeft lives_left(const ToolLibrary& library, const std::vector<ToolRecord>& records) {
  LivesLeft left;
  for (const CuttingTool& tool : library.tools()) {
    const ToolLife& life = tool.life;
    if (life.length == Mm(0) && life.time == Seconds(0)) continue;
    const auto record = std::ranges::find(records, tool.number, &ToolRecord::tool);
    const CutAmount cut = record == records.end() ? CutAmount() : record->cut;
    LifeLeft& rest = left[tool.number];
    if (life.length > Mm(0)) rest.length = life.length - cut.length;
    if (life.time > Seconds(0)) rest.time = life.time - cut.time;
  }
  return left;
}

}  // namespace passo
