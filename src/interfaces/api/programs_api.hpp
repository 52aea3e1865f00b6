// ProgramsApi: programs that clients upload, whole or in chunks, their data for viewers, and their height maps. Private
// to api/.
#pragma once

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

#include "passo/api/program_uploads.hpp"

namespace passo {

class ProgramsApi {
 public:
  // The maximum length of a program that is levelled: the idle machine waits for the levelling.
  static constexpr std::size_t longest_to_level = std::size_t{16} << 20;

  // Both must outlive this object.
  ProgramsApi(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer list(const ApiCall& call);
  WebAnswer send(const ApiCall& call);
  WebAnswer get(const ApiCall& call);
  WebAnswer remove(const ApiCall& call);
  WebAnswer check(const ApiCall& call);
  WebAnswer set_block_delete(const ApiCall& call);
  WebAnswer path(const ApiCall& call);
  WebAnswer text(const ApiCall& call);

  WebAnswer height_map(const ApiCall& call);
  WebAnswer set_height_map(const ApiCall& call);
  // Adds the result as a separate program, so that it can be viewed and checked like any other.
  WebAnswer level(const ApiCall& call);

  WebAnswer list_uploads(const ApiCall& call);
  WebAnswer begin_upload(const ApiCall& call);
  WebAnswer get_upload(const ApiCall& call);
  WebAnswer drop_upload(const ApiCall& call);
  WebAnswer receive_piece(const ApiCall& call);

 private:
  const ApiShared& shared_;
  const JobRunner& jobs_;
  ProgramUploads uploads_;
};

}  // namespace passo
