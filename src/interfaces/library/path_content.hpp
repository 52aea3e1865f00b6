// Path::Content: the pieces of a path. PathPieces: the pieces as a stage of the pipeline. Private to library/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/library/motion.hpp"
#include "passo/path/segment.hpp"

namespace passo::v1 {

struct PathPiece {
  enum class Kind : std::uint8_t { line, arc, stop };
  Kind kind = Kind::line;
  ArcPlane plane = ArcPlane::xy;
  int turns = 1;
  Position end;
  double first_centre = 0;
  double second_centre = 0;
  double speed = unlimited;
  double dwell = 0;
  double tolerance = 0;
};

struct Path::Content {
  Position start;
  double tolerance = 0.01;
  std::vector<PathPiece> pieces;
};

inline constexpr std::size_t most_pieces = 1'000'000;

// Returns what is wrong with the path, with the number of the piece. At most 20 errors.
std::vector<Finding> errors_of(const Path::Content& path, const Limits& limits);

// `path` must outlive the stage, and be without errors.
class PathPieces final : public passo::Source<passo::PathItem> {
 public:
  explicit PathPieces(const Path::Content& path);
  [[nodiscard]] bool next(passo::PathItem& item) override;

 private:
  const Path::Content& path_;
  std::size_t next_ = 0;
  passo::Point position_;
};

}  // namespace passo::v1
