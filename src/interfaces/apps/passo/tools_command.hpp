// The commands of `passo tools`: a library of tools as a table, and feeds and speeds of a tool in a material.
#pragma once

#include <optional>
#include <string>

namespace passo {

struct ToolsListArguments {
  std::string library;
  bool json = false;
};

struct ToolsFeedsArguments {
  std::string library;
  std::string tool;  // "3" or "T3"
  std::string material;
  std::string machine;  // machine file, whose limits hold; empty: none
  std::optional<double> rpm = {};
  double depth = 0;    // of a pass, mm; 0: as the tables have it
  double width = 100;  // radial width of the cut, % of the diameter
  std::optional<double> least_rpm = {};
  std::optional<double> most_rpm = {};
  bool json = false;
};

int tools_list(const ToolsListArguments& arguments);
int tools_feeds(const ToolsFeedsArguments& arguments);

}  // namespace passo
