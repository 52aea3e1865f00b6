// passo._core: what the Python package passo takes from libpasso. The package's own files make typed classes of it.
//
// Long calls release the interpreter's lock. Errors in files become passo.Error, which holds the findings. Ctrl-C ends
// a check or a plan.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "passo/library/axes.hpp"
#include "passo/library/check.hpp"
#include "passo/library/finding.hpp"
#include "passo/library/gcode.hpp"
#include "passo/library/motion.hpp"
#include "passo/library/picture.hpp"

namespace py = pybind11;

namespace {

// The axes that a call names; the others keep their values.
struct NamedAxes {
  std::array<std::optional<double>, passo::axis_count> values;

  static NamedAxes of(const py::kwargs& words) {
    NamedAxes named;
    for (const auto& [name, value] : words) {
      const auto text = name.cast<std::string>();
      const std::size_t axis = text.size() == 1 ? std::string("xyzabcuvw").find(text) : std::string::npos;
      if (axis == std::string::npos) throw py::type_error("unexpected keyword argument '" + text + "'");
      named.values[axis] = value.cast<double>();
    }
    return named;
  }
  passo::Position on(passo::Position place) const {
    for (const passo::Axis axis : passo::all_axes) {
      if (const auto& value = values[static_cast<std::size_t>(axis)]) place[axis] = *value;
    }
    return place;
  }
};

// A file may hold any bytes.
py::object words_of(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

py::tuple tuple_of(const passo::Finding& finding) {
  const bool is_error = finding.severity == passo::Severity::error;
  return py::make_tuple(is_error ? "error" : "warning", finding.code, words_of(finding.file), finding.line,
                        finding.column, finding.length, words_of(finding.message), words_of(finding.expected),
                        words_of(finding.text), words_of(passo::describe(finding)));
}

py::list list_of(const std::vector<passo::Finding>& findings) {
  py::list list;
  for (const passo::Finding& finding : findings) list.append(tuple_of(finding));
  return list;
}

[[noreturn]] void raise(const std::vector<passo::Finding>& findings) {
  const py::object type = py::module_::import("passo._findings").attr("Error");
  const py::object error = type(py::module_::import("passo._findings").attr("findings_of")(list_of(findings)));
  PyErr_SetObject(type.ptr(), error.ptr());
  throw py::error_already_set();
}

template <class T>
T value_or_raise(passo::Outcome<T> outcome) {
  if (!outcome) raise(outcome.findings());
  return std::move(*outcome);
}

passo::GcodeDialect dialect_of(const std::string& name) {
  if (name == "linuxcnc") return passo::GcodeDialect::linuxcnc;
  if (name == "grbl") return passo::GcodeDialect::grbl;
  throw py::value_error("dialect '" + name + "'; expected 'linuxcnc' or 'grbl'");
}

passo::ReadOptions read_options(const std::string& dialect, bool inches, bool block_delete, std::string tool_table,
                                std::string parameters, std::vector<std::string> sub_folders) {
  return {.dialect = dialect_of(dialect),
          .inches = inches,
          .block_delete = block_delete,
          .tool_table = std::move(tool_table),
          .parameters = std::move(parameters),
          .sub_folders = std::move(sub_folders)};
}

passo::CheckOptions check_options(const passo::ReadOptions& read, bool plans, double feed_factor, double rapid_factor,
                                  const py::object& progress) {
  passo::CheckOptions options{
      .read = read, .plans = plans, .feed_factor = feed_factor, .rapid_factor = rapid_factor, .progress = {}};
  // The caller's stack keeps `progress`.
  options.progress = [&progress](double share) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(share);
  };
  return options;
}

py::object range_of(const std::optional<passo::AxisRange>& range) {
  return range ? py::object(py::make_tuple(range->low, range->high)) : py::object(py::none());
}

std::string letter(passo::Axis axis) {
  return {passo::letter_of(axis)};
}

const char* verdict_of(passo::StepVerdict verdict) {
  switch (verdict) {
    case passo::StepVerdict::safe: return "safe";
    case passo::StepVerdict::doubtful: return "doubtful";
    case passo::StepVerdict::lost: break;
  }
  return "lost";
}

py::tuple tuple_of(const passo::MotionReport& report) {
  py::list axes;
  for (const passo::AxisMotion& axis : report.axes) {
    axes.append(py::make_tuple(letter(axis.axis), range_of(axis.extents), range_of(axis.cutting_extents),
                               axis.highest_mm_per_s, axis.highest_mm_per_s2));
  }
  py::list limits;
  for (const passo::SpeedLimit& limit : report.speed_limits) {
    limits.append(py::make_tuple(limit.limit, limit.time_s, limit.first_line));
  }
  py::list slowest;
  for (const passo::SlowLine& line : report.slowest_lines) {
    slowest.append(py::make_tuple(line.line, line.mean_mm_per_s, line.programmed_mm_per_s, line.lost_s, line.limit));
  }
  py::list spots;
  for (const passo::WeakSpot& spot : report.weak_spots) {
    spots.append(py::make_tuple(letter(spot.axis), spot.line, spot.time_s, verdict_of(spot.verdict), spot.load,
                                spot.cause, spot.cure));
  }
  const py::object motors = report.motors ? py::object(py::str(verdict_of(*report.motors))) : py::object(py::none());
  return py::make_tuple(report.cutting_time_s, report.rapid_time_s, report.dwell_time_s, report.cutting_length_mm,
                        report.rapid_length_mm, report.moves, report.tool_changes, axes, limits, slowest, motors,
                        spots);
}

py::tuple check(const passo::Program& program, const passo::Machine& machine, const passo::ReadOptions& read,
                bool plans, double feed_factor, double rapid_factor, const py::object& progress) {
  const passo::CheckOptions options = check_options(read, plans, feed_factor, rapid_factor, progress);
  passo::ProgramReport report;
  {
    const py::gil_scoped_release unlocked;
    report = passo::check(program, machine, options);
  }
  return py::make_tuple(list_of(report.findings),
                        report.motion ? py::object(tuple_of(*report.motion)) : py::object(py::none()));
}

// A plan, or another long call without the interpreter's lock.
template <class Call>
auto unlocked(const Call& call) {
  auto outcome = [&call] {
    const py::gil_scoped_release released;
    return call();
  }();
  return value_or_raise(std::move(outcome));
}

passo::Motion plan_program(const passo::Program& program, const passo::Machine& machine, const passo::ReadOptions& read,
                           double feed_factor, double rapid_factor, const py::object& progress) {
  const passo::CheckOptions options = check_options(read, true, feed_factor, rapid_factor, progress);
  return unlocked([&] { return passo::plan(program, machine, options); });
}

// By letter: velocity, acceleration, jerk.
using LimitTuples = std::vector<std::tuple<char, double, double, double>>;

passo::Axis axis_of(char letter) {
  for (const passo::Axis axis : passo::all_axes) {
    if (passo::letter_of(axis) == letter) return axis;
  }
  throw py::value_error(std::string("axis '") + letter + "'; expected one of XYZABCUVW");
}

passo::Motion plan_path(const passo::Path& path, const LimitTuples& tuples) {
  passo::Limits limits;
  for (const auto& [name, velocity, acceleration, jerk] : tuples) {
    limits[axis_of(name)] = {
        .velocity_mm_per_s = velocity, .acceleration_mm_per_s2 = acceleration, .jerk_mm_per_s3 = jerk};
  }
  return unlocked([&] { return passo::plan(path, limits); });
}

std::vector<passo::Axis> axes_of(const std::string& letters) {
  std::vector<passo::Axis> axes;
  for (const char name : letters) axes.push_back(axis_of(name));
  return axes;
}

py::tuple sample(const passo::Motion& motion, double from, double interval, std::size_t count,
                 const std::string& letters) {
  constexpr std::size_t most = 100'000'000;
  if (count > most || !(interval >= 0))
    throw py::value_error("expected an interval of 0 or more, and at most 100,000,000 samples");
  const std::vector<passo::Axis> axes = axes_of(letters);
  const std::array<std::size_t, 2> shape{count, axes.size()};
  py::array_t<double> position(shape);
  py::array_t<double> velocity(shape);
  py::array_t<double> acceleration(shape);
  py::array_t<double> speed(static_cast<py::ssize_t>(count));
  py::array_t<std::uint32_t> piece(static_cast<py::ssize_t>(count));
  double* const to_position = position.mutable_data();
  double* const to_velocity = velocity.mutable_data();
  double* const to_acceleration = acceleration.mutable_data();
  double* const to_speed = speed.mutable_data();
  std::uint32_t* const to_piece = piece.mutable_data();
  {
    const py::gil_scoped_release released;
    constexpr std::size_t most_at_once = 1024;
    std::vector<passo::MotionState> states(std::min(count, most_at_once));
    for (std::size_t begin = 0; begin < count; begin += most_at_once) {
      const std::size_t now = std::min(most_at_once, count - begin);
      motion.sample(from + static_cast<double>(begin) * interval, interval, now, states.data());
      for (std::size_t i = 0; i < now; ++i) {
        for (std::size_t a = 0; a < axes.size(); ++a) {
          const std::size_t place = (begin + i) * axes.size() + a;
          to_position[place] = states[i].position[axes[a]];
          to_velocity[place] = states[i].velocity[axes[a]];
          to_acceleration[place] = states[i].acceleration[axes[a]];
        }
        to_speed[begin + i] = states[i].speed_mm_per_s;
        to_piece[begin + i] = states[i].piece;
      }
    }
  }
  return py::make_tuple(position, velocity, acceleration, speed, piece);
}

passo::StepTrain steps_of(const passo::Motion& motion, const std::vector<std::pair<char, double>>& scales,
                          double ticks_per_s, double events_per_s) {
  if (scales.empty()) return value_or_raise(motion.steps());
  passo::StepOptions options;
  for (const auto& [name, scale] : scales) options[axis_of(name)] = scale;
  options.ticks_per_s = ticks_per_s;
  options.events_per_s = events_per_s;
  return value_or_raise(motion.steps(options));
}

py::tuple read_steps(passo::StepTrain& train, std::size_t most) {
  std::vector<std::int64_t> ticks;
  std::vector<std::uint8_t> axes;
  std::vector<std::uint8_t> forward;
  {
    const py::gil_scoped_release released;
    std::array<passo::Step, 4096> steps;
    while (ticks.size() < most) {
      const std::size_t count = train.read(steps.data(), std::min(steps.size(), most - ticks.size()));
      if (count == 0) break;
      for (std::size_t i = 0; i < count; ++i) {
        ticks.push_back(steps[i].tick);
        axes.push_back(static_cast<std::uint8_t>(steps[i].axis));
        forward.push_back(steps[i].forward ? 1 : 0);
      }
    }
  }
  const auto size = static_cast<py::ssize_t>(ticks.size());
  return py::make_tuple(py::array_t<std::int64_t>(size, ticks.data()), py::array_t<std::uint8_t>(size, axes.data()),
                        py::array_t<std::uint8_t>(size, forward.data()).attr("astype")("bool"));
}

py::array_t<std::uint8_t> array_of(const passo::Picture& picture) {
  return py::array_t<std::uint8_t>(std::array<std::size_t, 3>{picture.height, picture.width, 3}, picture.rgb.data());
}

passo::PictureOptions picture_options(std::string title, const std::string& tint, bool rapids, int width, int height) {
  passo::PictureOptions options{
      .title = std::move(title), .tint = passo::PathTint::speed, .rapids = rapids, .width = width, .height = height};
  if (tint == "depth")
    options.tint = passo::PathTint::depth;
  else if (tint == "tool")
    options.tint = passo::PathTint::tool;
  else if (tint == "torque")
    options.tint = passo::PathTint::torque;
  else if (tint != "speed")
    throw py::value_error("tint '" + tint + "'; expected 'speed', 'depth', 'tool' or 'torque'");
  return options;
}

py::array_t<std::uint8_t> toolpath(const passo::Program& program, const passo::Machine& machine,
                                   const passo::ReadOptions& read, const passo::PictureOptions& options) {
  return array_of(unlocked([&] { return passo::draw_toolpath(program, machine, options, read); }));
}

// (kind, diameter, angle, tip), or nothing.
using ToolTuple = std::optional<std::tuple<std::string, double, double, double>>;
using Range = std::optional<std::pair<double, double>>;

std::optional<passo::AxisRange> range_of(const Range& range) {
  if (!range) return std::nullopt;
  return passo::AxisRange{range->first, range->second};
}

py::tuple cut(const passo::Program& program, const passo::ReadOptions& read, const ToolTuple& tool,
              std::string tools_file, const Range& x, const Range& y, const Range& z, double cell, unsigned threads) {
  passo::StockOptions options{.read = read,
                              .tool = {},
                              .tools_file = std::move(tools_file),
                              .x_mm = range_of(x),
                              .y_mm = range_of(y),
                              .z_mm = range_of(z),
                              .cell_mm = cell,
                              .threads = threads};
  if (tool) {
    const auto& [kind, diameter, angle, tip] = *tool;
    using Kind = passo::MillingTool::Kind;
    options.tool = passo::MillingTool{.kind = kind == "ball"  ? Kind::ball
                                              : kind == "vee" ? Kind::vee
                                                              : Kind::flat,
                                      .diameter_mm = diameter,
                                      .included_angle_deg = angle,
                                      .tip_diameter_mm = tip};
  }
  passo::Outcome<passo::Stock> outcome = [&] {
    const py::gil_scoped_release released;
    return passo::cut_stock(program, options);
  }();
  if (!outcome) raise(outcome.findings());
  const passo::Stock& stock = *outcome;
  const py::array_t<float> heights(std::array<std::size_t, 2>{stock.rows, stock.columns}, stock.below_top_mm.data());
  return py::make_tuple(heights, stock.cell_mm, stock.left_mm, stock.front_mm, stock.top_mm, stock.bottom_mm,
                        stock.removed_mm3, list_of(outcome.findings()));
}

py::array_t<std::uint8_t> stock_picture(const py::array_t<float, py::array::c_style | py::array::forcecast>& heights,
                                        double cell, double left, double front, double top, double bottom,
                                        const passo::PictureOptions& options) {
  if (heights.ndim() != 2) throw py::value_error("expected heights in rows and columns");
  passo::Stock stock{.cell_mm = cell,
                     .left_mm = left,
                     .front_mm = front,
                     .top_mm = top,
                     .bottom_mm = bottom,
                     .columns = static_cast<std::size_t>(heights.shape(1)),
                     .rows = static_cast<std::size_t>(heights.shape(0)),
                     .below_top_mm = {heights.data(), heights.data() + heights.size()},
                     .removed_mm3 = 0};
  return array_of(unlocked([&] { return passo::draw_stock(stock, options); }));
}

py::bytes png_of(const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>& pixels) {
  if (pixels.ndim() != 3 || pixels.shape(2) != 3) throw py::value_error("expected an array of height x width x 3");
  const passo::Picture picture{.width = static_cast<std::size_t>(pixels.shape(1)),
                               .height = static_cast<std::size_t>(pixels.shape(0)),
                               .rgb = {pixels.data(), pixels.data() + pixels.size()}};
  std::string bytes = passo::png_of(picture);
  if (bytes.empty()) throw py::value_error("expected 1 to 65,535 pixels in each direction");
  return bytes;
}

}  // namespace

namespace passo::python {
py::object next_operation(passo::OperationReader& reader);
}

PYBIND11_MODULE(_core, module) {
  module.doc() = "What the package passo takes from libpasso.";
  module.def("version", &passo::library_version);

  py::class_<passo::ReadOptions>(module, "ReadOptions").def(py::init(&read_options));
  py::class_<passo::PictureOptions>(module, "PictureOptions").def(py::init(&picture_options));
  py::class_<passo::Program>(module, "Program")
      .def_static("open", [](const std::string& path) { return value_or_raise(passo::Program::open(path)); })
      .def_static("from_text", &passo::Program::from_text)
      .def_property_readonly("name", &passo::Program::name);
  py::class_<passo::Machine>(module, "Machine")
      .def_static("open", [](const std::string& path) { return value_or_raise(passo::Machine::open(path)); })
      .def_static("from_text",
                  [](const std::string& text, const std::string& name) {
                    return value_or_raise(passo::Machine::from_text(text, name));
                  })
      .def_property_readonly("name", &passo::Machine::name)
      .def_property_readonly("axes",
                             [](const passo::Machine& machine) {
                               std::string letters;
                               for (const passo::Axis axis : machine.axes()) letters += passo::letter_of(axis);
                               return letters;
                             })
      .def_property_readonly("knows_motors", &passo::Machine::knows_motors)
      .def("limits", [](const passo::Machine& machine) {
        LimitTuples tuples;
        const passo::Limits limits = machine.limits();
        for (const passo::Axis axis : machine.axes()) {
          const passo::AxisLimits& own = limits[axis];
          tuples.emplace_back(passo::letter_of(axis), own.velocity_mm_per_s, own.acceleration_mm_per_s2,
                              own.jerk_mm_per_s3);
        }
        return tuples;
      });

  py::class_<passo::Path>(module, "Path")
      .def(py::init([](const py::kwargs& start) { return passo::Path(NamedAxes::of(start).on({})); }))
      .def("__len__", &passo::Path::size)
      .def("set_tolerance", &passo::Path::set_tolerance, py::arg("tolerance"))
      .def(
          "line_to",
          [](passo::Path& path, double speed, const py::kwargs& end) {
            path.line_to(NamedAxes::of(end).on(path.end()), speed);
          },
          py::kw_only(), py::arg("speed") = passo::unlimited)
      .def(
          "arc_to",
          [](passo::Path& path, const std::pair<double, double>& centre, const std::string& plane, int turns,
             double speed, const py::kwargs& end) {
            passo::ArcPlane in = passo::ArcPlane::xy;
            if (plane == "zx")
              in = passo::ArcPlane::zx;
            else if (plane == "yz")
              in = passo::ArcPlane::yz;
            else if (plane != "xy")
              throw py::value_error("plane '" + plane + "'; expected 'xy', 'zx' or 'yz'");
            path.arc_to(NamedAxes::of(end).on(path.end()), in, centre.first, centre.second, turns, speed);
          },
          py::kw_only(), py::arg("centre"), py::arg("plane") = "xy", py::arg("turns") = 1,
          py::arg("speed") = passo::unlimited)
      .def("stop", &passo::Path::stop, py::arg("dwell") = 0);

  py::class_<passo::StepTrain>(module, "StepTrain")
      .def_property_readonly("ticks_per_s", &passo::StepTrain::ticks_per_s)
      .def("read", &read_steps);
  py::class_<passo::Motion>(module, "Motion")
      .def_property_readonly("duration", &passo::Motion::duration_s)
      .def_property_readonly("length", &passo::Motion::length_mm)
      .def("sample", &sample)
      .def("steps", &steps_of);
  py::class_<passo::OperationReader>(module, "OperationReader")
      .def(py::init<const passo::Program&, const passo::ReadOptions&>())
      .def("next", &passo::python::next_operation)
      .def("findings", [](const passo::OperationReader& reader) { return list_of(reader.findings()); });

  module.def("check", &check);
  module.def("plan_path", &plan_path);
  module.def("plan_program", &plan_program);
  module.def("toolpath", &toolpath);
  module.def("cut", &cut);
  module.def("stock_picture", &stock_picture);
  module.def("png_of", &png_of);
}
