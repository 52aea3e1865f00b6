// DrawingBuilder: adds holes and paths to a drawing within its limits. Private to cam/.
//
// A coordinate too far from zero, or too many points, are an error, which the builder reports once. Everything that is
// added afterwards is dropped.
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

  // The layer's index; a new name makes a new layer.
  std::uint32_t layer(std::string_view name);
  void add_hole(const DrawnHole& hole);
  // A path of fewer than two points is dropped.
  void add_path(DrawnPath path);
  void note(std::string words) { drawing_.notes.push_back(std::move(words)); }

  // Empty, and reported: farther from zero than a drawing may be.
  std::optional<Nanometres> length(Mm value, const SourcePlace& place, std::string_view text);
  std::optional<DrawnPoint> point(Mm x, Mm y, const SourcePlace& place, std::string_view text);
  // Counts points before they are made. False, and reported: too many.
  bool has_room_for(std::size_t points, const SourcePlace& place, std::string_view text);

  bool is_full() const { return is_full_; }
  const Drawing& drawing() const { return drawing_; }
  Drawing take() { return std::move(drawing_); }

 private:
  void refuse(std::string code, const SourcePlace& place, std::string_view text, std::string message,
              std::string expected);

  Diagnostics& diagnostics_;
  Drawing drawing_;
  std::unordered_map<std::string, std::uint32_t> layers_;
  std::size_t points_ = 0;
  bool is_full_ = false;
};

}  // namespace passo
