// ExcellonTools: the tools of a drill file, which may be defined in its header, in comments, where they are used, or
// after the holes. Private to cam/.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "drawing_builder.hpp"
#include <fmt/format.h>

namespace passo {

struct FileTool {
  std::optional<Nanometres> diameter;
  std::uint32_t layer = 0;
  bool is_used = false;  // selected outside the header
};

class ExcellonTools {
 public:
  bool has(std::int64_t number) const { return tools_.contains(number); }

  // Returns the tool; adds it if the file has not named it before.
  FileTool& named(std::int64_t number, DrawingBuilder& builder) {
    const auto [entry, is_new] = tools_.try_emplace(number);
    if (is_new) entry->second.layer = builder.layer(fmt::format("T{}", number));
    return entry->second;
  }

  // Null: none.
  const FileTool* selected() const { return selected_; }
  void select_none() { selected_ = nullptr; }
  void select(FileTool& tool) {
    tool.is_used = true;
    selected_ = &tool;
  }
  // A header without an end may select its first tool.
  void select_in_header(FileTool& tool) { of_header_ = &tool; }
  void end_header() {
    if (selected_ == nullptr && of_header_ != nullptr) select(*of_header_);
  }

  // Adds the sizes that the file states after the holes, and notes about those that it does not state.
  void add_late_sizes(Drawing& drawing) const {
    std::map<std::uint32_t, Nanometres> sizes;
    for (const auto& [number, tool] : tools_) {
      if (tool.diameter) {
        sizes[tool.layer] = *tool.diameter;
      } else if (tool.is_used) {
        drawing.notes.push_back(fmt::format("the file does not give the diameter of T{}", number));
      }
    }
    const auto add = [&](std::uint32_t layer, Nanometres& size) {
      const auto found = sizes.find(layer);
      if (size.count == 0 && found != sizes.end()) size = found->second;
    };
    for (DrawnHole& hole : drawing.holes) add(hole.layer, hole.diameter);
    for (DrawnPath& path : drawing.paths) add(path.layer, path.width);
  }

 private:
  std::map<std::int64_t, FileTool> tools_;
  FileTool* selected_ = nullptr;
  FileTool* of_header_ = nullptr;
};

}  // namespace passo
