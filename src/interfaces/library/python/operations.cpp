// Operations as tuples: the name of the class in Python, the line, and the values of its fields in order.
#include <string>
#include <variant>

#include <pybind11/pybind11.h>

#include "passo/library/gcode.hpp"

namespace py = pybind11;

namespace passo::python {
namespace {

py::tuple tuple_of(const Position& p) {
  return py::make_tuple(p.x, p.y, p.z, p.a, p.b, p.c, p.u, p.v, p.w);
}

py::tuple tuple_of(const operation::Feed& feed) {
  return py::make_tuple(feed.value, feed.unit == operation::Feed::Unit::mm_per_s ? "mm/s" : "mm/turn");
}

const char* name_of(ArcPlane plane) {
  return plane == ArcPlane::zx ? "zx" : plane == ArcPlane::yz ? "yz" : "xy";
}

const char* name_of(operation::Spindle::Direction direction) {
  switch (direction) {
    case operation::Spindle::Direction::clockwise: return "clockwise";
    case operation::Spindle::Direction::counterclockwise: return "counterclockwise";
    case operation::Spindle::Direction::off: break;
  }
  return "off";
}

const char* name_of(operation::PathMode::Mode mode) {
  switch (mode) {
    case operation::PathMode::Mode::exact_path: return "exact path";
    case operation::PathMode::Mode::exact_stop: return "exact stop";
    case operation::PathMode::Mode::continuous: break;
  }
  return "continuous";
}

const char* name_of(operation::Message::Kind kind) {
  switch (kind) {
    case operation::Message::Kind::message: return "message";
    case operation::Message::Kind::print: return "print";
    case operation::Message::Kind::comment: break;
  }
  return "comment";
}

class ToTuple {
 public:
  explicit ToTuple(std::uint32_t line) : line_(line) {}

  py::tuple operator()(const operation::Line& o) const {
    return of("Line", tuple_of(o.start), tuple_of(o.end), o.rapid, tuple_of(o.feed), o.in_machine);
  }
  py::tuple operator()(const operation::Arc& o) const {
    return of("Arc", tuple_of(o.start), tuple_of(o.end), name_of(o.plane),
              py::make_tuple(o.first_centre_mm, o.second_centre_mm), o.turns, tuple_of(o.feed));
  }
  py::tuple operator()(const operation::Spline& o) const {
    py::list points;
    for (const auto& point : o.points) points.append(py::make_tuple(point.x_mm, point.y_mm, point.weight));
    return of("Spline", py::tuple(points), o.order, tuple_of(o.feed));
  }
  py::tuple operator()(const operation::Probe& o) const {
    return of("Probe", tuple_of(o.start), tuple_of(o.end), o.until_triggered, o.must_change, tuple_of(o.feed));
  }
  py::tuple operator()(const operation::Tap& o) const {
    return of("Tap", tuple_of(o.start), tuple_of(o.end), o.pitch_mm);
  }
  py::tuple operator()(const operation::Dwell& o) const { return of("Dwell", o.time_s); }
  py::tuple operator()(const operation::Spindle& o) const {
    return of("Spindle", name_of(o.direction), o.speed_rpm, o.spindle);
  }
  py::tuple operator()(const operation::Coolant& o) const { return of("Coolant", o.mist, o.flood); }
  py::tuple operator()(const operation::SelectTool& o) const { return of("SelectTool", o.tool); }
  py::tuple operator()(const operation::ChangeTool& o) const { return of("ChangeTool", o.tool); }
  py::tuple operator()(const operation::Stop& o) const { return of("Stop", o.optional); }
  py::tuple operator()(const operation::End& /*end*/) const { return of("End"); }
  py::tuple operator()(const operation::PathMode& o) const { return of("PathMode", name_of(o.mode), o.tolerance_mm); }
  py::tuple operator()(const operation::CoordinateSystem& o) const {
    return of("CoordinateSystem", o.system, tuple_of(o.work_offset), tuple_of(o.g92_offset), tuple_of(o.tool_offset),
              o.rotation_degrees);
  }
  py::tuple operator()(const operation::Message& o) const { return of("Message", name_of(o.kind), words_of(o.text)); }
  py::tuple operator()(const operation::Other& o) const { return of("Other", words_of(o.call)); }

 private:
  // A program may hold any bytes.
  static py::object words_of(const std::string& text) {
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
  }
  template <class... Fields>
  py::tuple of(const char* name, Fields&&... fields) const {
    return py::make_tuple(name, line_, std::forward<Fields>(fields)...);
  }

  std::uint32_t line_;
};

}  // namespace

// Nothing at the end.
py::object next_operation(OperationReader& reader) {
  Operation operation;
  const bool is_one = [&] {
    const py::gil_scoped_release released;
    return reader.next(operation);
  }();
  if (!is_one) return py::none();
  return std::visit(ToTuple(operation.line), operation.what);
}

}  // namespace passo::python
