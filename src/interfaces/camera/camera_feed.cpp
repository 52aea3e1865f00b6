#include "passo/camera/camera_feed.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "camera_connection.hpp"
#include "camera_sentences.hpp"

#include "passo/camera/camera_response.hpp"

namespace passo {

// The part that lives in the thread. Its public functions may be called by both threads.
class CameraFeed::Fetcher {
 public:
  using State = CameraStatus::State;

  Fetcher(HttpUrl stream, std::optional<HttpUrl> snapshot, const CameraPace& pace)
      : stream_(std::move(stream)), snapshot_(std::move(snapshot)), pace_(pace), retry_(pace.first_retry) {}

  // The thread's function: returns after end().
  void run() {
    while (wait_until_wanted()) {
      Sentence problem = fetch();
      const bool has_failed = !problem.code.empty();
      const std::unique_lock lock(mutex_);
      if (ends_) return;
      status_.state = has_failed ? State::waiting : is_wanted() ? State::live : State::off;
      if (has_failed) status_.problem = std::move(problem);
      pauses_until_ = now() + (has_failed ? retry_ : pace_.between_snapshots);
      if (has_failed) retry_ = std::min(retry_ * 2, pace_.last_retry);
    }
  }
  void end() {
    const std::unique_lock lock(mutex_);
    ends_ = true;
    wakes_.notify_all();
  }

  void watch(bool is_watched) {
    const std::unique_lock lock(mutex_);
    if (std::exchange(is_watched_, is_watched) != is_watched) wakes_.notify_all();
  }
  std::uint64_t want_picture() {
    const std::unique_lock lock(mutex_);
    wanted_after_ = newest_.number;
    wanted_until_ = now() + pace_.wants_within;
    wakes_.notify_all();
    return newest_.number;
  }
  CameraPicture newest() {
    const std::unique_lock lock(mutex_);
    return newest_;
  }
  CameraStatus status() {
    const std::unique_lock lock(mutex_);
    CameraStatus status = status_;
    if (newest_.jpeg) status.age = now() - newest_at_;
    return status;
  }

 private:
  static Seconds now() {
    return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count());
  }
  bool is_wanted() const { return is_watched_ || (newest_.number <= wanted_after_ && now() < wanted_until_); }

  // Returns false at the end.
  bool wait_until_wanted() {
    constexpr auto longest_look = std::chrono::milliseconds(20);
    std::unique_lock lock(mutex_);
    while (!ends_ && (!is_wanted() || now() < pauses_until_)) {
      if (!is_wanted()) {
        status_.state = State::off;
        wakes_.wait(lock, [this] { return ends_ || is_wanted(); });
      } else {
        wakes_.wait_for(lock, longest_look);
      }
    }
    if (!ends_ && status_.state == State::off) status_.state = State::connecting;
    return !ends_;
  }

  // The stream that someone watches gives the single pictures, too.
  HttpUrl wanted_url() {
    const std::unique_lock lock(mutex_);
    return !is_watched_ && snapshot_ ? *snapshot_ : stream_;
  }

  bool is_needed() {
    const std::unique_lock lock(mutex_);
    if (is_wanted()) needed_at_ = now();
    return !ends_ && now() < needed_at_ + pace_.lingers;
  }

  void keep(std::string picture) {
    const std::unique_lock lock(mutex_);
    newest_ = {.number = newest_.number + 1, .jpeg = std::make_shared<const std::string>(std::move(picture))};
    newest_at_ = now();
    status_ = {.state = State::live};
    retry_ = pace_.first_retry;
  }

  // Returns the problem. Empty: all wanted pictures have come.
  Sentence fetch() {
    const auto connection = CameraConnection::open(wanted_url(), pace_.connect_within, [this] { return !is_needed(); });
    if (!connection) return is_needed() ? camera_says::unreachable.with() : Sentence();
    CameraResponse response;
    std::string bytes;
    Seconds silent_at = now() + pace_.picture_within;
    while (is_needed()) {
      const CameraConnection::Read read = connection->read(bytes);
      if (read == CameraConnection::Read::closed) response.end();
      const bool reads_on = read != CameraConnection::Read::closed && response.read(bytes);
      if (auto picture = response.take_picture()) {
        keep(std::move(*picture));
        silent_at = now() + pace_.picture_within;
      }
      if (!reads_on) return response.problem();
      if (now() > silent_at) return camera_says::silent.with();
    }
    return {};
  }

  const HttpUrl stream_;
  const std::optional<HttpUrl> snapshot_;
  const CameraPace pace_;

  std::mutex mutex_;  // for all that follows
  std::condition_variable wakes_;
  bool ends_ = false;
  bool is_watched_ = false;
  std::uint64_t wanted_after_ = 0;
  Seconds wanted_until_{0};
  Seconds needed_at_{0};     // last time when a picture was wanted
  Seconds pauses_until_{0};  // the next attempt is then
  Seconds retry_;            // the next interval between attempts
  CameraPicture newest_;
  Seconds newest_at_{0};
  CameraStatus status_;
};

// Detached: resolving a name may take long, and the end of the program does not wait for it.
CameraFeed::CameraFeed(HttpUrl stream, std::optional<HttpUrl> snapshot, const CameraPace& pace)
    : fetcher_(std::make_shared<Fetcher>(std::move(stream), std::move(snapshot), pace)) {
  std::thread([fetcher = fetcher_] { fetcher->run(); }).detach();
}

CameraFeed::~CameraFeed() {
  fetcher_->end();
}

void CameraFeed::watch(bool is_watched) {
  fetcher_->watch(is_watched);
}

std::uint64_t CameraFeed::want_picture() {
  return fetcher_->want_picture();
}

CameraPicture CameraFeed::newest() {
  return fetcher_->newest();
}

CameraStatus CameraFeed::status() {
  return fetcher_->status();
}

}  // namespace passo
