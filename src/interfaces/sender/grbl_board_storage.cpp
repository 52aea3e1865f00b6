#include "grbl_board_storage.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "passo/sender/grbl_machine_session.hpp"
#include "passo/session/request_checks.hpp"

namespace passo {
namespace {

// A full card on a slow line.
constexpr Seconds longest_list{60};
constexpr Seconds longest_removal{10};
// What a board still says of a file after its end; it is no answer to a line.
constexpr Seconds quiet_after_upload{0.25};
constexpr Seconds shortest_estimate{1};
constexpr double least_share = 0.005;
constexpr int most_packets = 16;  // of one exchange

}  // namespace

std::optional<Sentence> GrblBoardStorage::why_no_upload() const {
  const GrblMachine& board = session_.board();
  const auto files = BoardFiles::of(board);
  if (!files) return Sentence{.code = "ability.board-files", .text = files.error()};
  if (files->is_fluidnc() || board.has_option("YM")) return {};
  return Sentence{
      .code = "board-files.no-upload",
      .text = "this board was built without YMODEM: copy the file to the card, or use the board's FTP server"};
}

std::string_view GrblBoardStorage::folder() const {
  const auto files = BoardFiles::of(session_.board());
  return files ? files->card_folder() : "/";
}

std::optional<Refusal> GrblBoardStorage::begin(StorageOrder order) {
  if (result_.state == StorageResult::State::running) return Refusal{RefusalReason::busy};
  auto files = BoardFiles::of(session_.board());
  if (!files) return refused_because("ability.board-files", files.error());
  std::optional<FileUpload> file;
  std::string line;
  if (order.kind == StorageOrder::Kind::upload) {
    auto upload = FileUpload::begin(session_.board(), order.path, std::move(order.content));
    if (!upload) return refused_because("board-files.cannot-send", upload.error());
    file = std::move(*upload);
  } else if (order.kind == StorageOrder::Kind::remove) {
    // FluidNC would also delete a folder with all that is in it.
    if (std::ranges::find(result_.files, order.path, &StoredFile::path) == result_.files.end()) {
      return refused_because("board-files.none", "the list of the board's files has no such file");
    }
    auto remove = files->remove_line(order.path);
    if (!remove) return refused_because("board-files.bad-path", remove.error());
    line = std::move(*remove);
  }
  sender_ = session_.lend_sender();
  if (sender_ == nullptr) {
    const bool is_idle = session_.state() == MachineState::idle && !session_.busy();
    return is_idle ? Refusal{RefusalReason::busy} : refusal_in(session_.state(), session_.busy());
  }
  result_.state = StorageResult::State::running;
  result_.kind = order.kind;
  result_.path = std::move(order.path);
  result_.why = {};
  result_.share = 0;
  result_.left.reset();
  listed_.reset();
  awaited_ = 0;
  if (file) {
    upload_ = Upload{.file = std::move(*file), .begun = session_.now(), .heard = session_.now()};
  } else if (!line.empty()) {
    sender_->ask(std::move(line), longest_removal);
    awaited_ = 1;
  } else {
    ask_for_list();
  }
  return {};
}

void GrblBoardStorage::cancel() {
  if (upload_) upload_->file.cancel();
}

void GrblBoardStorage::exchange(GrblPort& port, Seconds most) {
  for (int packet = 0; packet < most_packets; ++packet) {
    const std::string bytes = upload_->file.take_bytes(port.now());
    if (!bytes.empty()) port.send(bytes);
    const std::string came = port.receive(packet == 0 ? most : Seconds(0));
    if (came.empty() || port.is_broken()) return;
    upload_->heard = port.now();
    upload_->file.receive(came, port.now());
  }
}

void GrblBoardStorage::poll() {
  if (result_.state != StorageResult::State::running) return;
  if (!session_.is_sender_lent()) return lose();
  if (upload_) return poll_upload();
  while (auto answer = sender_->take_reply()) {
    hear(*answer);
    if (sender_ == nullptr) return;
  }
}

void GrblBoardStorage::poll_upload() {
  const FileUpload& file = upload_->file;
  const Seconds now = session_.now();
  result_.share = file.share();
  const Seconds since = now - upload_->begun;
  if (since > shortest_estimate && file.share() > least_share) {
    result_.left = since * ((1 - file.share()) / file.share());
  }
  if (!file.ended() || now - upload_->heard < quiet_after_upload) return;
  const std::string trouble = file.trouble();
  upload_.reset();
  result_.left.reset();
  if (!trouble.empty()) {
    // The board may have taken a part of the file for lines.
    std::exchange(sender_, nullptr);
    session_.take_sender_back_and_greet();
    return fail({.code = "board-files.upload",
                 .arguments = {{"why", trouble}},
                 .text = fmt::format("the file was not sent: {}", trouble)});
  }
  ++result_.uploads;
  ask_for_list();
}

void GrblBoardStorage::ask_for_list() {
  listed_ = *BoardFiles::of(session_.board());
  missing_.clear();
  for (std::string& question : listed_->questions()) {
    sender_->ask(std::move(question), longest_list);
    ++awaited_;
  }
}

void GrblBoardStorage::hear(const GrblAnswer& answer) {
  if (awaited_ > 0) --awaited_;
  if (!listed_) {
    if (!answer.error.empty()) {
      return fail({.code = "board-files.refused",
                   .arguments = {{"why", answer.error}},
                   .text = fmt::format("the board refuses it: {}", answer.error)});
    }
    return ask_for_list();
  }
  if (!answer.error.empty()) missing_.push_back(answer.error);
  listed_->hear(answer.line, answer.said);
  if (awaited_ > 0) return;
  const bool is_listed = missing_.size() < listed_->questions().size();
  if (is_listed) {
    result_.files = listed_->all();
    result_.is_listed = true;
  } else if (result_.kind == StorageOrder::Kind::list) {
    return fail({.code = "board-files.no-list",
                 .arguments = {{"why", missing_.front()}},
                 .text = fmt::format("the board cannot list its files ({}): is a card inserted?", missing_.front())});
  }
  finish();
}

void GrblBoardStorage::finish() {
  result_.state = StorageResult::State::done;
  sender_ = nullptr;
  session_.take_sender_back();
}

void GrblBoardStorage::fail(Sentence why) {
  result_.state = StorageResult::State::failed;
  result_.why = std::move(why);
  if (std::exchange(sender_, nullptr) != nullptr) session_.take_sender_back();
}

void GrblBoardStorage::lose() {
  upload_.reset();
  if (result_.state != StorageResult::State::running) return;
  sender_ = nullptr;
  result_.left.reset();
  fail({.code = "board-files.lost", .text = "the connection to the board was lost, or the board has restarted"});
}

}  // namespace passo
