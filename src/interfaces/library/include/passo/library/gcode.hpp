// Reads a G-code program as a sequence of operations: moves, dwells, tool changes and so on, in the order of execution.
// The reader resolves loops, subroutines, expressions, cycles and cutter compensation.
//
//   const passo::Outcome<passo::Program> program = passo::Program::open("part.ngc");
//   passo::OperationReader reader(*program);
//   passo::Operation operation;
//   while (reader.next(operation)) {
//     if (const auto* line = std::get_if<passo::operation::Line>(&operation.what)) ...
//   }
//
// The dialect is LinuxCNC's RS274/NGC, or the part of it that Grbl 1.1 has.
//
// Threads: a Program never changes, so several threads may use it at once. Only one thread at a time may use an
// OperationReader.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "passo/library/axes.hpp"
#include "passo/library/finding.hpp"

namespace passo::v1 {

// A program: a file or a text. Copies share it.
class PASSO_EXPORTED Program {
 public:
  // Errors: "file.*", e.g. if the file cannot be opened or is not G-code. Each use of the Program reads the file again,
  // so do not change the file while the Program exists.
  static Outcome<Program> open(const std::string& path);
  // `name` is the file name in findings.
  static Program from_text(std::string text, std::string name = "program");

  const std::string& name() const;

  struct Content;
  explicit Program(std::shared_ptr<const Content> content);  // for the library
  const Content& content() const { return *content_; }       // for the library

 private:
  std::shared_ptr<const Content> content_;
};

enum class GcodeDialect : std::uint8_t { linuxcnc, grbl };

// How a program is read.
struct ReadOptions {
  GcodeDialect dialect = GcodeDialect::linuxcnc;
  bool inches = false;          // lengths before the first G20 or G21 are in inches
  bool block_delete = false;    // skips lines that begin with '/'
  std::string tool_table = {};  // a file in LinuxCNC's format, in mm; empty: none
  std::string parameters = {};  // a file of numbered parameters (.var), with the work offsets; empty: none
  std::vector<std::string> sub_folders = {};  // folders of subroutine files, searched after the program's own
};

namespace operation {

// A speed along the path. For a move of A, B and C only: degrees instead of mm.
struct Feed {
  enum class Unit : std::uint8_t { mm_per_s, mm_per_turn };  // mm_per_turn: per revolution of the spindle (G95, G33)
  double value = 0;
  Unit unit = Unit::mm_per_s;
};
struct Line {
  Position start = {};
  Position end = {};
  bool rapid = false;
  Feed feed = {};           // of a feed move; a rapid has none
  bool in_machine = false;  // to a machine position (G53, G28, G30)
};
// The centre is given in the two axes of the plane. `turns`: as in Path::arc_to().
struct Arc {
  Position start = {};
  Position end = {};
  ArcPlane plane = ArcPlane::xy;
  double first_centre_mm = 0;
  double second_centre_mm = 0;
  int turns = 1;
  Feed feed = {};
};
// A rational B-spline in X and Y of degree `order` - 1, with clamped knots that are 1 apart. The first control point is
// the start, the last the end.
struct Spline {
  struct ControlPoint {
    double x_mm = 0;
    double y_mm = 0;
    double weight = 1;
  };
  std::vector<ControlPoint> points = {};
  int order = 3;
  Feed feed = {};
};
// A move until the probe is triggered, or until it opens.
struct Probe {
  Position start = {};
  Position end = {};
  bool until_triggered = true;
  bool must_change = true;  // an error if the probe does not change (G38.2, G38.4)
  Feed feed = {};
};
// Rigid tapping (G33.1): to `end`, where the spindle reverses, and back.
struct Tap {
  Position start = {};
  Position end = {};
  double pitch_mm = 0;
};
struct Dwell {
  double time_s = 0;
};
struct Spindle {
  enum class Direction : std::uint8_t { off, clockwise, counterclockwise };
  Direction direction = Direction::off;
  double speed_rpm = 0;  // the commanded speed; kept while the spindle is off
  int spindle = 0;       // its number, from 0
};
struct Coolant {
  bool mist = false;
  bool flood = false;
};
struct SelectTool {
  std::int32_t tool = 0;
};
struct ChangeTool {
  std::int32_t tool = 0;
};
struct Stop {
  bool optional = false;  // M1
};
struct End {};
// How corners are passed, from here on.
struct PathMode {
  enum class Mode : std::uint8_t { exact_path, exact_stop, continuous };  // G61, G61.1, G64
  Mode mode = Mode::continuous;
  double tolerance_mm = 0;  // for `continuous`; 0: the tolerance of the machine file
};
// The coordinate system, from here on. OperationReader::to_machine() applies it.
struct CoordinateSystem {
  int system = 1;  // 1 is G54, 9 is G59.3
  Position work_offset = {};
  Position g92_offset = {};
  Position tool_offset = {};
  double rotation_degrees = 0;  // about Z
};
// A text for the operator, or a comment.
struct Message {
  enum class Kind : std::uint8_t { comment, message, print };
  Kind kind = Kind::comment;
  std::string text = {};
};
// Any other operation, as a canonical call in LinuxCNC's notation: "SET_AUX_OUTPUT_BIT(3)".
struct Other {
  std::string call = {};
};

using Any = std::variant<Line, Arc, Spline, Probe, Tap, Dwell, Spindle, Coolant, SelectTool, ChangeTool, Stop, End,
                         PathMode, CoordinateSystem, Message, Other>;

}  // namespace operation

struct Operation {
  operation::Any what = {};
  std::uint32_t line = 0;  // of the file, from 1
};

class PASSO_EXPORTED OperationReader {
 public:
  explicit OperationReader(const Program& program, const ReadOptions& options = {});
  OperationReader(OperationReader&& other) noexcept;
  OperationReader& operator=(OperationReader&& other) noexcept;
  ~OperationReader();

  // Writes the next operation. Returns false at the end. After an error, the reader continues with the next line if
  // possible, so that it finds all errors. Positions are in work coordinates, in mm and degrees.
  bool next(Operation& operation);
  // Converts a work position to a machine position, with the coordinate system after the last operation.
  Position to_machine(const Position& work) const;
  // The findings so far. Errors: "gcode.*", at most 20.
  std::vector<Finding> findings() const;
  bool any_error() const;

  struct Content;

 private:
  std::unique_ptr<Content> content_;
};

}  // namespace passo::v1
