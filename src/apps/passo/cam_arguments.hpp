// The commands `passo cam show`, `isolate` and `outline`, a function each, and their arguments.
//
// Lengths are texts for parse_length(); a number without a unit is in `units`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"

namespace passo {

// What both have.
struct CamMillArguments {
  std::vector<std::string> files;   // Gerber or DXF
  std::string output;               // empty: standard output
  std::string picture;              // .svg or .png; empty: none
  bool json = false;                // what was done, on standard output
  std::string units = "mm";         // of the program and of lengths without a unit: mm, cm or inch
  std::optional<double> scale;      // of the numbers of DXF files
  std::string input;                // unit of the files' numbers; empty: as they say, with --scale as `units`
  std::vector<std::string> layers;  // of DXF files; empty: all that are on
  std::string zero = "file";        // where X0 Y0 is: file or lower-left
  std::string mirror;               // x or y; empty: the board is not turned over
  std::string mirror_at;            // the line about which it is; empty: X0 or Y0
  std::string align;                // X,Y,X,Y: two holes midway between which that line runs
  bool conventional = false;        // else climb milling
  std::string clearance = "2mm";
  std::string feed = "200mm";
  std::string plunge_feed = "60mm";
  std::string park = "0,0";
  std::optional<std::uint32_t> spindle;  // turns a minute
};

struct CamIsolateArguments : CamMillArguments {
  std::string edge;   // file of the board's edge; empty: none
  std::string tools;  // widths of cutters with commas between
  std::string v;      // ANGLE,TIP of a V-shaped cutter
  std::string depth = "-0.05mm";
  std::uint32_t passes = 1;
  std::string width;    // free ground around the copper; empty: as the passes make
  double overlap = 50;  // percent
  bool clear = false;
  std::string tolerance = "0.004mm";
};
int cam_isolate(const CamIsolateArguments& arguments);

struct CamOutlineArguments : CamMillArguments {
  std::string tool = "2mm";
  std::string depth = "-1.8mm";
  std::string step = "0.5mm";
  std::string join = "0.1mm";
  std::uint32_t tabs = 0;
  std::vector<std::string> tab_places;  // X,Y each
  std::string tab_width = "2mm";
  std::string tab_height = "0.6mm";
  double ramp = 0;   // degrees
  std::string lead;  // empty: none
  bool dog_bones = false;
};
int cam_outline(const CamOutlineArguments& arguments);

struct CamShowArguments {
  std::vector<std::string> files;  // Gerber and drill files, folders, zip archives
  std::string picture;             // .svg or .png; empty: none
  bool json = false;
};
int cam_show(const CamShowArguments& arguments);

}  // namespace passo
