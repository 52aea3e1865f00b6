#include "emulator/streamed_run.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include "emulator/winding_edges.hpp"

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/mega_windings.hpp"
#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/chip/uno_windings.hpp"
#include "passo/firmware/player.hpp"
#include "passo/wire/announcement.hpp"
#include "passo/wire/plain_parts.hpp"

namespace passo {
namespace {

constexpr std::uint64_t chip_clock = 16'000'000;

}  // namespace

std::vector<SeenSteps> edges_of_model(const std::vector<BoardSegment>& segments, std::uint8_t motors,
                                      std::uint64_t& events) {
  std::vector<SeenSteps> edges(motors);
  Player player(motors);
  std::int64_t now = 0;
  const auto play = [&](const BoardSegment& part) {
    for (player.load(part); !player.done();) {
      now += player.wait();
      ++events;
      const unsigned stepped = player.play();
      for (std::uint8_t m = 0; m < motors; ++m) {
        if ((stepped >> m & 1) != 0) edges[m].push_back({.time = now, .down = (part.directions >> m & 1) != 0});
      }
    }
  };
  for (const BoardSegment& segment : segments) for_each_plain_part(segment, play);
  return edges;
}

BoardUnderTest uno_under_test(const std::string& program) {
  BoardUnderTest board;
  board.program = program;
  board.motors.assign(std::begin(uno_cnc_shield.motor), std::end(uno_cnc_shield.motor));
  return board;
}

BoardUnderTest mega_under_test(const std::string& program, std::uint8_t motors) {
  BoardUnderTest board;
  board.program = program;
  board.mcu = "atmega2560";
  board.motors.assign(std::begin(mega_ramps.motor), std::begin(mega_ramps.motor) + motors);
  board.ports = "ABCDEFGHJKL";
  return board;
}

BoardUnderTest uno_windings_under_test(const std::string& program, const std::vector<DriveMode>& drives) {
  BoardUnderTest board;
  board.program = program;
  board.motors.assign(std::begin(uno_windings.motor), std::end(uno_windings.motor));
  for (std::size_t m = 0; m < board.motors.size(); ++m) board.motors[m].drive = drives.at(m);
  return board;
}

BoardUnderTest mega_windings_under_test(const std::string& program, const std::vector<DriveMode>& drives) {
  BoardUnderTest board;
  board.program = program;
  board.mcu = "atmega2560";
  board.motors.assign(std::begin(mega_windings.motor), std::end(mega_windings.motor));
  for (std::size_t m = 0; m < board.motors.size(); ++m) board.motors[m].drive = drives.at(m);
  board.ports = "ABCDEFGHJKL";
  return board;
}

BoardBench::BoardBench(const BoardUnderTest& board)
    : board_(board),
      chip_(std::make_unique<EmulatedChip>(board.program, board.mcu)),
      timer_(std::make_unique<EmulatedTimer>(*chip_)),
      uart_(std::make_unique<EmulatedUart>(*chip_, board.baud)),
      ports_(std::make_unique<EmulatedPorts>(*chip_, board.ports)) {
  uart_->on_byte = [this](std::uint8_t byte) { hear(byte); };
  chip_->run_for(100'000);  // it starts
}

void BoardBench::hear(std::uint8_t byte) {
  if (decoder_.feed(byte) != Decoded::frame) return;
  const WireFrame& frame = decoder_.frame();
  if (frame.type == MessageType::hello_reply) {
    HelloReply reply;
    decode(frame, reply);
    // No more than its page of received bytes has room for: a link would repeat what got lost, this one does not.
    const auto size = static_cast<std::uint8_t>(frame_overhead + segment_size + 2 * board_.motors.size());
    capacity_ = std::min<std::uint8_t>(reply.capacity, 247 / size);
    greeted_ = true;
  } else if (frame.type == MessageType::credit) {
    Credit credit;
    decode(frame, credit);
    last_executed_ = static_cast<std::uint8_t>(credit.executed);
  } else if (frame.type == MessageType::fault) {
    decode(frame, fault_.emplace());
  } else if (frame.type == MessageType::captured) {
    decode(frame, static_cast<std::uint8_t>(board_.motors.size()), captured_.emplace());
  } else if (frame.type == MessageType::status) {
    decode(frame, static_cast<std::uint8_t>(board_.motors.size()), status_.emplace());
  } else if (frame.type == MessageType::pin_setup) {
    decode(frame, pin_setup_.emplace());
  } else if (frame.type == MessageType::turned && on_turned) {
    Turned turned;
    decode(frame, turned);
    on_turned(turned);
  } else if (frame.type == MessageType::error) {
    decode(frame, error_.emplace());
    if (!before_item || error_->reason != WireError::bad_frame) ++complaints_;
  } else {
    ++complaints_;
  }
  chip_->stop();
}

void BoardBench::put_on_line(std::span<const std::uint8_t> frame) {
  uart_->send(frame);
  last_byte_ = frame.back();
}

void BoardBench::send_item(const BoardSegment& segment) {
  std::uint8_t frame[largest_frame];
  const std::uint8_t size = encode(segment, static_cast<std::uint8_t>(board_.motors.size()), ++last_sent_, frame);
  if (before_item) before_item({frame, size});
  put_on_line({frame, size});
}

void BoardBench::send_item(const BoardOutputs& outputs) {
  std::uint8_t frame[largest_frame];
  put_on_line({frame, encode(outputs, ++last_sent_, frame)});
}

void BoardBench::ask(const Ask& question) {
  std::uint8_t frame[largest_frame];
  Ask asked = question;
  asked.motors = static_cast<std::uint8_t>(board_.motors.size());
  status_.reset();
  put_on_line({frame, encode(asked, 0, frame)});
}

void BoardBench::send_replace(std::span<const Item> items) {
  std::uint8_t frame[largest_frame];
  const auto motors = static_cast<std::uint8_t>(board_.motors.size());
  Announcement announcement(static_cast<std::uint16_t>(last_sent_ + 1), last_executed_, motors);
  for (const Item& item : items) {
    if (const auto* segment = std::get_if<BoardSegment>(&item)) {
      announcement.add(frame, encode(*segment, motors, 0, frame));
    } else {
      announcement.add(frame, encode(std::get<BoardOutputs>(item), 0, frame));
    }
  }
  put_on_line({frame, encode(announcement.replace(), ++last_sent_, frame)});
}

bool BoardBench::send_hello() {
  std::uint8_t frame[largest_frame];
  const auto motors = static_cast<std::uint8_t>(board_.motors.size());
  const std::uint8_t size = encode(Hello{.motors = motors}, last_sent_, frame);
  decoder_.set_motors(motors);
  greeted_ = false;
  complaints_ = 0;
  error_.reset();
  put_on_line({frame, size});
  for (int i = 0; i < 20 && !greeted_; ++i) chip_->run_for(chip_clock / 1000);
  last_executed_ = last_sent_;
  ports_->forget_changes();
  return greeted_;
}

void BoardBench::start(const std::vector<BoardSegment>& segments, std::uint8_t limit) {
  if (!send_hello()) return;
  if (limit != 0) {
    ask({.question = Question::watch, .limit = limit});
    run(chip_clock / 200);
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(segments.size(), capacity_); ++i) send_item(segments[i]);
}

void BoardBench::start_items(const std::vector<Item>& items) {
  if (!send_hello()) return;
  send_replace(items);
  for (const Item& item : items) std::visit([this](const auto& one) { send_item(one); }, item);
}

void BoardBench::name_session(const Session& session) {
  std::uint8_t frame[largest_frame];
  put_on_line({frame, encode(session, 0, frame)});
}

void BoardBench::set_up(const PinSetup& setup) {
  std::uint8_t frame[largest_frame];
  pin_setup_.reset();
  put_on_line({frame, encode(setup, 0, frame)});
}

void BoardBench::run(std::uint64_t cycles) {
  const std::uint64_t end = chip_->cycles() + cycles;
  while (chip_->cycles() < end) chip_->run_for(end - chip_->cycles());
}

EdgeCheck BoardBench::play(const std::vector<BoardSegment>& segments) {
  const std::uint64_t lost = uart_->overruns();
  EdgeCheck result;
  if (!send_hello()) return result;

  std::size_t sent = 0;
  const std::uint64_t start = chip_->cycles();
  std::uint64_t heard = start;
  const auto under_way = [this] { return static_cast<std::uint8_t>(last_sent_ - last_executed_); };
  // A replacement begins when all of it has come: else the line would be too slow for short segments at the start.
  const std::size_t first = std::min<std::size_t>(segments.size(), capacity_ - 1U);
  send_replace(std::vector<Item>(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(first)));
  while (sent < first) send_item(segments[sent++]);
  while (sent < segments.size() || under_way() > 0) {
    while (sent < segments.size() && under_way() < capacity_) send_item(segments[sent++]);
    const std::uint8_t executed = last_executed_;
    chip_->run_for(chip_clock);
    if (executed != last_executed_) heard = chip_->cycles();
    if (complaints_ > 0 || chip_->cycles() - heard > 15 * chip_clock) break;
  }
  chip_->run_for(20'000);
  const std::uint64_t complaints = complaints_;
  result = check(segments);
  result.finished = under_way() == 0 && sent == segments.size();
  result.complaints = complaints;
  result.overruns = uart_->overruns() - lost;
  result.unwatched = uart_->longest_unwatched();
  result.seconds = static_cast<double>(chip_->cycles() - start) / chip_clock;
  return result;
}

// Their edges, and what the pulses are like.
void BoardBench::see_steps(std::vector<SeenSteps>& seen, EdgeCheck& result) const {
  const std::size_t motors = board_.motors.size();
  std::vector<std::uint64_t> rose(motors, 0);
  std::vector<std::uint64_t> turned(motors, 0);
  std::vector<bool> down(motors);
  for (std::size_t m = 0; m < motors; ++m) {
    const Pin pin = board_.motors[m].direction;
    // As it was before the first change.
    std::uint8_t level = ports_->outputs(pin.port);
    for (const PortChange& change : ports_->changes()) {
      if (change.port == pin.port) {
        level = change.before;
        break;
      }
    }
    down[m] = (level & pin.mask()) != 0;
  }
  for (const PortChange& change : ports_->changes()) {
    const unsigned turned_over = change.before ^ change.now;
    for (std::size_t m = 0; m < motors; ++m) {
      const MotorPins& pins = board_.motors[m];
      if (change.port == pins.direction.port && (turned_over & pins.direction.mask()) != 0) {
        down[m] = (change.now & pins.direction.mask()) != 0;
        turned[m] = change.cycle;
        if (rose[m] != 0) result.shortest_hold = std::min(result.shortest_hold, change.cycle - rose[m]);
      }
      if (change.port != pins.step.port || (turned_over & pins.step.mask()) == 0) continue;
      if ((change.now & pins.step.mask()) != 0) {
        seen[m].push_back({.time = static_cast<std::int64_t>(change.cycle), .down = down[m]});
        rose[m] = change.cycle;
        if (turned[m] != 0) result.shortest_setup = std::min(result.shortest_setup, change.cycle - turned[m]);
        turned[m] = 0;
      } else {
        result.shortest_pulse = std::min(result.shortest_pulse, change.cycle - rose[m]);
        result.longest_pulse = std::max(result.longest_pulse, change.cycle - rose[m]);
      }
    }
  }
}

void BoardBench::follow_windings() {
  places_.resize(board_.motors.size(), 0);
  for (std::size_t m = 0; m < places_.size(); ++m) winding_edges(board_.motors[m], ports_->changes(), places_[m]);
}

void BoardBench::see_windings(std::vector<SeenSteps>& seen, EdgeCheck& result) {
  places_.resize(board_.motors.size(), 0);
  for (std::size_t m = 0; m < board_.motors.size(); ++m) {
    const WindingEdges edges = winding_edges(board_.motors[m], ports_->changes(), places_[m]);
    for (const WindingStep& step : edges.steps) {
      seen[m].push_back({.time = static_cast<std::int64_t>(step.cycle), .down = step.down});
    }
    result.wrong_direction += edges.wrong;
    result.apart_in_motor = std::max(result.apart_in_motor, edges.apart);
  }
  std::uint64_t others = 0;  // changes of what is no winding
  for (const PortChange& change : ports_->changes()) {
    unsigned windings = 0;
    for (const MotorPins& motor : board_.motors) windings |= motor.winding_bits(change.port);
    if (((change.before ^ change.now) & ~windings) != 0) ++others;
  }
  result.wrong_direction += others;
}

std::vector<SeenSteps> BoardBench::seen() {
  EdgeCheck ignored;
  std::vector<SeenSteps> seen(board_.motors.size());
  if (board_.motors[0].windings[0].exists()) {
    see_windings(seen, ignored);
  } else {
    see_steps(seen, ignored);
  }
  return seen;
}

EdgeCheck BoardBench::check(const std::vector<BoardSegment>& segments) {
  EdgeCheck result;
  const auto motors = static_cast<std::uint8_t>(board_.motors.size());
  const std::vector<SeenSteps> expected = edges_of_model(segments, motors, result.events);
  std::vector<SeenSteps> seen(motors);
  constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
  result.shortest_pulse = result.shortest_setup = result.shortest_hold = never;
  if (board_.motors[0].windings[0].exists()) {
    see_windings(seen, result);
  } else {
    see_steps(seen, result);
  }
  std::optional<std::int64_t> first;
  std::optional<std::int64_t> last;
  for (std::uint8_t m = 0; m < motors; ++m) {
    result.steps += seen[m].size();
    result.expected += expected[m].size();
    if (seen[m].size() != expected[m].size()) ++result.wrong_count;
    std::optional<std::int64_t> earliest;
    std::optional<std::int64_t> latest;
    for (std::size_t i = 0; i < std::min(seen[m].size(), expected[m].size()); ++i) {
      const std::int64_t late = seen[m][i].time - expected[m][i].time;
      earliest = std::min(earliest.value_or(late), late);
      latest = std::max(latest.value_or(late), late);
      if (seen[m][i].down != expected[m][i].down) ++result.wrong_direction;
    }
    if (!earliest) continue;
    result.error = std::max(result.error, *latest - *earliest);
    first = std::min(first.value_or(*earliest), *earliest);
    last = std::max(last.value_or(*earliest), *earliest);
  }
  if (first) result.apart = *last - *first;
  return result;
}

// Makes eight times as many events of the segment, in parts of 2^part events, at the same rates. One or two motors are
// bent, or the intervals are a root's.
static void bend(std::mt19937_64& random, BoardSegment& segment, std::uint8_t motors, std::uint8_t part) {
  segment.events = static_cast<std::uint16_t>(std::min(8 * segment.events, int{most_events}));
  segment.change /= 8;
  segment.form = part;
  if (random() % 2 == 0) {
    // Slower and faster again, by a few percent: so many parts before the rest.
    segment.form = static_cast<std::uint8_t>(root_form + part);
    segment.change = 0x7f'ffff;
  }
  const auto lender = static_cast<unsigned>(random() % motors);
  if (random() % 4 == 0 && motors >= least_motors_to_bend_two) {
    segment.flips = static_cast<std::uint8_t>(segment.flips | 1U << lender);
    segment.increments[lender] = static_cast<std::uint16_t>(random());
    segment.bend = static_cast<std::uint8_t>((1 + random() % largest_scale) | lender << bend_shift<max_motors>);
    return;
  }
  const unsigned bent = (lender + 1U) % motors;
  const unsigned master = segment.flips & ~(1U << lender) & ~(1U << bent);
  if (random() % 4 == 0 || master == 0) return;
  segment.flips = static_cast<std::uint8_t>(segment.flips & ~(1U << lender));
  segment.increments[lender] = static_cast<std::uint16_t>(random() % 2000);
  segment.bend = static_cast<std::uint8_t>(bent | lender << bend_shift<max_motors>);
}

std::vector<BoardSegment> random_stream(std::mt19937_64& random, std::uint8_t motors, const StreamKind& kind) {
  const auto between = [&random](std::uint32_t least, std::uint32_t most) {
    return least + static_cast<std::uint32_t>(random() % (most - least + 1));
  };
  std::vector<BoardSegment> segments;
  const unsigned all = (1U << motors) - 1;
  std::uint32_t interval = between(kind.shortest_interval << 16, kind.longest_interval << 16);
  if (kind.ramp > 0) interval *= 5;
  for (int i = 0; i < kind.segments; ++i) {
    BoardSegment segment;
    segment.events = static_cast<std::uint8_t>(between(kind.shortest_segment, kind.longest_segment));
    segment.directions = kind.reversing ? static_cast<std::uint8_t>(random() & all) : std::uint8_t{0};
    segment.flips = static_cast<std::uint8_t>(kind.all_at_every_event ? all : random() & all);
    for (std::uint8_t m = 0; m < motors; ++m) {
      segment.increments[m] = kind.all_at_every_event ? std::uint16_t{0} : static_cast<std::uint16_t>(random());
    }
    if (!kind.all_at_every_event) {  // the master
      const std::uint32_t master = between(0, motors - 1U);
      segment.increments[master] = 0;
      segment.flips = static_cast<std::uint8_t>(segment.flips | 1U << master);
    }
    // From this rate to another within the bounds, as evenly as whole numbers allow.
    std::uint32_t target = between(kind.shortest_interval << 16, kind.longest_interval << 16);
    if (i < kind.ramp) target += target / 100 * static_cast<std::uint32_t>(400 * (kind.ramp - 1 - i) / kind.ramp);
    segment.interval = interval;
    const std::int64_t change = (static_cast<std::int64_t>(target) - interval) / segment.events;
    segment.change = static_cast<std::int32_t>(change);
    if (!is_fine(segment.change)) segment.change -= segment.change % coarse_change;
    interval = static_cast<std::uint32_t>(interval + static_cast<std::int64_t>(segment.change) * segment.events);
    if (kind.part > 0) bend(random, segment, motors, kind.part);
    segments.push_back(segment);
  }
  return segments;
}

}  // namespace passo
