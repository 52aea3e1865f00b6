// BoardStorage: the files that a board keeps on a card or in its flash memory: listed, sent and deleted while nothing
// moves. request::RunBoardFile runs one.
//
// Position in the pipeline: beside a MachineSession, which polls it. It processes one order at a time, and never
// blocks. Meanwhile the session refuses requests; Stop ends an upload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/sentence.hpp"
#include "passo/session/refusal.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct StoredFile {
  std::string path;         // "/sd/part.nc"
  std::uint64_t bytes = 0;  // its size
  bool can_run = true;      // the board cannot open some names

  bool operator==(const StoredFile&) const = default;
};

struct StorageOrder {
  enum class Kind : std::uint8_t { list, upload, remove };
  Kind kind = Kind::list;
  std::string path = {};
  std::string content = {};  // to upload
};

struct StorageResult {
  enum class State : std::uint8_t { none, running, done, failed };
  State state = State::none;
  StorageOrder::Kind kind = StorageOrder::Kind::list;  // of the last order
  std::string path = {};                               // its file
  Sentence why = {};                                   // of a failure
  double share = 0;                                    // of an upload: the acknowledged part, 0 to 1
  std::optional<Seconds> left = {};                    // the remaining time of an upload, if it is known
  std::uint64_t uploads = 0;                           // number of files that have arrived
  bool is_listed = false;                              // the files are known
  std::vector<StoredFile> files = {};                  // as last listed
};

class BoardStorage {
 public:
  static constexpr std::size_t most_bytes = std::size_t{64} << 20;  // of a file

  virtual ~BoardStorage() = default;
  // Begins an order; an upload and a removal list the files again at their end. Returns why it cannot begin; empty: it
  // has begun.
  virtual std::optional<Refusal> begin(StorageOrder order) = 0;
  // Ends an upload before its end. The board keeps a part of the file, or nothing.
  virtual void cancel() = 0;
  virtual const StorageResult& result() const = 0;
  // Why no file can be sent to this board. Empty: it can receive files.
  virtual std::optional<Sentence> why_no_upload() const = 0;
  // The folder of the card, with its slashes: "/", "/sd/".
  virtual std::string_view folder() const = 0;
};

}  // namespace passo
