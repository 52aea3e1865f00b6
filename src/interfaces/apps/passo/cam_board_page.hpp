// BoardPage: the output of `passo cam board` as one HTML page with step-by-step instructions. `passo cam relief
// --two-sided` uses it for its instructions, too.
//
// The page is a single file: it needs no network and runs no script, and all text from files is escaped.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "passo/units/units.hpp"

namespace passo {

struct BoardStep {
  // For steps with specific instructions: "blank", "drill", "heights-front", "heights-back", "front", "turn",
  // "find-holes", "back", "mask-front", "mask-back", "edge", "stencil-front" or "stencil-back".
  std::string kind = {};
  std::string title = {};               // "Mill the front"
  std::string program = {};             // its file; empty: a step without a program
  std::vector<std::string> tools = {};  // in order of use
  std::vector<std::string> words = {};  // the instructions, one sentence each
  std::string figures = {};             // statistics, one per line
  std::optional<Seconds> time = {};     // empty: unknown
  std::string picture = {};             // SVG; empty: none
  std::string photo = {};               // PNG; empty: none
};

struct BoardPageFile {
  std::string name;
  std::string short_name;  // the name within the folder or archive
  std::string layer;       // "top copper"
  std::string told_by;
  bool is_drill_file = false;
};
std::string words_for(const BoardPageFile& file);

// The two holes about which the board is flipped, in program coordinates, mm.
struct BoardRegistration {
  std::array<std::pair<double, double>, 2> holes = {};  // after the flip each is where the other was
  double axis = 0;                                      // X or Y of the line about which the back is mirrored
};

struct BoardPage {
  std::string name;
  std::string machine;                // the machine of the time estimates; empty: none
  std::vector<BoardPageFile> files;   // the files read, with their layers
  std::vector<std::string> left_out;  // names of unused files
  double width = 0;                   // width of the board, mm
  double height = 0;
  double margin = 0;         // distance of its lower left corner from X0 and from Y0, mm
  const char* up = "front";  // the side that is up first: "front" or "back"
  const char* turn = "";     // flip direction, "x" or "y"; empty: not flipped
  std::size_t copies = 1;    // of the board on the blank; `width` and `height` are those of all
  double copy_width = 0;
  double copy_height = 0;
  std::optional<BoardRegistration> registration = {};  // empty: no holes
  const char* holes = "";                              // the two holes beside the board: "pins" or "probe"; empty: none
  std::vector<BoardStep> steps;
  const char* command = "board";
  const char* manual = "circuit-boards";
  std::string lead = {};  // what stands below the name; empty: where the times are from
};

std::string to_html(const BoardPage& page);
nlohmann::ordered_json to_json(const BoardPage& page);

}  // namespace passo
