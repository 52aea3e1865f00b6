// BoardFilesApi: the files that the board stores: listed, sent, deleted and run. Private to api/.
//
// A file that was sent from here is also kept as a program, so that it is checked before the board runs it. A file of
// which Passo does not have the text runs only if the client says that it is unchecked.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

#include "passo/session/board_storage.hpp"

namespace passo {

class BoardFilesApi {
 public:
  // Both must outlive this object.
  BoardFilesApi(const ApiShared& shared, JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer get(const ApiCall& call);
  WebAnswer list(const ApiCall& call);
  WebAnswer send(const ApiCall& call);
  WebAnswer remove(const ApiCall& call);
  WebAnswer run(const ApiCall& call);
  // Notes which files have arrived. Must be called once per iteration of the main loop.
  void poll();

 private:
  // What the board stores at a path, as far as it was sent from here.
  struct SentFile {
    std::uint64_t program = 0;
    std::uint64_t bytes = 0;
  };

  std::optional<WebAnswer> refuse() const;
  WebAnswer begin(StorageOrder order);
  WebAnswer state_answer(unsigned status) const;
  // The program with the text of a file. Null: Passo does not have it, or the file on the board is another one.
  const StoredProgram* text_of(const std::string& path) const;
  void forget(const std::string& path);

  const ApiShared& shared_;
  JobRunner& jobs_;
  std::map<std::string, SentFile> sent_;                      // by their paths
  std::optional<std::pair<std::string, SentFile>> arriving_;  // with its path
  std::uint64_t uploads_ = 0;                                 // as the board's storage has counted
};

}  // namespace passo
