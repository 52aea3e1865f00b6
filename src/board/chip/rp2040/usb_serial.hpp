// UsbSerial: a serial port over the chip's own USB connector, without a library: the device side of USB 2.0 at full
// speed, as far as a serial port (CDC ACM) needs it.
//
// All work is done in poll(), which the main loop calls; the interrupt only wakes the loop. A host waits milliseconds
// for an answer, and a pass of the loop takes microseconds. Each direction has one buffer in the controller's memory:
// it is read in place, and given back when it is empty. Until then the controller makes the host wait (NAK), and no
// data is lost.
//
// Invariant: a buffer belongs either to the controller or to the program.
#pragma once

#include "registers.hpp"
#include "usb_descriptors.hpp"

namespace passo::chip {

class UsbSerial {
 public:
  // The controller must be out of reset, and its clock at 48 MHz.
  static void open() {
    for (uint32_t at = 0; at < usb_memory_size; at += 4) usb_word(at) = 0;
    UsbMuxing::write(1U << 3 | 1U << 0);  // connects the controller to the pins
    UsbPower::write(1U << 3 | 1U << 2);   // as if the bus had power: the VBUS pin is not connected
    UsbMain::write(1);
    UsbSieControl::write(usb_interrupt_per_buffer | usb_pull_up);
    UsbInterrupts::write(1U << 16 | 1U << 12 | 1U << 4);  // setup, reset, buffers
  }

  void poll() {
    const uint32_t status = UsbSieStatus::read() & (usb_bus_reset | usb_setup_received);
    if ((status & usb_bus_reset) != 0) reset();
    const uint32_t done = UsbBuffers::read();
    if (done != 0) {
      UsbBuffers::write(done);
      if ((done & bit_of(0, true)) != 0) control_sent();
      if ((done & bit_of(0, false)) != 0) control_came();
      if ((done & bit_of(usb_data, true)) != 0) sending_ = false;
      if ((done & bit_of(usb_data, false)) != 0) handle_packet();
    }
    if ((status & usb_setup_received) != 0) handle_setup();
    send_packet();
  }
  // Enables wake-up of the loop by the interrupt.
  static void wake_on_news() { NvicEnable::write(1U << irq_usb); }
  static bool has_news() {
    return UsbBuffers::read() != 0 || (UsbSieStatus::read() & (usb_bus_reset | usb_setup_received)) != 0;
  }
  static void interrupt() { NvicDisable::write(1U << irq_usb); }

  bool has_byte() const { return read_ < received_; }
  uint8_t take() {
    const uint8_t byte = usb_byte(out_buffer + read_++);
    if (read_ == received_) await_packet();
    return byte;
  }

  // Bytes that the host does not fetch are dropped, because the cable may be unplugged.
  void send(uint8_t byte) {
    if (room() == 0) return;
    ring_[head_++ & ring_mask] = byte;
  }
  uint8_t room() const { return static_cast<uint8_t>(ring_mask - static_cast<uint8_t>(head_ - tail_)); }

 private:
  // Addresses in the controller's memory.
  static constexpr uint32_t control_buffer = 0x100;
  static constexpr uint32_t notices_buffer = 0x180;
  static constexpr uint32_t out_buffer = 0x1c0;
  static constexpr uint32_t in_buffer = 0x200;
  // Bits of a buffer control word.
  static constexpr uint32_t full = 1U << 15;
  static constexpr uint32_t second = 1U << 13;  // DATA1
  static constexpr uint32_t stall = 1U << 11;
  static constexpr uint32_t available = 1U << 10;
  static constexpr uint32_t length_mask = 0x3ff;
  // A full packet would announce another one, and the host would wait for it.
  static constexpr uint32_t most_sent = usb_packet - 1;
  static constexpr uint8_t ring_mask = 255;
  static constexpr uint32_t line_coding_size = 7;

  enum class Request : uint8_t {
    get_status = 0,
    clear_feature = 1,
    set_address = 5,
    get_descriptor = 6,
    get_configuration = 8,
    set_configuration = 9,
    get_interface = 10,
    set_interface = 11,
    set_line_coding = 0x20,
    get_line_coding = 0x21,
    set_line_state = 0x22,
  };

  static constexpr uint32_t bit_of(uint32_t endpoint, bool in) { return 1U << (2 * endpoint + (in ? 0 : 1)); }
  static constexpr uint32_t word_of(uint32_t endpoint, bool in) { return 0x80 + 8 * endpoint + (in ? 0 : 4); }
  static constexpr uint32_t control_of(uint32_t endpoint, bool in) { return 8 * endpoint + (in ? 0 : 4); }

  // The controller runs at another clock: it must see the word before it sees that it owns the buffer (4.1.2.5.1).
  static void arm(uint32_t endpoint, bool in, uint32_t word) {
    usb_word(word_of(endpoint, in)) = word;
    asm volatile("nop\n nop\n nop\n nop\n nop\n nop\n nop\n nop\n nop\n nop\n nop\n nop");
    usb_word(word_of(endpoint, in)) = word | available;
  }

  void reset() {
    UsbSieStatus::write(usb_bus_reset);
    UsbAddress::write(0);
    address_ = 0;
    configure(false);
  }

  void configure(bool on) {
    const uint32_t enabled = on ? 1U << 31 | usb_interrupt_per_buffer : 0;
    usb_word(control_of(usb_notices, true)) = enabled | 3U << 26 | notices_buffer;
    usb_word(control_of(usb_data, false)) = enabled | 2U << 26 | out_buffer;
    usb_word(control_of(usb_data, true)) = enabled | 2U << 26 | in_buffer;
    usb_word(word_of(usb_data, true)) = 0;
    usb_word(word_of(usb_data, false)) = 0;
    configured_ = on;
    out_pid_ = in_pid_ = 0;
    sending_ = false;
    tail_ = head_;
    if (on) {
      await_packet();
    } else {
      read_ = received_ = 0;
    }
  }

  void await_packet() {
    read_ = received_ = 0;
    arm(usb_data, false, out_pid_ | usb_packet);
    out_pid_ ^= second;
  }
  void handle_packet() {
    if (!configured_) return;
    received_ = usb_word(word_of(usb_data, false)) & length_mask;
    if (received_ == 0) await_packet();
  }
  void send_packet() {
    if (!configured_ || sending_ || head_ == tail_) return;
    uint32_t count = 0;
    while (head_ != tail_ && count < most_sent) usb_byte(in_buffer + count++) = ring_[tail_++ & ring_mask];
    arm(usb_data, true, full | in_pid_ | count);
    in_pid_ ^= second;
    sending_ = true;
  }

  // Endpoint 0: a setup packet, data in one direction or none, and an empty packet in the other direction.
  void handle_setup() {
    UsbSieStatus::write(usb_setup_received);
    // Discards everything left by an earlier request.
    usb_word(word_of(0, true)) = 0;
    usb_word(word_of(0, false)) = 0;
    left_ = 0;
    setup_type_ = usb_byte(0);
    request_ = static_cast<Request>(usb_byte(1));
    value_ = static_cast<uint16_t>(usb_byte(2) | usb_byte(3) << 8);
    index_ = static_cast<uint16_t>(usb_byte(4) | usb_byte(5) << 8);
    length_ = static_cast<uint16_t>(usb_byte(6) | usb_byte(7) << 8);
    pid_ = second;
    const uint8_t kind = setup_type_ & 0x60;
    if (kind == 0) return standard();
    if (kind == 0x20) return of_the_line();
    refuse();
  }
  void standard() {
    static constexpr uint8_t zeros[2] = {};
    switch (request_) {
      case Request::get_status: return answer(zeros, 2);
      case Request::clear_feature:
        if ((setup_type_ & 0x1f) != 2) return refuse();
        // The host restarts its packet numbering.
        if (index_ == (usb_in | usb_data)) in_pid_ = 0;
        if (index_ == usb_data && !has_byte()) {
          out_pid_ = 0;
          usb_word(word_of(usb_data, false)) = 0;
          await_packet();
        }
        return acknowledge();
      case Request::set_address: address_ = value_ & 127; return acknowledge();
      case Request::get_descriptor: return describe();
      case Request::get_configuration: return answer(configured_ ? &one : zeros, 1);
      case Request::set_configuration:
        if (value_ > 1) return refuse();
        configure(value_ == 1);
        return acknowledge();
      case Request::get_interface: return answer(zeros, 1);
      case Request::set_interface: return value_ == 0 ? acknowledge() : refuse();
      default: refuse();
    }
  }
  void describe() {
    switch (value_) {
      case 0x100: return answer(usb_device, sizeof(usb_device));
      case 0x200: return answer(usb_configuration, sizeof(usb_configuration));
      case 0x300: return answer(usb_languages, sizeof(usb_languages));
      case 0x301: return answer(usb_maker, sizeof(usb_maker));
      case 0x302: return answer(usb_product, sizeof(usb_product));
      default: refuse();
    }
  }
  // The baud rate has no effect here, but hosts want to read back the value that they wrote.
  void of_the_line() {
    switch (request_) {
      case Request::set_line_coding: return arm(0, false, second | usb_packet);
      case Request::get_line_coding: return answer(line_coding_, line_coding_size);
      case Request::set_line_state:
        tail_ = head_;  // a host that opens the port must not receive bytes meant for another host
        return acknowledge();
      default: refuse();
    }
  }

  void answer(const uint8_t* data, uint32_t size) {
    data_ = data;
    left_ = size < length_ ? size : length_;
    send_control();
  }
  void send_control() {
    const uint32_t count = left_ < usb_packet ? left_ : usb_packet;
    for (uint32_t i = 0; i < count; ++i) usb_byte(control_buffer + i) = data_[i];
    data_ += count;
    left_ -= count;
    arm(0, true, full | pid_ | count);
    pid_ ^= second;
  }
  void acknowledge() { arm(0, true, full | second); }
  void refuse() {
    UsbStallArm::write(3);
    usb_word(word_of(0, true)) = stall;
    usb_word(word_of(0, false)) = stall;
  }
  void control_sent() {
    if (left_ != 0) return send_control();
    if ((setup_type_ & usb_in) != 0) return arm(0, false, second);
    if (request_ == Request::set_address) UsbAddress::write(address_);
  }
  void control_came() {
    if ((setup_type_ & usb_in) != 0 || request_ != Request::set_line_coding) return;
    const uint32_t count = usb_word(word_of(0, false)) & length_mask;
    for (uint32_t i = 0; i < count && i < line_coding_size; ++i) line_coding_[i] = usb_byte(control_buffer + i);
    acknowledge();
  }

  static constexpr uint8_t one = 1;
  uint8_t ring_[ring_mask + 1] = {};
  uint8_t head_ = 0;
  uint8_t tail_ = 0;
  bool configured_ = false;
  bool sending_ = false;  // the controller owns the buffer to the host
  uint32_t out_pid_ = 0;
  uint32_t in_pid_ = 0;
  uint32_t received_ = 0;  // bytes in the buffer from the host
  uint32_t read_ = 0;      // bytes of it already read
  // State of the current request.
  uint8_t setup_type_ = 0;
  Request request_ = {};
  uint16_t value_ = 0;
  uint16_t index_ = 0;
  uint16_t length_ = 0;
  uint32_t pid_ = 0;
  uint8_t address_ = 0;
  const uint8_t* data_ = nullptr;
  uint32_t left_ = 0;
  uint8_t line_coding_[line_coding_size] = {0x00, 0xc2, 0x01, 0, 0, 0, 8};  // 115,200 baud, 8N1
};

}  // namespace passo::chip
