// passo cam profile --nest: copies of the parts of a drawing, nested on sheets.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cam_part.hpp"
#include <nlohmann/json.hpp>

#include "passo/nesting/nesting.hpp"

namespace passo {

inline constexpr Nanometres usual_nest_room{1'000'000};  // between the cuts of two copies

struct NestedDrawing {
  std::vector<PartDrawing> sheets = {};  // the contours on each
  Nest nest = {};
  NestOptions options = {};
  std::size_t parts = 0;  // of the drawing
};

// The options of nesting; `cut` has the cutter and its lead-in.
NestOptions nest_options_of(const CamProfileArguments& arguments, const OutlineOptions& cut, LengthArguments& lengths);

// A part is an outermost contour with everything in it. Shows errors "nest.…", and returns nothing then.
std::optional<NestedDrawing> nest_drawing(const PartDrawing& drawing, const std::string& file, std::uint32_t quantity,
                                          const NestOptions& options, const WorkProgress& progress);

// The least gap with which the cutter of one part does not touch another part.
Nanometres least_gap(const OutlineOptions& cut);

// A tab ends in the material between the cuts of two parts, so they must not overlap. `least`: as above.
Nanometres gap_with_tabs(Nanometres least);
// Whether there is a sheet with more than one part.
bool has_neighbours(const Nest& nest);
// Shows the warning "nest.tabs" if the gap is so small that parts lose their tabs.
void warn_of_cut_tabs(const Nest& nest, const NestOptions& options, const OutlineOptions& cut, const std::string& file);

// `parts`: number of different parts.
std::string nest_words(const Nest& nest, const NestOptions& options, std::size_t parts);
// `corner`: the lower left corner of the sheets. The copies have the coordinates of the program.
nlohmann::ordered_json nest_json(const Nest& nest, const NestOptions& options, DrawnPoint corner);
// plate-2.ngc of plate.ngc, if there are several sheets.
std::string sheet_file(const std::string& file, std::size_t sheet, std::size_t sheets);

}  // namespace passo
