#include "modbus_port.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include <modbus/modbus.h>
#include <poll.h>
#include <sys/file.h>
#include <unistd.h>

#include "passo/spindle/huanyang_frames.hpp"

namespace passo {
namespace {

// With the silence, three silent polls take less than a second.
constexpr int longest_wait_ms = 200;
constexpr int longest_gap_ms = 50;  // within a reply; a USB adapter passes bytes on every 16 ms
// After an error, a reply may still be on its way. The next one must not be taken for it.
constexpr int silence_ms = 100;
constexpr int most_junk = 512;  // bytes

char letter_of(SerialParity parity) {
  static constexpr char letters[] = {'N', 'E', 'O'};
  return letters[static_cast<std::size_t>(parity)];
}

bool is_readable(int descriptor, int milliseconds) {
  pollfd ready{.fd = descriptor, .events = POLLIN, .revents = 0};
  return poll(&ready, 1, milliseconds) > 0;
}

}  // namespace

struct ModbusPort::Context {
  explicit Context(modbus_t* opened) : modbus(opened) {}
  ~Context() {
    modbus_close(modbus);
    modbus_free(modbus);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  modbus_t* modbus;
};

ModbusPort::ModbusPort(const SpindleBusDescription& bus) : bus_(bus) {}
ModbusPort::~ModbusPort() = default;

void ModbusPort::close() {
  context_.reset();
}

Status<VfdTrouble> ModbusPort::open() {
  if (context_) return Unit{};
  const auto failed = [this](const std::string& why) {
    close();
    return Failure{VfdTrouble{.kind = VfdTrouble::Kind::port, .words = why}};
  };
  modbus_t* const modbus = modbus_new_rtu(bus_.device.c_str(), bus_.baud, letter_of(bus_.parity), 8, bus_.stop_bits);
  if (modbus == nullptr) return failed(modbus_strerror(errno));
  context_ = std::make_unique<Context>(modbus);
  if (modbus_set_slave(modbus, bus_.address) != 0) return failed(modbus_strerror(errno));
  modbus_set_response_timeout(modbus, 0, longest_wait_ms * 1000);
  modbus_set_byte_timeout(modbus, 0, longest_gap_ms * 1000);
  if (modbus_connect(modbus) != 0) {
    const bool denied = errno == EACCES;
    return failed(std::string(std::strerror(errno)) +
                  (denied ? " (only members of the group dialout have access: adduser NAME dialout)" : ""));
  }
  if (flock(modbus_get_socket(modbus), LOCK_EX | LOCK_NB) != 0) return failed("in use by another program");
  modbus_flush(modbus);
  return Unit{};
}

VfdTrouble ModbusPort::trouble_of(int error) {
  if (error >= EMBXILFUN && error <= EMBXGTAR) {
    return {.kind = VfdTrouble::Kind::refused, .exception = error - MODBUS_ENOBASE};
  }
  if (error == ETIMEDOUT) {
    await_silence();
    return {.kind = VfdTrouble::Kind::silent};
  }
  if (error >= EMBBADCRC) {
    await_silence();
    return {.kind = VfdTrouble::Kind::bad_reply,
            .words = error == EMBBADCRC ? "its checksum is wrong" : modbus_strerror(error)};
  }
  close();
  return {.kind = VfdTrouble::Kind::port, .words = std::strerror(error)};
}

void ModbusPort::await_silence() {
  if (!context_) return;
  const int descriptor = modbus_get_socket(context_->modbus);
  std::array<std::uint8_t, 64> junk{};
  for (int bytes = 0; bytes < most_junk && is_readable(descriptor, silence_ms);) {
    const ssize_t got = ::read(descriptor, junk.data(), junk.size());
    if (got <= 0) return;
    bytes += static_cast<int>(got);
  }
}

ModbusPort::Reply ModbusPort::read(int function, std::uint16_t address) {
  if (auto opened = open(); !opened) return Failure{opened.error()};
  modbus_flush(context_->modbus);
  std::uint16_t value = 0;
  const int got = function == MODBUS_FC_READ_INPUT_REGISTERS
                      ? modbus_read_input_registers(context_->modbus, address, 1, &value)
                      : modbus_read_registers(context_->modbus, address, 1, &value);
  if (got != 1) return Failure{trouble_of(errno)};
  return value;
}

ModbusPort::Reply ModbusPort::write(int function, std::uint16_t address, std::uint16_t value) {
  if (auto opened = open(); !opened) return Failure{opened.error()};
  modbus_t* const modbus = context_->modbus;
  modbus_flush(modbus);
  const int done = function == MODBUS_FC_WRITE_SINGLE_COIL ? modbus_write_bit(modbus, address, value != 0 ? 1 : 0)
                   : function == MODBUS_FC_WRITE_MULTIPLE_REGISTERS ? modbus_write_registers(modbus, address, 1, &value)
                                                                    : modbus_write_register(modbus, address, value);
  if (done != 1) return Failure{trouble_of(errno)};
  return value;
}

ModbusPort::Reply ModbusPort::exchange_huanyang(std::span<const std::uint8_t> request) {
  if (auto opened = open(); !opened) return Failure{opened.error()};
  modbus_flush(context_->modbus);
  if (modbus_send_raw_request(context_->modbus, request.data(), static_cast<int>(request.size())) < 0) {
    return Failure{trouble_of(errno)};
  }
  const int descriptor = modbus_get_socket(context_->modbus);
  std::vector<std::uint8_t> reply;
  std::size_t wanted = 3;
  while (reply.size() < wanted) {
    if (!is_readable(descriptor, reply.empty() ? longest_wait_ms : longest_gap_ms)) {
      return Failure{trouble_of(ETIMEDOUT)};
    }
    std::array<std::uint8_t, longest_huanyang_frame> bytes{};
    const ssize_t got = ::read(descriptor, bytes.data(), wanted - reply.size());
    if (got <= 0) return Failure{trouble_of(got < 0 ? errno : EIO)};
    reply.insert(reply.end(), bytes.begin(), bytes.begin() + got);
    if (const auto length = huanyang_reply_length(reply)) wanted = *length;
  }
  const auto value = parse_huanyang_reply(reply, request);
  if (!value && value.error().kind == VfdTrouble::Kind::bad_reply) await_silence();
  return value;
}

}  // namespace passo
