// GrblBoardStorage: the files of a board with grblHAL or FluidNC, over the connection of its session, which lends it.
// Private to sender/.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/sender/board_files.hpp"
#include "passo/sender/file_upload.hpp"
#include "passo/sender/grbl_port.hpp"
#include "passo/sender/grbl_sender.hpp"
#include "passo/session/board_storage.hpp"

namespace passo {

class GrblMachineSession;

class GrblBoardStorage final : public BoardStorage {
 public:
  // Must outlive this object.
  explicit GrblBoardStorage(GrblMachineSession& session) : session_(session) {}

  std::optional<Refusal> begin(StorageOrder order) override;
  void cancel() override;
  const StorageResult& result() const override { return result_; }
  std::optional<Sentence> why_no_upload() const override;
  std::string_view folder() const override;

  // Whether the connection carries an upload: every other byte would be a part of the file.
  bool uploads() const { return upload_.has_value(); }
  // Sends and receives parts of the file, for at most `most`.
  void exchange(GrblPort& port, Seconds most);
  // Processes what the board has answered. Must be called in each poll of the session while it lends its sender.
  void poll();
  // Ends an order whose connection, or whose board, was lost.
  void lose();

 private:
  struct Upload {
    FileUpload file;
    Seconds begun{0};
    Seconds heard{0};  // time of the last byte
  };

  void poll_upload();
  void ask_for_list();
  void hear(const GrblAnswer& answer);
  void finish();
  void fail(Sentence why);

  GrblMachineSession& session_;
  GrblSender* sender_ = nullptr;  // null: it is not lent to this object
  StorageResult result_;
  std::optional<Upload> upload_;
  std::optional<BoardFiles> listed_;       // so far
  std::size_t awaited_ = 0;                // answers
  std::vector<std::string> missing_ = {};  // places that the board cannot list, and why
};

}  // namespace passo
