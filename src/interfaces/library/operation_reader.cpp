#include <optional>
#include <type_traits>
#include <utility>

#include "inner_types.hpp"
#include "program_content.hpp"

#include "passo/interpreter/canon.hpp"
#include "passo/interpreter/frame.hpp"

namespace passo::v1 {

Program::Program(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

Outcome<Program> Program::open(const std::string& path) {
  passo::Result<passo::ProgramReader, passo::Diagnostic> reader = passo::ProgramReader::open(path);
  if (!reader) return Outcome<Program>({finding_of(reader.error())});
  return Program(std::make_shared<const Content>(Content{std::move(*reader)}));
}

Program Program::from_text(std::string text, std::string name) {
  return Program(
      std::make_shared<const Content>(Content{passo::ProgramReader::from_text(std::move(name), std::move(text))}));
}

const std::string& Program::name() const {
  return content_->reader.name();
}

namespace {

ArcPlane plane_of(passo::Plane plane) {
  switch (plane) {
    case passo::Plane::zx: return ArcPlane::zx;
    case passo::Plane::yz: return ArcPlane::yz;
    default: return ArcPlane::xy;  // the planes of U V W have no arcs
  }
}

operation::Spindle::Direction direction_of(passo::SpindleDirection direction) {
  switch (direction) {
    case passo::SpindleDirection::clockwise: return operation::Spindle::Direction::clockwise;
    case passo::SpindleDirection::counterclockwise: return operation::Spindle::Direction::counterclockwise;
    case passo::SpindleDirection::off: break;
  }
  return operation::Spindle::Direction::off;
}

operation::PathMode path_mode_of(const passo::operation::SetPathMode& set) {
  operation::PathMode mode;
  switch (set.mode) {
    case passo::PathMode::exact_path: mode.mode = operation::PathMode::Mode::exact_path; break;
    case passo::PathMode::exact_stop: mode.mode = operation::PathMode::Mode::exact_stop; break;
    case passo::PathMode::continuous: mode.tolerance_mm = set.tolerance.value(); break;
  }
  return mode;
}

using Translated = std::optional<operation::Any>;

// Translates the inner operations one after another. Operations that only change what later ones contain are translated
// to nothing.
class OperationTranslator {
 public:
  Translated translate(const passo::Operation& from) {
    from_ = &from;
    return std::visit(*this, from.what);
  }
  const passo::Frame& frame() const { return frame_; }

  Translated operator()(const passo::operation::StraightTraverse& move) { return line_to(move.end, true); }
  Translated operator()(const passo::operation::StraightFeed& move) { return line_to(move.end, false); }
  Translated operator()(const passo::operation::ArcFeed& arc) {
    const Position start = go_to(arc.end);
    return operation::Arc{.start = start,
                          .end = work_,
                          .plane = plane_of(arc.plane),
                          .first_centre_mm = arc.first_center.value(),
                          .second_centre_mm = arc.second_center.value(),
                          .turns = arc.turns,
                          .feed = feed(true)};
  }
  Translated operator()(const passo::operation::NurbsFeed& curve) {
    operation::Spline spline{.points = {}, .order = curve.order, .feed = feed(true)};
    for (const passo::operation::ControlPoint& point : curve.points) {
      spline.points.push_back({point.x, point.y, point.weight});
    }
    if (!spline.points.empty()) {
      work_.x = spline.points.back().x_mm;
      work_.y = spline.points.back().y_mm;
    }
    return spline;
  }
  Translated operator()(const passo::operation::StraightProbe& probe) {
    const operation::Feed feed = feed_to(probe.end);
    const Position start = go_to(probe.end);
    return operation::Probe{
        .start = start, .end = work_, .until_triggered = probe.toward, .must_change = probe.must_touch, .feed = feed};
  }
  Translated operator()(const passo::operation::RigidTap& tap) {
    return operation::Tap{.start = work_, .end = position_of(tap.end), .pitch_mm = thread_pitch_};
  }
  Translated operator()(const passo::operation::StartSpeedFeedSync& sync) {
    thread_pitch_ = sync.pitch.value();
    return {};
  }
  Translated operator()(const passo::operation::StopSpeedFeedSync& /*stop*/) {
    thread_pitch_ = 0;
    return {};
  }
  Translated operator()(const passo::operation::SetFeedRate& set) {
    rate_ = set;
    return {};
  }

  Translated operator()(const passo::operation::SetWorkOffset& /*set*/) { return change_frame(); }
  Translated operator()(const passo::operation::SetG92Offset& /*set*/) { return change_frame(); }
  Translated operator()(const passo::operation::SetRotation& /*set*/) { return change_frame(); }
  Translated operator()(const passo::operation::SetToolOffset& /*set*/) { return change_frame(); }
  Translated operator()(const passo::operation::SetPathMode& set) { return path_mode_of(set); }

  Translated operator()(const passo::operation::Dwell& dwell) { return operation::Dwell{dwell.time.value()}; }
  Translated operator()(const passo::operation::SetSpindleSpeed& set) {
    spindle_.speed_rpm = set.revolutions_per_minute;
    spindle_.spindle = set.spindle;
    return spindle_;
  }
  Translated operator()(const passo::operation::TurnSpindle& turn) {
    spindle_.direction = direction_of(turn.direction);
    spindle_.spindle = turn.spindle;
    return spindle_;
  }
  Translated operator()(const passo::operation::SetMist& set) {
    coolant_.mist = set.on;
    return coolant_;
  }
  Translated operator()(const passo::operation::SetFlood& set) {
    coolant_.flood = set.on;
    return coolant_;
  }
  Translated operator()(const passo::operation::SelectTool& select) { return operation::SelectTool{select.tool}; }
  Translated operator()(const passo::operation::ChangeTool& change) { return operation::ChangeTool{change.tool}; }
  Translated operator()(const passo::operation::SetToolNumber& set) { return operation::ChangeTool{set.tool}; }
  Translated operator()(const passo::operation::ProgramStop& /*stop*/) { return operation::Stop{.optional = false}; }
  Translated operator()(const passo::operation::OptionalProgramStop& /*stop*/) {
    return operation::Stop{.optional = true};
  }
  Translated operator()(const passo::operation::ProgramEnd& /*end*/) { return operation::End{}; }
  Translated operator()(const passo::operation::Comment& comment) {
    return operation::Message{operation::Message::Kind::comment, std::string(comment.text)};
  }
  Translated operator()(const passo::operation::Message& message) {
    return operation::Message{operation::Message::Kind::message, std::string(message.text)};
  }
  Translated operator()(const passo::operation::Print& print) {
    return operation::Message{operation::Message::Kind::print, std::string(print.text)};
  }
  template <class What>
  Translated operator()(const What& /*what*/) {
    if constexpr (is_told_elsewhere<What>) return {};
    // "    7 N..... CALL(…)"
    std::string call;
    passo::CanonPrinter().print(*from_, call);
    const std::size_t number = call.find('N');
    const std::size_t space = call.find(' ', number == std::string::npos ? 0 : number);
    const std::size_t begin = call.find_first_not_of(' ', space);
    if (space == std::string::npos || begin == std::string::npos) return {};
    call.erase(0, begin);
    while (!call.empty() && (call.back() == '\n' || call.back() == ' ')) call.pop_back();
    return operation::Other{std::move(call)};
  }

 private:
  // What positions, feeds and other operations already say.
  template <class What>
  static constexpr bool is_told_elsewhere =
      std::is_same_v<What, passo::operation::SetFeedMode> || std::is_same_v<What, passo::operation::SetLengthUnits> ||
      std::is_same_v<What, passo::operation::SelectPlane> || std::is_same_v<What, passo::operation::Reset> ||
      std::is_same_v<What, passo::operation::SetFeedReference> ||
      std::is_same_v<What, passo::operation::StartToolChange> || std::is_same_v<What, passo::operation::TurnProbe> ||
      std::is_same_v<What, passo::operation::Finish> || std::is_same_v<What, passo::operation::SetMergeTolerance>;

  // Returns the position before.
  Position go_to(const passo::Point& end) { return std::exchange(work_, position_of(end)); }

  Translated line_to(const passo::Point& end, bool rapid) {
    const operation::Feed feed = rapid ? operation::Feed{} : feed_to(end);
    const Position start = go_to(end);
    return operation::Line{.start = start, .end = work_, .rapid = rapid, .feed = feed, .in_machine = from_->in_machine};
  }

  operation::Feed feed_to(const passo::Point& end) const {
    const Position to = position_of(end);
    bool is_linear = false;
    for (const Axis axis : all_axes) {
      is_linear = is_linear || (!passo::is_rotary(inner(axis)) && to[axis] != work_[axis]);
    }
    return feed(is_linear);
  }
  operation::Feed feed(bool is_linear) const {
    if (thread_pitch_ > 0) return {thread_pitch_, operation::Feed::Unit::mm_per_turn};
    if (const auto* turn = std::get_if<passo::operation::FeedPerRevolution>(&rate_.feed)) {
      return {is_linear ? turn->linear.value() : turn->rotary, operation::Feed::Unit::mm_per_turn};
    }
    const auto& second = std::get<passo::operation::FeedPerSecond>(rate_.feed);
    return {is_linear ? second.linear.value() : second.rotary, operation::Feed::Unit::mm_per_s};
  }

  // The coordinate system changes, the machine does not move.
  Translated change_frame() {
    const passo::Point machine = frame_.machine_from_work(point_of(work_));
    frame_.follow(*from_);
    work_ = position_of(frame_.work_from_machine(machine));
    return operation::CoordinateSystem{.system = frame_.work_system(),
                                       .work_offset = position_of(frame_.work_offset()),
                                       .g92_offset = position_of(frame_.g92_offset()),
                                       .tool_offset = position_of(frame_.tool_offset()),
                                       .rotation_degrees = frame_.rotation_degrees()};
  }

  const passo::Operation* from_ = nullptr;
  passo::Frame frame_;
  Position work_;
  passo::operation::SetFeedRate rate_{};
  double thread_pitch_ = 0;  // 0: moves do not follow the spindle
  operation::Spindle spindle_;
  operation::Coolant coolant_;
};

}  // namespace

struct OperationReader::Content {
  Content(const Program& program, const ReadOptions& options)
      : inner_options(interpreter_options_of(options, diagnostics)),
        interpreter(program.content().reader.again(), inner_options, diagnostics) {}

  passo::Diagnostics diagnostics;
  passo::InterpreterOptions inner_options;
  passo::Interpreter interpreter;
  OperationTranslator translator;
};

OperationReader::OperationReader(const Program& program, const ReadOptions& options)
    : content_(std::make_unique<Content>(program, options)) {}
OperationReader::OperationReader(OperationReader&& other) noexcept = default;
OperationReader& OperationReader::operator=(OperationReader&& other) noexcept = default;
OperationReader::~OperationReader() = default;

bool OperationReader::next(Operation& operation) {
  passo::Operation from;
  while (content_->interpreter.next(from)) {
    Translated what = content_->translator.translate(from);
    if (!what) continue;
    operation = {.what = std::move(*what), .line = from.source.line};
    return true;
  }
  return false;
}

Position OperationReader::to_machine(const Position& work) const {
  return position_of(content_->translator.frame().machine_from_work(point_of(work)));
}

std::vector<Finding> OperationReader::findings() const {
  return findings_of(content_->diagnostics);
}

bool OperationReader::any_error() const {
  return content_->diagnostics.any_error();
}

}  // namespace passo::v1
