// read_board_job: reads all files of a circuit board from files, folders or a zip archive, each with its purpose.
//
// The layer of a file is taken from its attribute (.FileFunction), otherwise from its name, as layout programs choose
// names, or from its contents (drill files). Such a guess may be wrong: show it and let the user confirm.
//
// The limits are 1,000 files and 256 MiB unpacked; a larger archive is refused before it is unpacked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/gerber.hpp"

namespace passo {

enum class BoardRole : std::uint8_t { unknown, copper, mask, paste, print, outline, drill, drawing };
enum class BoardSide : std::uint8_t { both, top, bottom, inner };

struct BoardFileKind {
  BoardRole role = BoardRole::unknown;
  BoardSide side = BoardSide::both;
  std::uint32_t copper_layer = 0;  // number of the inner copper layer in the file; 0: not stated
  const char* told_by = "";        // source of the information: "attribute", "name", "content", or "you" if the user
                                   // has set it
};

// Returns the name of a layer, e.g. "top copper", "inner copper 2", "outline".
std::string words_for(const BoardFileKind& kind);
// Parses such a name without a layer number. "nothing": the file is not used. Empty if there is no such layer.
std::optional<BoardFileKind> kind_of_words(std::string_view words);
// Determines the kind from .FileFunction, e.g. "Copper,L1,Top". Unknown if it does not identify a layer.
BoardFileKind kind_by_function(std::string_view function);
// Determines the kind from the file name, without folders.
BoardFileKind kind_by_name(std::string_view name);

struct BoardFile {
  std::string name;  // displayed name: "job.zip: gerbers/board-F_Cu.gbr"
  BoardFileKind kind = {};
  std::optional<GerberLayer> layer = {};
  std::optional<Drawing> drills = {};  // its holes, if it is a drill file
  std::string board = {};              // the KiCad board to which this layer belongs; empty: the file is a single layer
};

// Returns the name within the folder or archive.
std::string short_name(const BoardFile& file);

struct BoardJob {
  std::vector<BoardFile> files = {};       // the supported files, sorted by role
  std::vector<std::string> left_out = {};  // names of the files that are neither Gerber nor drill files
};

// Reports errors in `diagnostics`: "board.…" and those of the readers.
BoardJob read_board_job(const std::vector<std::string>& paths, Diagnostics& diagnostics);

// Sets the layer of a file, which is given by its name or short name, overriding the detected one. Returns the reason
// for a refusal; empty on success.
std::string set_kind(BoardJob& job, std::string_view name, std::string_view words);

// Reports an error if the files in use belong to several boards: two KiCad boards, or a KiCad board and separate layer
// files.
void refuse_two_boards(const BoardJob& job, Diagnostics& diagnostics);

// Returns the area of the board: the inside of its outline without the cutouts. Empty if there is no outline or if it
// is not closed within 0.1 mm.
Region board_face(const BoardJob& job);

}  // namespace passo
