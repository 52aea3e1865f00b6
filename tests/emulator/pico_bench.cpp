#include "emulator/pico_bench.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "passo/wire/announcement.hpp"

namespace passo {

std::string PicoBench::missing(const std::string& program) {
  const auto pico = EmulatedPico::start(program, pico_bare);
  return pico ? std::string() : pico.error();
}

PicoBench::PicoBench(const std::string& program, std::uint8_t motors, const PicoPins& pins, PicoSocket socket)
    : motors_(motors), pins_(pins) {
  auto pico = EmulatedPico::start(program, pins, socket);
  if (!pico) throw std::runtime_error(pico.error());
  pico_ = std::move(*pico);
  run(socket == PicoSocket::usb ? pico_clock_rate / 20 : pico_clock_rate / 1000);  // it starts, and USB is greeted
}

void PicoBench::run(std::uint64_t cycles, std::uint32_t watched, std::uint32_t rises) {
  const std::uint64_t end = pico_->cycle() + cycles;
  do {
    if (at_cycle && pico_->cycle() >= next_call_) next_call_ = at_cycle(pico_->cycle());
    const std::uint64_t until = at_cycle ? std::min(end, next_call_) : end;
    if (!pico_->run(until, {.watched = watched, .rises = rises})) throw std::runtime_error(pico_->error());
    for (const PicoChange& change : pico_->changes()) changes_.push_back({change.cycle, change.levels ^ inverted_});
    for (const std::uint8_t byte : pico_->said()) hear(byte);
  } while (at_cycle && pico_->cycle() < end && rises == 0);
}

void PicoBench::hear(std::uint8_t byte) {
  if (decoder_.feed(byte) != Decoded::frame) return;
  const WireFrame& frame = decoder_.frame();
  switch (frame.type) {
    case MessageType::hello_reply: {
      HelloReply reply;
      decode(frame, reply);
      capacity_ = reply.capacity;
      greeted_ = true;
      return;
    }
    case MessageType::credit: {
      Credit credit;
      decode(frame, credit);
      last_executed_ = static_cast<std::uint8_t>(credit.executed);
      return;
    }
    case MessageType::fault: return decode(frame, fault_.emplace());
    case MessageType::captured: return decode(frame, motors_, captured_.emplace());
    case MessageType::pin_setup: return decode(frame, made_.emplace());
    case MessageType::status: return decode(frame, motors_, status_.emplace());
    case MessageType::turned: return decode(frame, turned_.emplace());
    case MessageType::error: decode(frame, error_.emplace()); [[fallthrough]];
    default: ++complaints_;
  }
}

void PicoBench::send_item(const Item& item) {
  std::uint8_t frame[largest_frame];
  std::uint8_t size = 0;
  if (const auto* segment = std::get_if<BoardSegment>(&item)) {
    size = encode(*segment, motors_, ++last_sent_, frame);
  } else {
    size = encode(std::get<BoardOutputs>(item), ++last_sent_, frame);
  }
  send({frame, size});
}

void PicoBench::ask(const Ask& question) {
  std::uint8_t frame[largest_frame];
  Ask asked = question;
  asked.motors = motors_;
  status_.reset();
  turned_.reset();
  send({frame, encode(asked, 0, frame)});
}

void PicoBench::set_up(const PinSetup& setup) {
  const std::pair<std::uint16_t, std::uint8_t> inputs[] = {{input_limit, pins_.limits[0]},
                                                           {input_limit << 1U, pins_.limits[1]},
                                                           {input_limit << 2U, pins_.limits[2]},
                                                           {input_probe, pins_.probe},
                                                           {input_emergency_stop, pins_.emergency_stop},
                                                           {input_hold, pins_.feed_hold},
                                                           {input_start, pins_.cycle_start}};
  const std::pair<std::uint8_t, std::uint8_t> outputs[] = {{spindle_reverse, pins_.spindle_direction},
                                                           {mist_on, pins_.mist},
                                                           {flood_on, pins_.flood},
                                                           {inverted_enable, pins_.enable}};
  setup_ = setup;
  on_when_high_ = 0;
  for (const auto& [input, gpio] : inputs) on_when_high_ |= (setup.inputs & input) != 0 ? gpio_bit(gpio) : 0;
  inverted_ = std::uint32_t{pins_.steps_of(setup.steps)} << pins_.first;
  for (const auto& [output, gpio] : outputs) inverted_ |= (setup.outputs & output) != 0 ? gpio_bit(gpio) : 0;
  press(0);
  send_setup();
}

void PicoBench::send_setup() {
  std::uint8_t frame[largest_frame];
  send({frame, encode(setup_, 0, frame)});
  run(pico_clock_rate / 500);
}

void PicoBench::send_replace(std::span<const Item> items) {
  std::uint8_t frame[largest_frame];
  Announcement announcement(static_cast<std::uint16_t>(last_sent_ + 1), last_executed_, motors_);
  for (const Item& item : items) {
    if (const auto* segment = std::get_if<BoardSegment>(&item)) {
      announcement.add(frame, encode(*segment, motors_, 0, frame));
    } else {
      announcement.add(frame, encode(std::get<BoardOutputs>(item), 0, frame));
    }
  }
  send({frame, encode(announcement.replace(), ++last_sent_, frame)});
}

bool PicoBench::send_hello() {
  std::uint8_t frame[largest_frame];
  if (setup_ != PinSetup{}) send_setup();
  decoder_.set_motors(motors_);
  greeted_ = false;
  complaints_ = 0;
  send({frame, encode(Hello{.motors = motors_}, last_sent_, frame)});
  for (int i = 0; i < 20 && !greeted_; ++i) run(pico_clock_rate / 2000);
  last_executed_ = last_sent_;
  changes_.clear();
  return greeted_;
}

void PicoBench::start(const std::vector<Item>& items, std::uint8_t limit) {
  if (!send_hello()) throw std::runtime_error("the board does not answer");
  if (limit != 0) {
    ask({.question = Question::watch, .limit = limit});
    run(pico_clock_rate / 500);
  }
  levels_before_ = levels();
  send_replace(items);
  for (const Item& item : items) send_item(item);
}

EdgeCheck PicoBench::play(const std::vector<BoardSegment>& segments) {
  const std::uint64_t lost = pico_->lost_bytes();
  EdgeCheck result;
  if (!send_hello()) return result;
  levels_before_ = levels();
  const auto under_way = [this] { return static_cast<std::uint8_t>(last_sent_ - last_executed_); };
  const std::size_t first = std::min<std::size_t>(segments.size(), capacity_ - 1U);
  std::size_t sent = 0;
  send_replace(std::vector<Item>(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(first)));
  while (sent < first) send_item(segments[sent++]);
  const std::uint64_t start = pico_->cycle();
  std::uint64_t heard = start;
  while (sent < segments.size() || under_way() > 0) {
    while (sent < segments.size() && under_way() < capacity_) send_item(segments[sent++]);
    const std::uint8_t executed = last_executed_;
    run(pico_clock_rate / 1000);
    if (executed != last_executed_) heard = pico_->cycle();
    if (complaints_ > 0 || pico_->cycle() - heard > 15 * pico_clock_rate) break;
  }
  run(20'000);
  result = check(segments);
  result.finished = under_way() == 0 && sent == segments.size();
  result.complaints = complaints_;
  result.overruns = pico_->lost_bytes() - lost;
  result.seconds = static_cast<double>(pico_->cycle() - start) / pico_clock_rate;
  return result;
}

std::vector<SeenSteps> PicoBench::seen(EdgeCheck& result) const {
  std::vector<SeenSteps> seen(pins_.motors);
  std::vector<std::uint64_t> rose(pins_.motors, 0);
  std::vector<std::uint64_t> turned(pins_.motors, 0);
  std::uint32_t levels = levels_before_;
  for (const PicoChange& change : changes_) {
    const std::uint32_t turned_over = change.levels ^ levels;
    levels = change.levels;
    for (std::size_t m = 0; m < pins_.motors; ++m) {
      const std::uint32_t step = gpio_bit(pins_.motor[m].step);
      const std::uint32_t direction = gpio_bit(pins_.motor[m].direction);
      if ((turned_over & direction) != 0) turned[m] = change.cycle;
      if ((turned_over & step) == 0) continue;
      if ((levels & step) != 0) {
        seen[m].push_back({.time = static_cast<std::int64_t>(change.cycle), .down = (levels & direction) != 0});
        if (turned[m] != 0) result.shortest_setup = std::min(result.shortest_setup, change.cycle - turned[m]);
        turned[m] = 0;
        rose[m] = change.cycle;
      } else {
        result.shortest_pulse = std::min(result.shortest_pulse, change.cycle - rose[m]);
        result.longest_pulse = std::max(result.longest_pulse, change.cycle - rose[m]);
      }
    }
  }
  return seen;
}

EdgeCheck PicoBench::check(const std::vector<BoardSegment>& segments) const {
  EdgeCheck result;
  result.shortest_pulse = result.shortest_setup = std::numeric_limits<std::uint64_t>::max();
  std::vector<SeenSteps> expected = edges_of_model(segments, motors_, result.events);
  expected.resize(pins_.motors);
  const std::vector<SeenSteps> seen = this->seen(result);
  std::optional<std::int64_t> earliest;
  std::optional<std::int64_t> latest;
  for (std::size_t m = 0; m < expected.size(); ++m) {
    result.steps += seen[m].size();
    result.expected += expected[m].size();
    if (seen[m].size() != expected[m].size()) ++result.wrong_count;
    for (std::size_t i = 0; i < std::min(seen[m].size(), expected[m].size()); ++i) {
      const std::int64_t late = seen[m][i].time - expected[m][i].time * static_cast<std::int64_t>(pico_cycles_of_tick);
      earliest = std::min(earliest.value_or(late), late);
      latest = std::max(latest.value_or(late), late);
      if (seen[m][i].down != expected[m][i].down) ++result.wrong_direction;
    }
  }
  if (earliest) result.error = *latest - *earliest;
  return result;
}

}  // namespace passo
