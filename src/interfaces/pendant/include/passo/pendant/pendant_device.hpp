// PendantDevice: a connected pendant, as a source of reports. HidrawDevice: one that Linux offers as hidraw, or, in
// tests, a pipe or a socket.
//
// Position in the pipeline: before PendantDecoder. read() never waits. Reports for the display are written by a thread
// of their own, because a transfer to a device that does not answer takes seconds; only the newest ones are written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

class PendantDevice {
 public:
  using Report = std::vector<std::uint8_t>;
  enum class Read : std::uint8_t { report, nothing, gone };

  PendantDevice() = default;
  PendantDevice(const PendantDevice&) = delete;
  PendantDevice& operator=(const PendantDevice&) = delete;
  virtual ~PendantDevice() = default;

  // Reads the next report, if there is one. `gone`: the device was unplugged.
  virtual Read read(Report& report) = 0;
  // Writes reports to the display, soon.
  virtual void show(std::vector<Report> reports) = 0;
  // For poll(); negative: none.
  virtual int descriptor() const { return -1; }
};

class HidrawDevice final : public PendantDevice {
 public:
  // `length`: of a report. `features`: the display takes feature reports.
  // The error is a sentence without a full stop.
  static Result<std::unique_ptr<HidrawDevice>, std::string> open(const std::string& path, std::size_t length,
                                                                 bool features);
  // Takes over an open file descriptor that does not block.
  HidrawDevice(int descriptor, std::size_t length, bool features);
  ~HidrawDevice() override;

  Read read(Report& report) override;
  void show(std::vector<Report> reports) override;
  int descriptor() const override { return descriptor_; }

 private:
  class Writer;

  int descriptor_;
  std::size_t length_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace passo
