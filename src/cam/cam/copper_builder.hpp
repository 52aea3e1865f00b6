// CopperBuilder: collects the copper that a layout program's file draws, by nets, and makes a DesignBoard of it.
// Private to cam/.
//
// Polygons that the layout program fills only when it plots are filled in take().
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gerber_image.hpp"
#include "region_budget.hpp"

#include "passo/cam/design_board.hpp"

namespace passo {

// A polygon to be filled with the copper of its net.
struct CopperPour {
  DrawnRing outline = {};         // the middle of its line
  Nanometres width = {};          // of the line; narrower copper is left out
  Nanometres isolate = {};        // distance from other nets
  Nanometres edge_distance = {};  // from the outline of the board
  int rank = 0;                   // pours of a lower rank come first
};

class CopperBuilder {
 public:
  // `area`: the first word of the error codes, e.g. "eagle".
  CopperBuilder(const std::string& name, const char* area, const char* software, const char* edge_name,
                Diagnostics& diagnostics);

  // Adds a copper layer, from the top down, and returns its index.
  std::size_t add_sheet(std::string name);
  std::size_t sheets() const { return sheets_.size(); }
  // Adds a track.
  void add_stroke(std::size_t sheet, const std::string& net, const DrawnPath& path, std::uint32_t line);
  // Adds a line that is no track, e.g. of a pad.
  void add_line(std::size_t sheet, const std::string& net, const DrawnPath& path, std::uint32_t line);
  // Adds an area, whose ring may cross itself. `rim`: the width of the line that is drawn along the ring.
  void add_face(std::size_t sheet, const std::string& net, DrawnRing ring, std::uint32_t line, Nanometres rim = {});
  // Adds an area, whose ring is counterclockwise and does not cross itself.
  void add_area(std::size_t sheet, const std::string& net, DrawnRing ring, std::uint32_t line);
  void add_place(std::size_t sheet, const std::string& net, DrawnPoint at, std::uint32_t line);
  void add_pour(std::size_t sheet, const std::string& net, CopperPour pour);
  void add_cutout(std::size_t sheet, DrawnRing ring);  // where nothing is poured
  void add_text(std::size_t sheet) { ++sheets_[sheet].texts; }
  void add_note(std::size_t sheet, std::string words) { sheets_[sheet].notes.push_back(std::move(words)); }
  void add_edge(DrawnPath path);
  void add_hole(const DrawnHole& hole);
  void add_slot(DrawnPath slot);
  void note_once(const std::string& words);
  void refuse(const char* code, std::uint32_t line, std::string message, std::string expected);
  bool is_full() const { return is_full_; }

  // Fills the polygons, and merges the copper of each layer.
  DesignBoard take();

 private:
  struct Sheet {
    std::string name;
    std::map<std::string, std::vector<Region>> objects = {};  // by net
    GerberImage image = {};
    std::vector<std::string> nets = {""};
    std::map<std::string, std::uint32_t> net_indices = {{"", 0}};
    std::vector<std::pair<std::string, CopperPour>> pours = {};
    std::vector<DrawnRing> cutouts = {};
    std::size_t texts = 0;
    std::vector<std::string> notes = {};
  };

  bool has_room_for(std::size_t points, std::uint32_t line);
  bool affords(const std::vector<Region>& objects, std::uint32_t line);
  std::uint32_t net_index(Sheet& sheet, const std::string& net);
  void pour(Sheet& sheet);
  Region poured(Sheet& sheet, const std::string& net, const CopperPour& pour) const;
  GerberLayer layer_of(Sheet& sheet);

  const std::string& name_;
  std::string area_;
  const char* software_;
  Diagnostics& diagnostics_;
  RegionBudget budget_;
  std::vector<Sheet> sheets_;
  GerberLayer edge_;
  Drawing drills_;
  std::string edge_name_;
  std::size_t points_ = 0;
  bool is_full_ = false;
};

}  // namespace passo
