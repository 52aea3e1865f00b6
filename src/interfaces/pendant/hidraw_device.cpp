#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "passo/pendant/pendant_device.hpp"

namespace passo {

// Writes the newest reports. A device that does not answer delays only this thread.
class HidrawDevice::Writer {
 public:
  Writer(int descriptor, bool features) : descriptor_(descriptor), features_(features) {}
  ~Writer() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wakes_.notify_one();
  }

  void show(std::vector<Report> reports) {
    {
      const std::lock_guard lock(mutex_);
      newest_ = std::move(reports);
    }
    wakes_.notify_one();
  }

 private:
  void run() {
    while (true) {
      std::vector<Report> reports;
      {
        std::unique_lock lock(mutex_);
        wakes_.wait(lock, [this] { return ends_ || !newest_.empty(); });
        if (ends_) return;
        reports = std::exchange(newest_, {});
      }
      for (Report& report : reports) write(report);
    }
  }
  // A display that takes nothing stays as it is; that the pendant is gone is found by reading.
  void write(Report& report) const {
    const auto length = static_cast<unsigned>(report.size());
    const auto written = features_ ? static_cast<ssize_t>(ioctl(descriptor_, HIDIOCSFEATURE(length), report.data()))
                                   : ::write(descriptor_, report.data(), report.size());
    static_cast<void>(written);
  }

  const int descriptor_;
  const bool features_;
  std::mutex mutex_;
  std::condition_variable wakes_;
  std::vector<Report> newest_;
  bool ends_ = false;
  std::jthread thread_{[this] { run(); }};  // last: it uses the others
};

Result<std::unique_ptr<HidrawDevice>, std::string> HidrawDevice::open(const std::string& path, std::size_t length,
                                                                      bool features) {
  int descriptor = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0 && errno == EACCES) {
    return Failure<std::string>{fmt::format(
        "{} cannot be opened: this user has no permission. A udev rule gives it: docs/manual/pendants.md", path)};
  }
  if (descriptor < 0) return Failure<std::string>{fmt::format("{} cannot be opened: {}", path, std::strerror(errno))};
  return std::make_unique<HidrawDevice>(descriptor, length, features);
}

HidrawDevice::HidrawDevice(int descriptor, std::size_t length, bool features)
    : descriptor_(descriptor), length_(length), writer_(std::make_unique<Writer>(descriptor, features)) {}

HidrawDevice::~HidrawDevice() {
  writer_.reset();
  ::close(descriptor_);
}

// A read of hidraw gives one report, cut to the length that is asked for.
PendantDevice::Read HidrawDevice::read(Report& report) {
  report.resize(length_);
  const ssize_t count = ::read(descriptor_, report.data(), report.size());
  if (count > 0) {
    report.resize(static_cast<std::size_t>(count));
    return Read::report;
  }
  const bool waits = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  return waits ? Read::nothing : Read::gone;
}

void HidrawDevice::show(std::vector<Report> reports) {
  writer_->show(std::move(reports));
}

}  // namespace passo
