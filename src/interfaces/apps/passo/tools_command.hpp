// The commands of `passo tools`: a library of tools as a table, its import and export, and feeds and speeds of a tool
// in a material.
#pragma once

#include <optional>
#include <string>
#include <vector>

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

struct ToolsImportArguments {
  std::string file;
  std::string output;
  std::string units;  // mm or inch, of a file that does not state them; empty: not given
  std::string shape;  // flat, ball or drill, of tools without a shape; empty: not given
  bool force = false;
  bool json = false;
};

struct ToolsExportArguments {
  std::string library;
  std::string output;
  std::string format;  // linuxcnc or json; empty: as the name of the output ends
  std::string units;   // mm or inch, of a LinuxCNC table; empty: not given
  bool force = false;
};

struct ToolsLifeArguments {
  std::string library;                // empty: no names and limits
  std::string records;                // empty: tools.sqlite in the state folder
  std::string table;                  // LinuxCNC tool table with lengths and pockets; empty: none
  std::string units = "mm";           // of the table: mm or inch
  std::vector<std::string> replaced;  // tools that are new now: "T3"
  bool json = false;
};

int tools_list(const ToolsListArguments& arguments);
int tools_feeds(const ToolsFeedsArguments& arguments);
int tools_import(const ToolsImportArguments& arguments);
int tools_life(const ToolsLifeArguments& arguments);
int tools_export(const ToolsExportArguments& arguments);

}  // namespace passo
