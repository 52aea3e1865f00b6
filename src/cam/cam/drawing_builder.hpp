// DrawingBuilder: adds holes and paths to a drawing within its limits. Private to cam/.
//
// A coordinate too far from zero and too many points are errors; the builder reports the first one and then drops
// everything that is added.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

class DrawingBuilder {
 public:
  DrawingBuilder(const std::string& file, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    drawing_.file = file;
  }

  // Returns the index of the layer of this name; creates the layer if necessary.
  std::uint32_t layer(std::string_view name);
  void add_hole(const DrawnHole& hole);
  // Adds a path. Drops a path of fewer than two points.
  void add_path(DrawnPath path);
  void note(std::string words) { drawing_.notes.push_back(std::move(words)); }

  // Converts a length. Reports an error and returns nothing if the length exceeds the limit of a drawing.
  std::optional<Nanometres> length(Mm value, const SourceLocation& place, std::string_view text);
  std::optional<DrawnPoint> point(Mm x, Mm y, const SourceLocation& place, std::string_view text);
  // Reserves points before they are created. Reports an error and returns false if the limit would be exceeded.
  bool has_room_for(std::size_t points, const SourceLocation& place, std::string_view text);

  bool is_full() const { return is_full_; }
  const Drawing& drawing() const { return drawing_; }
  Drawing take() { return std::move(drawing_); }

 private:
  void refuse(std::string code, const SourceLocation& place, std::string_view text, std::string message,
              std::string expected);

  Diagnostics& diagnostics_;
  Drawing drawing_;
  std::unordered_map<std::string, std::uint32_t> layers_;
  std::size_t points_ = 0;
  bool is_full_ = false;
};

}  // namespace passo
